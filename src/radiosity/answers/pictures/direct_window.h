#pragma once
// Light straight from emitters, by the shadow rays of a pixel and of those around it.

#include "geometry/vector.h"
#include "radiosity/answers/pictures/linear_fit.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace hemilux {

/// The direct light that arrives in a window of pixels. A few shadow rays estimate badly which
/// share of it arrives. The mean of the window does so better where the share changes slowly, the
/// pixel's own rays do at a sharp edge.
class DirectWindow {
  public:
    static constexpr int reach = 2; ///< to each side [pixels]

    /// `rays` are the shadow rays of a pixel.
    explicit DirectWindow(unsigned rays) : rays_(rays) {}

    /// Returns the weight of a pixel that is some steps away. Those at both ends count half, so
    /// that the rays of a window together are well distributed.
    [[nodiscard]] static float weight_at(int dx, int dy) { return along(dx) * along(dy); }

    /// Adds a pixel of the same surface: what its rays found, and what they would have if nothing
    /// stood between.
    void add(int dx, int dy, const glm::vec3& arriving, const glm::vec3& unshadowed, float weight) {
        arriving_ += weight * arriving;
        unshadowed_ += weight * unshadowed;
        const float all = unshadowed.x + unshadowed.y + unshadowed.z;
        if (all > 0)
            share_.add({dx, dy}, double((arriving.x + arriving.y + arriving.z) / all),
                       double(weight));
    }

    /// Returns the weight of a pixel's own share beside the mean of the window, by the variance of
    /// both (Lee 1980): 1 at a sharp edge, where all rays of most pixels agree; 0 where the share
    /// changes slowly.
    [[nodiscard]] float share_of_own() const {
        if (!(share_.weight() > 0) || rays_ < 2)
            return 0;
        const double noise = std::max(share_.mean() - share_.mean_square(), 0.0) / (rays_ - 1),
                     signal = share_.variance() - noise;
        return signal > 0 ? float(signal / (signal + noise)) : 0;
    }

    /// Returns what arrives of `all`, the direct light if nothing stood between: by the mean of the
    /// window, and with weight `own` by the pixel's rays alone.
    [[nodiscard]] glm::vec3 arriving_of(const glm::vec3& all, float own,
                                        const glm::vec3& own_arriving,
                                        const glm::vec3& own_unshadowed) const {
        glm::vec3 light(0.0f);
        for (int c = 0; c < 3; ++c) {
            if (unshadowed_[c] > 0)
                light[c] = all[c] * (arriving_[c] / unshadowed_[c]);
            if (own > 0 && own_unshadowed[c] > 0)
                light[c] += own * (all[c] * (own_arriving[c] / own_unshadowed[c]) - light[c]);
        }
        return light;
    }

  private:
    static float along(int step) {
        constexpr std::array<float, 2 * reach + 1> weights{.5f, 1, 1, 1, .5f};
        return weights[static_cast<std::size_t>(std::ptrdiff_t{step} + reach)];
    }

    unsigned rays_;
    glm::vec3 arriving_{0.0f}, unshadowed_{0.0f};
    LinearFit share_;
};

} // namespace hemilux
