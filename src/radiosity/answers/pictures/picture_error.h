#pragma once
// How far a gathered picture is from the light that its rays read: by noise, and by what lies
// between the points at which it was gathered.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/paper/scene/varying_colours.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace hemilux {

class Workers;

/// An error relative to the reflected light that the picture shows: RMS over pixels and channels.
struct PictureError {
    double error = 0;
    double uncertainty = 0; ///< one sigma of `error`
    double bound = 0;       ///< what it surely is at most
    /// What 95 of 100 parts of the picture are within, relative to the light there [-].
    double local = 0;
    double level = 0; ///< RMS of that light over pixels and channels [W/m2]
    std::uint64_t rays = 0;
};

/// A pixel that is judged, by what it shows at places in it.
struct JudgedPixel {
    struct Place {
        SurfacePoint at;
        Colours colours;
    };
    std::size_t pixel; ///< its number in the picture
    /// Those of both estimates, half for each; one place stands for all.
    std::vector<Place> places;
    double weight = 1; ///< it stands for so many pixels that are chosen with the mean probability
};

/// Gathers the light at random pixels, twice independently, with many rays. The mean product of
/// both differences from a picture is its squared error, free of their noise. The light of a pixel
/// is gathered once, for all pictures that are judged.
class PictureJudge {
  public:
    /// Chooses about so many pixels, spread over the picture that is judged first.
    using Choice = std::function<std::vector<JudgedPixel>(std::size_t count, const Image& picture,
                                                          std::uint64_t seed)>;

    /// With `only_reflected`, pictures show no light that arrives straight from where it is
    /// emitted.
    PictureJudge(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light, Choice choice,
                 std::uint64_t seed, bool only_reflected = false, double sigmas_of_bound = 1)
        : mesh_(mesh), tracer_(tracer), light_(light), choice_(std::move(choice)), seed_(seed),
          only_reflected_(only_reflected), sigmas_of_bound_(sigmas_of_bound) {}

    /// Returns the error of a picture by about so many pixels, or by all that are known already.
    [[nodiscard]] PictureError error_of(const Image& picture, std::size_t pixels,
                                        const Workers& workers) {
        return *error_of(picture, pixels, workers, {});
    }
    /// Does the same; returns nothing where go_on() ends it. It is called now and then with the
    /// share that is done.
    using GoOn = std::function<bool(double share)>;
    [[nodiscard]] std::optional<PictureError> error_of(const Image& picture, std::size_t pixels,
                                                       const Workers& workers, const GoOn& go_on);

  private:
    /// What a pixel shows, by both estimates [W/m2].
    struct Estimates {
        std::size_t pixel;
        double weight;
        std::array<Vec3, 2> reflected{}, emitted{};
    };
    [[nodiscard]] std::optional<std::uint64_t> estimate_more(const Image& picture,
                                                             std::size_t pixels,
                                                             const Workers& workers,
                                                             const GoOn& go_on);

    const Mesh& mesh_;
    const Tracer& tracer_;
    const SurfaceLight& light_;
    Choice choice_;
    std::uint64_t seed_;
    bool only_reflected_;
    double sigmas_of_bound_;
    std::size_t asked_ = 0; ///< so many pixels were
    std::vector<Estimates> known_;
};

/// Returns the judge of pictures of this size. Pixels on edges, and those of what reflects nothing,
/// are left out. One pixel is judged in each of equal parts of the picture.
[[nodiscard]] PictureJudge judge_of_pictures(const Mesh& mesh, const Tracer& tracer,
                                             const SurfaceLight& light, const CameraRays& camera,
                                             int width, int height, std::uint64_t seed);

} // namespace hemilux
