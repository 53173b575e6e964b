#pragma once
// What light is gathered for: points, the pixels of a picture, the texels of a lightmap. A target
// says for which places the light is to be learned, gathers round by round, and judges what it has.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/pictures/picture_error.h"
#include "radiosity/light/cached_light/light_cache.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

class Workers;

class GatherTarget {
  public:
    virtual ~GatherTarget() = default;

    /// Returns its name: "picture", "lightmap of chair".
    [[nodiscard]] virtual std::string name() const = 0;

    /// The places whose light is learned, the seed of the walks that learn it, and the time after
    /// which no more of them begin [s], if there is an end.
    struct Parts {
        std::vector<TargetPart> parts;
        std::uint64_t seed;
        std::optional<double> seconds = {};
    };
    /// Throws Interrupted where the user asked to end before they are found.
    [[nodiscard]] virtual Parts parts(const Workers& workers) = 0;

    /// A round of rays of its own.
    struct Round {
        unsigned rays;         ///< at a place
        unsigned number;       ///< from 0
        bool alone;            ///< each place at which light changes fast gathers by itself
        double error;          ///< relative error that all of the light may have [-]
        const ReadError& read; ///< of the light that gathers read
        std::function<void(double share)> tell; ///< to be called with the share that is done
    };
    /// Gathers a round, and returns its rays. After an odd one the target has the mean of it and of
    /// the round before. Throws Interrupted where the user asked to end before all of it was
    /// gathered: the target keeps the rounds before, or of the first one what there is.
    virtual std::uint64_t gather(const Round& round, const Workers& workers) = 0;

    /// Returns whether further rounds make it more exact; otherwise one takes the rays that it
    /// needs.
    [[nodiscard]] virtual bool takes_rounds() const { return true; }

    /// Returns the error of what it has besides that of the light which gathers read, by about so
    /// many places; nothing where go_on() ends it.
    [[nodiscard]] virtual std::optional<PictureError>
    judge(std::size_t places, const Workers& workers, const PictureJudge::GoOn& go_on) = 0;
};

/// A target whose light is an image.
class ImageTarget : public GatherTarget {
  public:
    std::uint64_t gather(const Round& round, const Workers& workers) override;
    [[nodiscard]] std::optional<PictureError> judge(std::size_t places, const Workers& workers,
                                                    const PictureJudge::GoOn& go_on) override;

  protected:
    /// The image of a round, and its rays.
    struct OneRound {
        Image image;
        std::uint64_t rays;
    };
    /// Does as gather() for a round by itself.
    [[nodiscard]] virtual OneRound gather_round(const Round& round, const Workers& workers) = 0;
    [[nodiscard]] virtual PictureJudge make_judge() const = 0;

    Image image_; ///< the mean of rounds
  private:
    std::optional<PictureJudge> judge_;
};

} // namespace hemilux
