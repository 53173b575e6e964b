// Hemisphere subdivision (paper section 5; Plemenos and Jolivet 1998).
//
// Before solving, each patch counts along few rays how many surfaces lie in each direction. It
// divides the triangles of its hemisphere where the mean count is above a threshold (density.h).
// Each step then shoots rays in proportion to power and density:
//
//     N_tr = N_hemi A_tr / A_hemi D_tr / D_average,   Phi_tr = Phi_patch A_tr / A_hemi.
//
// A is the projected solid angle, so that Lambert's law holds whatever the triangles
// (docs/paper/decisions.md, D1). D_average is weighted by the same areas, so that the N_tr sum to
// N_hemi (D4). With --literal, A is the solid angle, as printed: the light is then distributed
// wrongly, however many rays are shot.
//
// The method is good where small objects crowd in few directions. It is of little use where a wall
// hides a crowd, to which it sends rays in vain. It costs at most 41 rays and bytes per patch at
// depth 2. With --guide, other densities or another strategy guide its rays (guide.h).

#include "radiosity/engine/densities/density.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/shooting/shooting.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {
namespace {

class HemisphereStrategy final : public Strategy {
  public:
    HemisphereStrategy(const SolverInput& input, const Hemisphere& hemisphere,
                       const Workers& workers)
        : needs_(input.needs), printed_(input.options.literal) {
        for (std::size_t cell = 0; cell < hemisphere.cells().size(); ++cell)
            area_shares_.push_back(power_share(hemisphere, static_cast<std::uint16_t>(cell),
                                               shooting_rules(input.options).area));
        allocate_leaves(leaves_of_one_surface(hemisphere, input.options.threshold),
                        allocated_of_one_surface_);
        if (input.needs.visibility)
            densities_ = find_densities(input, hemisphere, workers);
        const std::size_t cells = hemisphere.cells().size() * input.mesh.patches().size();
        if (densities_ && cells <= max_kept_cells && !input.monitor.interrupted)
            keep_allocated(input, workers);
    }

    Allocation allocate(std::uint32_t patch, AllocatedCells& memory) const override {
        if (!densities_ || !needs_.power(patch))
            return allocated_of_one_surface_.view();
        if (!kept_.empty())
            return kept_[patch].view();
        allocate_densities(patch, memory);
        return memory.view();
    }

    [[nodiscard]] std::uint64_t density_rays() const override {
        return densities_ ? densities_->rays() : 0;
    }
    [[nodiscard]] std::uint64_t density_rays_spared() const override {
        return densities_ ? densities_->rays_spared() : 0;
    }
    [[nodiscard]] std::uint64_t density_bytes() const override {
        return densities_ ? densities_->bytes() : 0;
    }

  private:
    [[nodiscard]] static std::unique_ptr<LeafDensities>
    find_densities(const SolverInput& input, const Hemisphere& hemisphere, const Workers& workers) {
        const SolveOptions& options = input.options;
        if (const Guide* const guide = guide_of(options); guide && guide->densities)
            return guide->densities(input, hemisphere, workers);
        return std::make_unique<DensityMap>(
            input.mesh, input.tracer, hemisphere, options.threshold, workers, input.monitor,
            input.needs, options.keep_all ? DensityStore::everything : DensityStore::divided_only);
    }

    /// In a scene of at most so many cells, what is allocated is kept, 440 bytes per patch. Patches
    /// shoot few rays at a time there, and walking their trees each time takes 1.3 times the
    /// instructions of a step (room_1002). Large scenes need only the bytes.
    static constexpr std::size_t max_kept_cells = 2'000'000;

    void keep_allocated(const SolverInput& input, const Workers& workers) {
        kept_.resize(input.mesh.patches().size());
        workers.for_chunks(kept_.size(), 64, [&](std::size_t begin, std::size_t end) {
            AllocatedCells allocated;
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
                if (input.needs.power(i)) {
                    allocate_densities(i, allocated);
                    kept_[i] = allocated;
                }
        });
    }

    void allocate_densities(std::uint32_t patch, AllocatedCells& allocated) const {
        thread_local std::vector<DensityLeaf> leaves;
        densities_->leaves(patch, leaves);
        allocate_leaves(leaves, allocated);
    }

