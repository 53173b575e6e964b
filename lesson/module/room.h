#pragma once
// A scene of the lesson with its patches and its tracer, which can note the rays that it traces.

#include "bvh/tracer.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/scene/needs.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace hemilux::lesson {

struct NotedRay {
    Vec3 from, to; ///< local frame; where the ray leaves the scene, a point far away
    std::uint32_t patch;
    bool escaped; ///< else, without a patch, it met the back of a face
};

/// Asks another tracer, and notes the first rays whose nearest hit is asked for.
class NotingTracer final : public Tracer {
  public:
    NotingTracer(const Mesh& mesh, std::unique_ptr<Tracer> tracer)
        : mesh_(mesh), tracer_(std::move(tracer)) {}

    /// Forgets what was noted, and notes the next `rays`.
    void note(std::size_t rays);
    [[nodiscard]] const std::vector<NotedRay>& noted() const { return noted_; }

    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        return tracer_->occluded(ray, target);
    }
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override { return tracer_->count(ray); }
    void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const override;
    void occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                         std::span<std::uint8_t> out) const override {
        tracer_->occluded_stream(rays, targets, out);
    }
    [[nodiscard]] Hit locate(const Ray& ray, std::uint32_t facet) const override {
        return tracer_->locate(ray, facet);
    }

  private:
    void note(const Ray& ray, const std::optional<Hit>& hit) const;

    const Mesh& mesh_;
    std::unique_ptr<Tracer> tracer_;
    std::size_t room_for_ = 0;
    mutable std::vector<NotedRay> noted_;
};

struct Room {
    Room(Scene scene, double max_edge);

    Mesh mesh;
    Needs needs;
    NotingTracer tracer;
};

} // namespace hemilux::lesson
