#include "app/commands/divided_hemispheres.h"

#include "parallel/workers.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/engine/shooting/guide.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/sampling/rng.h"

namespace hemilux {

namespace {

/// A source of directions in triangles, each of which gets its expected number on average:
/// systematic rounding.
class RayDrawer {
  public:
    RayDrawer(std::uint64_t seed, std::uint32_t patch)
        : rng_(hash_words({seed, patch})), due_(rng_.uniform()) {}
    void draw(const SphericalTriangle& triangle, double expected) {
        due_ += expected;
        for (; due_ >= 1; due_ -= 1)
            rays.push_back(triangle.sample_rejection([&] { return rng_.uniform(); }));
    }
    std::vector<Vec3> rays;

  private:
    Rng rng_;
    double due_;
};

/// The hemispheres of section 5, divided by counts or by what --guide names.
class ByDensity final : public DividedHemispheres {
  public:
    ByDensity(const SolverInput& input, const Workers& workers)
        : input_(input), workers_(workers), hemisphere_(input.options.depth),
          guide_(guide_of(input.options)) {
        if (guide_) {
            leaves_ = guide_->densities(input, hemisphere_, workers);
            return;
        }
        auto counted = std::make_unique<DensityMap>(
            input.mesh, input.tracer, hemisphere_, input.options.threshold, workers, input.monitor);
        counted_ = counted.get();
        leaves_ = std::move(counted);
    }

    [[nodiscard]] std::vector<DrawnTriangle> triangles(std::uint32_t patch,
                                                       std::size_t) const override {
        std::vector<DensityLeaf> leaves;
        leaves_->leaves(patch, leaves);
        std::vector<DrawnTriangle> result;
        for (const DensityLeaf& leaf : leaves)
            result.push_back({hemisphere_.cells()[leaf.cell].shape, double(leaf.density)});
        return result;
    }
    [[nodiscard]] std::vector<CountedDirection> counted(std::uint32_t patch,
                                                        std::size_t) const override {
        std::vector<DensityCount> counts;
        if (counted_)
            counted_->counts(patch, counts);
        std::vector<CountedDirection> result;
        for (const DensityCount& count : counts)
            result.push_back({hemisphere_.vertices()[count.vertex], double(count.surfaces)});
        return result;
    }
    [[nodiscard]] std::vector<Vec3> rays(std::uint32_t patch, std::size_t,
                                         std::uint32_t number) const override {
        const auto strategy = method_of(Role::paper).strategy(input_, hemisphere_, workers_);
        AllocatedCells memory;
        const Allocation allocation = strategy->allocate(patch, memory);
        RayDrawer drawer(input_.options.seed, patch);
        for (std::size_t k = 0; k < allocation.cells.size(); ++k)
            drawer.draw(hemisphere_.cells()[allocation.cells[k]].shape,
                        allocation.rays(k) * number);
        return drawer.rays;
    }
    [[nodiscard]] std::string unit() const override {
        return guide_ ? std::string(guide_->unit) : DividedHemispheres::unit();
    }
    [[nodiscard]] std::uint64_t density_rays() const override { return leaves_->rays(); }
    [[nodiscard]] std::uint64_t bytes() const override { return leaves_->bytes(); }

  private:
    SolverInput input_;
    Workers workers_;
    Hemisphere hemisphere_;
    const Guide* guide_;
    std::unique_ptr<LeafDensities> leaves_;
    const DensityMap* counted_ = nullptr; ///< leaves_, unless they are the guide's
};

/// The hemispheres of section 4: the triangles of the last guided step.
class Of1997 final : public DividedHemispheres {
  public:
    Of1997(const SolverInput& input, const Workers& workers)
        : seed_(input.options.seed),
          subdivision_(input.mesh, input.needs,
                       own_options<Subdivision1997Options>(input.options)) {
        const Subdivision1997Options& numbers = own_options<Subdivision1997Options>(input.options);
        level_ = static_cast<int>(numbers.stored_steps + numbers.estimated_steps);
        subdivision_.find(level_, input.tracer, workers, input.monitor);
    }

    [[nodiscard]] std::size_t parts() const override { return subdivision_.parts(); }
    [[nodiscard]] std::vector<DrawnTriangle> triangles(std::uint32_t patch,
                                                       std::size_t part) const override {
        std::vector<DrawnTriangle> result;
        for (std::size_t k = 0; k < Subdivision1997::triangles(level_); ++k) {
            const auto [a, b, c] = subdivision_.triangle(patch, part, level_, k);
            result.push_back({{a.direction, b.direction, c.direction},
                              (a.surfaces + b.surfaces + c.surfaces) / 3});
        }
        return result;
    }
    [[nodiscard]] std::vector<CountedDirection> counted(std::uint32_t patch,
                                                        std::size_t part) const override {
        return subdivision_.counted(patch, part);
    }
    /// Returns rays, on average the same number in every triangle.
    [[nodiscard]] std::vector<Vec3> rays(std::uint32_t patch, std::size_t part,
                                         std::uint32_t number) const override {
        RayDrawer drawer(seed_, patch);
        const auto all = static_cast<double>(Subdivision1997::triangles(level_));
        for (const DrawnTriangle& triangle : triangles(patch, part))
            drawer.draw(triangle.shape, number / all);
        return drawer.rays;
    }
    [[nodiscard]] std::uint64_t density_rays() const override { return subdivision_.rays(); }
    [[nodiscard]] std::uint64_t bytes() const override { return subdivision_.bytes(); }

  private:
    std::uint64_t seed_;
    Subdivision1997 subdivision_;
    int level_ = 0;
};

} // namespace

std::unique_ptr<DividedHemispheres> divide_hemispheres(const DensitySettings& settings,
                                                       const Mesh& mesh, const Tracer& tracer,
                                                       Monitor& monitor) {
    const SolverInput input{mesh, tracer, settings.options, monitor};
    const Workers workers(settings.options.threads);
    if (settings.method == &method_of(Role::forerunner))
        return std::make_unique<Of1997>(input, workers);
    return std::make_unique<ByDensity>(input, workers);
}

} // namespace hemilux
