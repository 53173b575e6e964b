#pragma once
// A tracer that does something in the midst of a step.

#include "bvh/tracer.h"

#include <atomic>

namespace hemilux::test {

/// Does something when so many streams of rays have been traced.
template <class What>
class AfterStreams final : public Tracer {
  public:
    AfterStreams(const Tracer& tracer, int streams, const What& what)
        : tracer_(tracer), left_(streams), what_(what) {}
    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override {
        return tracer_.closest(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        return tracer_.occluded(ray, target);
    }
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override { return tracer_.count(ray); }
    void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const override {
        if (--left_ == 0)
            what_();
        tracer_.closest_stream(rays, out);
    }

  private:
    const Tracer& tracer_;
    mutable std::atomic<int> left_;
    What what_;
};

} // namespace hemilux::test
