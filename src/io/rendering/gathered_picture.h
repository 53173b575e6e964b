#pragma once
// A picture whose light is gathered at its pixels (picture_gather.h).
//
// Which share of the direct light arrives is found first for each pixel at the edge of a shadow, by
// few shadow rays that differ from pixel to pixel; then a pixel takes the share of the four by four
// pixels of its surface around it. Each such square has one well distributed set of shadow rays.

#include "io/pictures/image.h"
#include "io/rendering/picture_gather.h"

#include <span>
#include <vector>

namespace hemilux {

class GatheredPicture {
  public:
    /// `offsets` are those of samples in a pixel. All arguments must outlive this object.
    GatheredPicture(const Mesh& mesh, const VisibleFacets& visible, const PictureGather& gather,
                    std::span<const Vec2> offsets, int width, int height);

    /// Renders linear radiosity. Throws Interrupted once give_up() is true.
    [[nodiscard]] Image render(const std::function<bool()>& give_up, const Workers& workers);

  private:
    /// What a pixel shows of one facet, or a whole pixel where it shows nothing else.
    struct Part {
        glm::vec3 position{0.0f};                 ///< local frame
        glm::vec3 direct{0.0f}, unshadowed{0.0f}; ///< by its own shadow rays
        glm::vec3 smooth_unshadowed{0.0f}, indirect{0.0f};
        glm::vec3 reflectance{0.0f}, emission{0.0f};
        std::uint32_t patch = none;
        float share = 0; ///< of the pixel
        int x = 0;
    };
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    void gather_band(const VisibleFacets::Band& band, int first);
    [[nodiscard]] glm::vec3 direct_light(const Part& part, int y) const;
    [[nodiscard]] glm::vec3 radiosity(const Part& part, int y) const;

    const Mesh& mesh_;
    const VisibleFacets& visible_;
    const PictureGather& gather_;
    std::span<const Vec2> offsets_;
    int width_, height_;
    std::vector<Part> whole_;              ///< by pixel; share 0 where it shows nothing or several
    std::vector<std::vector<Part>> parts_; ///< by row, from left to right
};

} // namespace hemilux
