#pragma once
// Collects shadow rays, which are traced many at a time.

#include "bvh/tracer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

/// The shadow rays that are not traced yet. A sample says what its ray brings if nothing is in the
/// way.
template <class Sample>
class ShadowRays {
  public:
    /// Adds a ray; `target` is the facet that it goes to.
    void add(const Ray& ray, std::uint32_t target, const Sample& sample) {
        rays_.push_back(ray);
        targets_.push_back(target);
        samples_.push_back(sample);
    }
    [[nodiscard]] std::size_t size() const { return rays_.size(); }
    [[nodiscard]] const Ray& ray(std::size_t k) const { return rays_[k]; }
    [[nodiscard]] const Sample& sample(std::size_t k) const { return samples_[k]; }

    /// Traces the rays and forgets them; calls use(sample, share) for each, with the share of its
    /// light that arrives [-]. Returns how many there were.
    template <class Use>
    std::size_t trace(const Tracer& tracer, const Use& use) {
        blocked_.resize(rays_.size());
        tracer.occluded_stream(rays_, targets_, blocked_);
        for (std::size_t k = 0; k < rays_.size(); ++k)
            use(samples_[k], blocked_[k] != 0 ? 0.0 : tracer.passed(rays_[k]));
        const std::size_t traced = rays_.size();
        clear();
        return traced;
    }
    /// Does the same where nothing can be in the way, without rays.
    template <class Use>
    void take_all(const Use& use) {
        for (const Sample& sample : samples_)
            use(sample, 1.0);
        clear();
    }
    void clear() {
        rays_.clear();
        targets_.clear();
        samples_.clear();
    }

  private:
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> targets_;
    std::vector<Sample> samples_;
    std::vector<std::uint8_t> blocked_; ///< results of those that were traced last
};

} // namespace hemilux
