// End to end: the rays of whole steps, as they are traced, against
// N_tr = N_hemi A_tr / A_hemi D_tr / D_average (paper section 5b).
#include "parallel/workers.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "support/step_rays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// N_tr / N_hemi by the paper's formula, with A the projected solid angle (docs/paper/decisions.md,
/// D1, D4).
std::map<std::uint16_t, double> shares_by_density(const Hemisphere& hemisphere,
                                                  const std::vector<DensityLeaf>& leaves) {
    const auto area = [&](std::uint16_t cell) {
        return hemisphere.cells()[cell].projected_solid_angle / std::numbers::pi;
    };
    double average = 0;
    for (const DensityLeaf& leaf : leaves)
        average += area(leaf.cell) * leaf.density;
    std::map<std::uint16_t, double> shares;
    for (const DensityLeaf& leaf : leaves) {
        // Above the floors that keep a triangle with few surfaces from starving (D5).
        REQUIRE(leaf.density >= std::max(1.0, .25 * average));
        shares[leaf.cell] = area(leaf.cell) * leaf.density / average;
    }
    return shares;
}

/// The cell of each ray.
std::map<std::uint16_t, double> count(const Hemisphere& hemisphere, const Frame& frame,
                                      const std::map<std::uint16_t, double>& cells,
                                      const std::vector<Ray>& rays) {
    std::map<std::uint16_t, double> counts;
    std::size_t outside = 0;
    for (const Ray& ray : rays) {
        const Vec3 direction = frame.to_local(ray.direction);
        const auto found = std::ranges::find_if(cells, [&](const auto& cell) {
            return contains(hemisphere.cells()[cell.first].shape, direction);
        });
        if (found != cells.end())
            ++counts[found->first];
        else
            ++outside;
    }
    CHECK(outside == 0);
    return counts;
}

/// Compares the rays of many steps with `rays` times the shares of each patch that emits.
template <class SharesOf>
void check_steps(const Model& model, const char* method, const SolveOptions& options,
                 const SharesOf& shares_of) {
    const Hemisphere hemisphere(options.depth);
    const auto patches = static_cast<double>(model.mesh.patches().size());
    double power = 0;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        power += model.mesh.patches()[i].area * model.mesh.material(i).emission.x;
    constexpr int steps = 80;
    std::map<std::pair<std::uint32_t, std::uint16_t>, double> sums, due;
    Steps run(model, *find_method(method), options);
    (void)run.next();
    for (int k = 0; k < steps; ++k)
        for (const StepRays& from : run.next()) {
            const std::map<std::uint16_t, double> shares = shares_of(hemisphere, from.patch);
            const double N_hemi = options.rays * patches * model.mesh.patches()[from.patch].area *
                                  model.mesh.material(from.patch).emission.x / power;
            CHECK(std::abs(double(from.rays.size()) - N_hemi) < 1 + 1e-9);
            auto counts =
                count(hemisphere, model.mesh.hemisphere_frame(from.patch), shares, from.rays);
            double worst = 0;
            for (const auto& [cell, share] : shares) {
                worst = std::max(worst, std::abs(counts[cell] - N_hemi * share));
                sums[{from.patch, cell}] += counts[cell];
                due[{from.patch, cell}] = N_hemi * share;
            }
            CHECK(worst < 1 + 1e-4); // rounded up or down; running sums are floats
        }
    for (const auto& [cell, N_tr] : due) {
        const double up = N_tr - std::floor(N_tr), variance = steps * up * (1 - up);
        if (variance < 4)
            continue; // nearly always the same number
        CAPTURE(method, cell.first, cell.second, N_tr, sums[cell] / steps);
        CHECK(normal_p_value((sums[cell] - steps * N_tr) / std::sqrt(variance)) >
              sidak(significance, due.size()));
    }
}

} // namespace

TEST_CASE("Each triangle of each patch gets N_tr rays, whole steps end to end", "[slow]") {
    const Model model(black(room_with_block()));
    for (const int depth : {1, 2}) {
        SolveOptions options;
        options.depth = depth;
        options.rays = 60;
        Monitor monitor;
        const Hemisphere hemisphere(depth);
        const DensityMap densities(model.mesh, model.bvh, hemisphere, options.threshold, Workers(1),
                                   monitor);
        const auto by_density = [&](const Hemisphere& cells, std::uint32_t patch) {
            std::vector<DensityLeaf> leaves;
            densities.leaves(patch, leaves);
            return shares_by_density(cells, leaves);
        };
        check_steps(model, "hemisphere", options, by_density);
        check_steps(model, "stratified", options,
                    [&](const Hemisphere& cells, std::uint32_t patch) {
                        std::vector<DensityLeaf> leaves;
                        densities.leaves(patch, leaves);
                        for (DensityLeaf& leaf : leaves)
                            leaf.density = 1;
                        return shares_by_density(cells, leaves);
                    });
    }
}
