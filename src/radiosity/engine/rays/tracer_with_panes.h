#pragma once
// Traces rays of light through panes: a tracer of facets, and the panes that stand between them.
//
// A ray that meets a facet has crossed panes that let a share s of light through. It goes on to the
// facet with probability s, else it ends in a pane and meets nothing. So each ray that arrives
// carries all of its light, which is right on average. What decides is a hash of the ray's origin
// and direction: a ray has the same answer whenever, wherever and with whatever others it is
// traced.
//
// Where rays need not be whole, they carry a share of their light instead. That keeps the gain of
// well distributed rays, which chance would take, and is right also for a ray that is always the
// same. Shadow rays do so: occluded() leaves panes out, and passed() has what they let through.
// Gathers do so by of_facets() and passed().

#include "bvh/tracer.h"
#include "radiosity/engine/rays/panes.h"

#include <memory>

namespace hemilux {

class TracerWithPanes final : public Tracer {
  public:
    /// `facets` traces the facets of the mesh.
    TracerWithPanes(std::unique_ptr<Tracer> facets, const Mesh& mesh);

    /// Returns the nearest facet that the ray reaches; nothing where it ends in a pane.
    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override;
    /// Returns whether a facet is on the way; panes do not count.
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target = none) const override;
    /// Counts facets; panes do not count.
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override;
    void count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const override;
    void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const override;
    void occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                         std::span<std::uint8_t> out) const override;
    [[nodiscard]] Hit locate(const Ray& ray, std::uint32_t facet) const override;
    [[nodiscard]] double passed(const Ray& ray) const override;
    [[nodiscard]] const Tracer& of_facets() const override { return *facets_; }

  private:
    [[nodiscard]] bool goes_through(const Ray& ray, double t) const;

    std::unique_ptr<Tracer> facets_;
    PaneCrossings panes_;
};

} // namespace hemilux
