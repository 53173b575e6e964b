#pragma once
// All the light that is wanted from one solution: of points, lightmaps and a picture.

#include "radiosity/answers/gathering/light_of_lightmap.h"
#include "radiosity/answers/gathering/light_of_picture.h"
#include "radiosity/answers/gathering/light_of_points.h"

#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// What is not wanted is empty. Layouts live as long as it is used; those without a triangle are
/// left out.
struct WantedLight {
    std::vector<WantedPoint> points = {};
    std::span<const NamedLayout> lightmaps = {};
    Bake bake = Bake::radiosity; ///< of lightmaps
    std::optional<WantedPicture> picture = {};
    double error_of_patches = AnswerError::unknown; ///< of the solution [-]
};

/// Each answer has its own error.
struct GatheredLight {
    bool was_wanted = false; ///< any light was
    std::optional<Answer<GatheredPoints>> points = {};
    std::vector<Answer<LightOfLightmap>> lightmaps = {};
    std::optional<Answer<LightOfPicture>> picture =
        {}; ///< empty too where a signal left no row of it

    /// Returns the error with the largest bound; unknown where no error is known.
    [[nodiscard]] AnswerError largest_error() const;
    [[nodiscard]] Work work() const;
};

/// The errors that a part of the light may have.
struct ErrorOfPart {
    double error;     ///< relative to the whole light of a target [-]
    double own_error; ///< at most, relative to its own light [-]
};

/// Gathers points, then lightmaps, then the picture. With `whole`, the light is a part of that,
/// and each target is as exact as that needs it.
[[nodiscard]] GatheredLight gather(Gatherer& gatherer, const WantedLight& wanted,
                                   const GatheredLight* whole = nullptr,
                                   const ErrorOfPart& part = {});

} // namespace hemilux
