#pragma once
// The fast tracer: a tree with eight children a node and eight triangles a leaf, traversed in
// floats by vector instructions; what floats cannot decide is decided in doubles (wide_layout.h).
// It answers as Bvh and BruteForce do, bit for bit.

#include "bvh/wide/float_ray.h"
#include "bvh/wide/shaft.h"
#include "bvh/wide/wide_build.h"
#include "parallel/instruction_set.h"

#include <vector>

namespace hemilux {

struct WideBvhOptions {
    unsigned threads = 0; ///< threads that build the tree; 0: one per core
    InstructionSet kernels = chosen_instruction_set();
};

class WideBvh final : public Tracer {
  public:
    /// Facets with a coordinate that is not finite are never hit.
    explicit WideBvh(const FacetSoup& soup, const WideBvhOptions& options = {});

    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target = none) const override;
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override;
    void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const override;
    void occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                         std::span<std::uint8_t> out) const override;
    void count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const override;
    [[nodiscard]] Hit locate(const Ray& ray, std::uint32_t facet) const override;

    /// Returns how many triangles a ray that begins or passes there has to be tested against at
    /// least: those of the leaves whose boxes hold the point.
    [[nodiscard]] std::size_t triangles_around(const Vec3& point) const;

    /// Appends the facets that the tree cannot tell to be outside of a shaft, ascending and each
    /// once.
    void facets_within(const Shaft& shaft, std::vector<std::uint32_t>& facets) const;

    [[nodiscard]] const BvhQuality& quality() const { return built_.quality; }

  private:
    [[nodiscard]] wide::Tree tree() const;

    FacetSoup soup_;
    const wide::Kernels* kernels_;
    wide::Built built_;
    wide::Space space_;
};

} // namespace hemilux