    /// Returns what a patch of a convex enclosure would count: one surface in each direction.
    [[nodiscard]] static std::vector<DensityLeaf>
    leaves_of_one_surface(const Hemisphere& hemisphere, double threshold) {
        const int level = is_divided(1, threshold) ? hemisphere.depth() : 0;
        std::vector<DensityLeaf> leaves;
        for (std::size_t c = 0; c < hemisphere.cells().size(); ++c)
            if (hemisphere.cells()[c].level == level)
                leaves.push_back({static_cast<std::uint16_t>(c), 1});
        return leaves;
    }

    void allocate_leaves(const std::vector<DensityLeaf>& leaves, AllocatedCells& allocated) const {
        double average = 0; // D_average
        for (const DensityLeaf& leaf : leaves)
            average += area_shares_[leaf.cell] * leaf.density;
        const double least = std::max(min_density, min_share * average);
        const auto due = [&](const DensityLeaf& leaf) {
            const double density = leaf.density; // D_tr
            return area_shares_[leaf.cell] * (printed_ ? density : std::max(density, least));
        };
        double sum = 0;
        for (const DensityLeaf& leaf : leaves)
            sum += due(leaf);
        allocated.clear();
        for (const DensityLeaf& leaf : leaves) // as printed, where nothing was seen there is no ray
            allocated.add(leaf.cell, sum > 0 ? due(leaf) / sum : 0);
    }

    /// A triangle whose three vertices saw nothing may still hold something. It counts as at least
    /// one surface, and as at least a share of the average, so that no ray carries more than five
    /// times the mean. Where nothing is seen anywhere, rays then follow the power (D5).
    static constexpr double min_density = 1, min_share = 0.25;

    const Needs& needs_;
    bool printed_;
    std::vector<double> area_shares_; ///< shares by cell
    std::unique_ptr<LeafDensities> densities_;
    AllocatedCells allocated_of_one_surface_; ///< cells of patches without densities
    std::vector<AllocatedCells> kept_;        ///< cells by patch, in small scenes
};

std::unique_ptr<Strategy> make_hemisphere(const SolverInput& input, const Hemisphere& hemisphere,
                                          const Workers& workers) {
    const Guide* const guide = guide_of(input.options);
    if (guide && guide->strategy && input.needs.visibility)
        return guide->strategy(input, hemisphere, workers);
    return std::make_unique<HemisphereStrategy>(input, hemisphere, workers);
}

constexpr std::string_view counted_densities = "density";

bool set_guide(SolveOptions& options, std::string_view name) {
    const auto guides = additions().guides;
    const auto found = std::ranges::find(guides, name, &Guide::name);
    if (found == guides.end() && name != counted_densities)
        return false;
    set_own_options(options, GuideChoice{.guide = found == guides.end() ? nullptr : *found});
    return true;
}

std::string name_of_guide(const SolveOptions& options) {
    const Guide* const guide = own_options<GuideChoice>(options).guide;
    return std::string(guide ? guide->name : counted_densities);
}

/// Returns --guide, where there is more than one to choose from.
std::vector<MethodOption> options() {
    if (additions().guides.empty())
        return {};
    MethodOption guide{.name = "--guide",
                       .help = "what guides it [density]",
                       .values = {std::string(counted_densities)},
                       .set = set_guide,
                       .get = name_of_guide,
                       .on_page = false,
                       .makes_variants = true};
    for (const Guide* const added : additions().guides)
        guide.values.emplace_back(added->name);
    return {guide};
}

std::vector<std::string> implied_by() {
    std::vector<std::string> names{"--depth", "--threshold"};
    for (const MethodOption& own : options())
        names.push_back(own.name);
    names.emplace_back("--literal");
    return names;
}

/// Counted densities take a byte by vertex, and the array is copied as it grows.
double bytes(const SolveOptions& options, double patches) {
    if (const Guide* const guide = guide_of(options))
        return guide->bytes(options.depth, patches);
    return 2 * patches * double(Hemisphere(options.depth).vertices().size());
}

} // namespace

extern const Method hemisphere_method{
    .name = "hemisphere",
    .summary = "hemisphere subdivision guided by densities (Plemenos and Jolivet 1998; paper 5)",
    .has_literal = true,
    .has_depth = true,
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_hemisphere, true>,
    .strategy = make_hemisphere,
    .work = {.densities = true, .passes = true},
    .plain = plain::hemisphere,
    .role = Role::paper,
    .aims = has_aimer,
    .options = options,
    .bytes = bytes,
    .implied_by = implied_by,
};

} // namespace hemilux
