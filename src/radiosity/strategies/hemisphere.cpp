// Hemisphere subdivision (paper section 5; Plemenos and Jolivet 1998).
//
// Before solving, each patch counts along few rays how many surfaces lie in each direction and
// divides the triangles of its hemisphere where the mean count is above a threshold (density.h).
// Each step then shoots rays in proportion to power and density:
//
//     N_tr = N_hemi A_tr / A_hemi D_tr / D_average,   Phi_tr = Phi_patch A_tr / A_hemi.
//
// A is the projected solid angle, so that Lambert's law holds whatever the triangles (D1), and
// D_average is weighted by the same areas, so that the N_tr sum to N_hemi (D4). With --literal A is
// the solid angle, as printed: the light is then distributed wrongly, however many rays are shot.
//
// Good where small objects crowd in few directions; little use where a wall hides a crowd, to
// which it sends rays in vain. Costs at most 41 rays and bytes per patch at depth 2. With --guide
// visible or learned rays follow what is seen instead, which the wall does not mislead
// (seen_guide.h).

#include "radiosity/density.h"
#include "radiosity/mesh.h"
#include "radiosity/seen_guide.h"
#include "radiosity/shooting.h"

#include <algorithm>
#include <numbers>
#include <optional>

namespace hemilux {
namespace {

class HemisphereStrategy final : public Strategy {
  public:
    HemisphereStrategy(const SolverInput& input, const Hemisphere& hemisphere,
                       const Workers& workers)
        : hemisphere_(hemisphere), literal_(input.options.literal) {
        for (const Hemisphere::Cell& cell : hemisphere.cells())
            area_shares_.push_back(area_share(cell));
        if (input.needs.densities)
            density_.emplace(input.mesh, input.tracer, hemisphere, input.options.threshold, workers,
                             input.monitor, input.needs,
                             input.options.keep_all ? DensityStore::everything
                                                    : DensityStore::divided_only);
        else
            deal_leaves(leaves_of_one_surface(input.options.threshold), shares_of_one_surface_);
        const std::size_t cells = hemisphere.cells().size() * input.mesh.patches().size();
        if (density_ && cells <= most_kept_cells && !input.monitor.interrupted)
            keep_dealt(input, workers);
    }

    void deal(std::uint32_t patch, std::vector<CellShare>& shares) const override {
        if (!density_) {
            shares = shares_of_one_surface_;
            return;
        }
        if (!dealt_.empty())
            shares = dealt_[patch];
        else
            deal_densities(patch, shares);
    }

    [[nodiscard]] std::uint64_t density_rays() const override {
        return density_ ? density_->rays() : 0;
    }
    [[nodiscard]] std::uint64_t density_rays_spared() const override {
        return density_ ? density_->rays_spared() : 0;
    }
    [[nodiscard]] std::uint64_t density_bytes() const override {
        return density_ ? density_->bytes() : 0;
    }

  private:
    /// In a small scene what is dealt is kept, 1.5 kB a patch: patches shoot few rays at a time,
    /// and walking their trees each time takes a tenth of the run. Large scenes need but the bytes.
    static constexpr std::size_t most_kept_cells = 2'000'000;

    void keep_dealt(const SolverInput& input, const Workers& workers) {
        dealt_.resize(input.mesh.patches().size());
        workers.for_chunks(dealt_.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
                if (input.needs.power(i))
                    deal_densities(i, dealt_[i]);
        });
    }

    void deal_densities(std::uint32_t patch, std::vector<CellShare>& shares) const {
        thread_local std::vector<DensityLeaf> leaves;
        density_->leaves(patch, leaves);
        deal_leaves(leaves, shares);
    }

    /// What a patch of a convex enclosure would count: one surface in each direction.
    [[nodiscard]] std::vector<DensityLeaf> leaves_of_one_surface(double threshold) const {
        const int level = threshold < 1 ? hemisphere_.depth() : 0;
        std::vector<DensityLeaf> leaves;
        for (std::size_t c = 0; c < hemisphere_.cells().size(); ++c)
            if (hemisphere_.cells()[c].level == level)
                leaves.push_back({static_cast<std::uint16_t>(c), 1});
        return leaves;
    }

    void deal_leaves(const std::vector<DensityLeaf>& leaves, std::vector<CellShare>& shares) const {
        shares.clear();
        double average = 0; // D_average
        for (const DensityLeaf& leaf : leaves) {
            shares.push_back({leaf.cell, area_shares_[leaf.cell], 0});
            average += shares.back().power * leaf.density;
        }
        deal_rays(leaves, average, shares);
    }

    /// A triangle whose three vertices saw nothing may still hold something: it counts as one
    /// surface, and as a share of the average, so that no ray carries more than five times the
    /// mean. Where nothing is seen anywhere, rays then follow the power (D5).
    static constexpr double least_density = 1, least_share = 0.25;

    /// A_tr / A_hemi
    [[nodiscard]] double area_share(const Hemisphere::Cell& cell) const {
        return literal_ ? cell.solid_angle / (2 * std::numbers::pi)
                        : cell.projected_solid_angle / std::numbers::pi;
    }

    void deal_rays(const std::vector<DensityLeaf>& leaves, double average,
                   std::vector<CellShare>& shares) const {
        const double least = std::max(least_density, least_share * average);
        double sum = 0;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const double density = leaves[i].density; // D_tr
            shares[i].rays = shares[i].power * (literal_ ? density : std::max(density, least));
            sum += shares[i].rays;
        }
        if (!(sum > 0)) // literal, and nothing was seen: no ray is shot, as printed
            return;
        for (CellShare& share : shares)
            share.rays *= 1 / sum;
    }

    const Hemisphere& hemisphere_;
    bool literal_;
    std::vector<double> area_shares_; ///< by cell
    std::optional<DensityMap> density_;
    std::vector<std::vector<CellShare>> dealt_;    ///< by patch, in small scenes
    std::vector<CellShare> shares_of_one_surface_; ///< of all patches, where there is no density_
};

std::unique_ptr<Strategy> make_hemisphere(const SolverInput& input, const Hemisphere& hemisphere,
                                          const Workers& workers) {
    const Guide guide = input.options.literal ? Guide::density : input.options.guide;
    if (guide != Guide::density && input.needs.densities)
        return make_seen_guide(input, hemisphere, workers, guide == Guide::learned);
    return std::make_unique<HemisphereStrategy>(input, hemisphere, workers);
}

} // namespace

extern const Method hemisphere_method;
const Method hemisphere_method{
    .name = "hemisphere",
    .summary = "hemisphere subdivision guided by densities (Plemenos and Jolivet 1998; paper 5)",
    .has_literal = true,
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_hemisphere>,
    .strategy = make_hemisphere,
    .work = {.densities = true, .passes = true},
};

} // namespace hemilux
