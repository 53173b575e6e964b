#pragma once
// Tracers that something else follows in the midst of a step.

#include "bvh/tracer.h"

#include <atomic>
#include <functional>
#include <utility>

namespace hemilux::test {

/// Calls `watch` with each stream of rays before it is traced.
class WatchedTracer : public Tracer {
  public:
    using Watch = std::function<void(std::span<const Ray>)>;
    WatchedTracer(const Tracer& tracer, Watch watch) : tracer_(tracer), watch_(std::move(watch)) {}
    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override {
        return tracer_.closest(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        return tracer_.occluded(ray, target);
    }
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override { return tracer_.count(ray); }
    void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const override {
        watch_(rays);
        tracer_.closest_stream(rays, out);
    }

  private:
    const Tracer& tracer_;
    Watch watch_;
};

/// Does something when so many streams of rays have been traced.
class AfterStreams final : public WatchedTracer {
  public:
    template <class What>
    AfterStreams(const Tracer& tracer, int streams, const What& what)
        : WatchedTracer(tracer,
                        [this, what](std::span<const Ray>) {
                            if (--left_ == 0)
                                what();
                        }),
          left_(streams) {}

  private:
    mutable std::atomic<int> left_;
};

} // namespace hemilux::test
