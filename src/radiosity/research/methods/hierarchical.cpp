// Hierarchical radiosity (reference 6 of the paper; Hanrahan, Salzman and Aupperle 1991).
//
// Light goes over links between nodes of trees over the patches (hierarchy/patch_tree.h). Links
// join large nodes where little light is exchanged, down to patches where it is much. A link is
// divided while the power that the receiver may reflect by it, B F A rho, is more than a share of
// all that is reflected. The next step allows a sixteenth of that share. The factor of a link is
// the mean of a few pairs of points of its nodes, each with a ray for the visibility
// (hierarchy/links.h). Light is pulled up the trees, gathered over the links and pushed down again,
// until the solution with these factors is found (by GMRES in place of repeated gathering).
//
// The parameter is --rays, the rays of a patch in the first step; each step has twice as many as
// the one before. They are shared among the links by the light they may carry, one at least for
// each. Where the scene is open, as many rays look for losses. A patch exchanges with itself what
// its row lacks to 1 less these losses, or has too much. That closes rows and is right on average,
// which scaling noisy rows would not be.
//
// Eight independent batches of factors give eight solutions; their mean is the result, and their
// spread is one part of its standard error. The other part is by how much the last refinement has
// changed the light, as each about halves the errors of nodes. So it is known from the second step
// on, and rather too large. Links none of whose rays arrived count with the rule of three.
//
// The method is good where many patches exchange little light each: large walls in small patches.
// It is bad where each facet is a plane of its own, as on curved surfaces: all roots are linked
// with all. It is consistent, not unbiased: a solution depends on its factors in a non-linear way,
// and nodes have one light.

#include "radiosity/engine/linear/batch_solutions.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/check_input.h"
#include "radiosity/research/hierarchy/link_errors.h"
#include "radiosity/research/hierarchy/links.h"
#include "radiosity/research/hierarchy/lost_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t batches = 8;
/// The share of all reflected power that a link may bring in the first step, and the factor on it
/// from each step to the next. While the reflected power is not known, the emitted power stands for
/// it.
constexpr double first_tolerance = 1e-3, finer_tolerance = 1.0 / 16;
/// The rays per patch at which the run ends whatever the error.
constexpr double max_rays = 1u << 20;
/// The most points of a link in one batch.
constexpr std::uint32_t max_points = 8192;
/// These estimate the memory: a link with its factors in all batches takes so many bytes, and a
/// patch has about so many links.
constexpr double bytes_per_link = 100, links_per_patch = 150;
/// Black patches count as if they had this reflectance: they account for what they absorb.
constexpr double min_reflectance = .1;

class HierarchicalSolver final : public EngineSolver {
  public:
    explicit HierarchicalSolver(const SolverInput& input)
        : input_(input), solution_(solution_before_steps(input)), workers_(input.options.threads),
          batches_(input, batches, solution_), tree_(input.mesh), links_(input.mesh, tree_),
          lost_rays_(input.mesh, input.tracer, input.options.seed, batches), surfaces_(input.mesh),
          changes_(input.mesh.patches().size()),
          rays_(std::clamp(input.options.rays, 1.0, max_rays)) {
        for (const Vec3& reflectance : surfaces_.reflectance)
            mean_reflectance_.push_back(std::max(mean_of_channels(reflectance), min_reflectance));
        solution_.error_batches = batches;
        emitted_ = mean_of_channels(emitted_power(input.mesh));
    }

    bool step() override {
        SearchForWayOut search(input_);
        if (emitted_ > 0)
            refinement_ =
                links_.refine(means(solution_.radiosity), mean_reflectance_, tolerance_ * power());
        for (;;) {
            const std::optional<bool> done = try_step(search);
            if (done)
                return *done;
            rays_ *= 2;
            search.go_on(traced_, rays_ < max_rays);
        }
    }

    [[nodiscard]] bool finished() const override {
        return rays_ > max_rays || (solution_.steps > 0 && !input_.needs.bounces);
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    /// Returns the reflected power, mean of channels, in local units.
    [[nodiscard]] double reflected() const {
        double sum = 0;
        for (std::size_t i = 0; i < surfaces_.area.size(); ++i)
            sum += surfaces_.area[i] *
                   mean_of_channels(solution_.radiosity[i] - surfaces_.emission[i]);
        return sum;
    }
    /// Returns the power by which links are judged: hardly any of what a sun emits may arrive
    /// anywhere.
    [[nodiscard]] double power() const {
        const double arrived = reflected();
        return arrived > 0 ? std::min(arrived, emitted_) : emitted_;
    }

    [[nodiscard]] static std::vector<double> means(std::span<const Vec3> light) {
        std::vector<double> result;
        for (const Vec3& value : light)
            result.push_back(mean_of_channels(value));
        return result;
    }

    /// Returns whether it was not interrupted; nothing if the rays have seen no way out for the
    /// light.
    [[nodiscard]] std::optional<bool> try_step(const SearchForWayOut& search) {
        input_.monitor.phase = "rays";
        if (!input_.needs.closed)
            traced_ += lost_rays_.trace_up_to(rays_, surfaces_.emission, workers_, input_.monitor);
        if (input_.monitor.interrupted)
            return false;
        std::vector<LinkFactors> factors;
        const std::vector<std::uint32_t> points = share_rays();
        for (std::uint64_t r = 0; r < batches; ++r) {
            factors.emplace_back(
                input_.mesh, input_.tracer, tree_, links_, points,
                hash_words({input_.options.seed, solution_.steps, std::uint64_t(rays_), r}),
                workers_, input_.monitor);
            input_.monitor.step_share = .5 + double(r + 1) / (2 * batches);
            if (input_.monitor.interrupted)
                return false;
            traced_ += factors.back().rays();
        }
        const std::vector<NormalisedRows> rows = normalise_rows(lost_rays_, row_sums(factors));
        const std::optional<bool> solved =
            batches_.solve(search, solution_, [&](std::size_t r, std::vector<Vec3>& radiosity) {
                return solve(factors[r], rows[r], radiosity);
            });
        if (!solved || !*solved)
            return solved;
        combine(points, factors);
        solution_.rays_energy = traced_;
        solution_.figures.set("links", links_.all().size());
        ++solution_.steps;
        rays_ *= 2;
        tolerance_ *= finer_tolerance;
        return true;
    }

    /// Returns the points of each link in a batch, in proportion to what they bring to the error,
    /// as far as that is known. Nodes that no light has reached yet count with a share of the mean.
    [[nodiscard]] std::vector<std::uint32_t> share_rays() const {
        const auto links = links_.all();
        std::vector<double> light(tree_.nodes().size()), rho(tree_.nodes().size()), weight;
        tree_.pull(means(solution_.radiosity), light);
        tree_.pull(mean_reflectance_, rho);
        double area = 0, sum = 0;
        for (const double of_patch : surfaces_.area)
            area += of_patch;
        const double mean_light = emitted_ / area;
        for (const Link& link : links) {
            const PatchTree::Node &to = tree_[link.to], &from = tree_[link.from];
            weight.push_back(rough_factor(to, from) * (light[link.from] + mean_light) *
                             rho[link.to] * std::sqrt(to.area));
            sum += weight.back();
        }
        const double all = rays_ * double(surfaces_.area.size()) / double(batches);
        std::vector<std::uint32_t> points;
        for (const double of_link : weight) {
            const double wanted = sum > 0 ? std::ceil(all * of_link / sum) : 1;
            points.push_back(
                static_cast<std::uint32_t>(std::clamp(wanted, 1.0, double(max_points))));
        }
        return points;
    }

    /// Returns the sums of the rows, by batch and patch.
    [[nodiscard]] std::vector<std::vector<double>>
    row_sums(std::span<const LinkFactors> factors) const {
        const std::vector<double> ones(surfaces_.area.size(), 1.0);
        std::vector<std::vector<double>> sums(batches, ones);
        for (std::size_t r = 0; r < batches; ++r)
            factors[r].multiply(ones, sums[r]);
        return sums;
    }

    /// Solves one batch, from its last solution on.
    SolvedBatch solve(const LinkFactors& factors, const NormalisedRows& rows,
                      std::vector<Vec3>& radiosity) const {
        return solve_closed(
            [&](auto x, auto y) {
                factors.multiply(x, y);
                for (std::size_t i = 0; i < y.size(); ++i)
                    y[i] += rows.self[i] * x[i];
            },
            {surfaces_.area, surfaces_.emission, surfaces_.reflectance, rows.lost,
             lost_rays_.rays_of_batch(), input_.needs.closed},
            input_, radiosity);
    }

    void combine(std::span<const std::uint32_t> points, std::span<const LinkFactors> factors) {
        const std::vector<Vec3> before = solution_.radiosity;
        const std::vector<Vec3> variance = batches_.combine(solution_);
        note_hits(points);
        if (links_.are_whole()) // links between patches alone err by nothing
            changes_.assign(changes_.size(), Vec3(0.0));
        if (solution_.steps > 0 && refinement_ == Refinement::done) {
            changes_ = squares_of_changes(tree_, surfaces_.area, before, solution_.radiosity);
            changes_known_ = true;
        }
        note_errors(variance,
                    missed_over_links(tree_, links_, factors, points, solution_.radiosity));
        batches_.add_unsolved_to(solution_);
    }

    /// Counts as the hits of a patch the points of all links by which it gathers.
    void note_hits(std::span<const std::uint32_t> points) {
        std::vector<double> by_node(tree_.nodes().size()), by_patch(surfaces_.area.size());
        for (std::size_t l = 0; l < points.size(); ++l)
            by_node[links_.all()[l].to] += double(points[l]) * batches;
        tree_.push(by_node, by_patch);
        for (std::size_t i = 0; i < by_patch.size(); ++i)
            solution_.hits[i] = static_cast<std::uint64_t>(by_patch[i]);
    }

    void note_errors(std::span<const Vec3> variance, std::span<const Vec3> missed) {
        solution_.missed = 0;
        const double loss = input_.needs.closed
                                ? 0
                                : lost_rays_.uncertain_light(surfaces_.area, solution_.radiosity,
                                                             surfaces_.emission);
        const bool known = solution_.steps > 0
                               ? changes_known_ || links_.are_whole() || !(reflected() > 0)
                               : !input_.needs.bounces;
        for (std::size_t i = 0; i < variance.size(); ++i) {
            const Vec3 level = loss * (solution_.radiosity[i] - surfaces_.emission[i]);
            const Vec3 more = changes_[i] + level * level +
                              surfaces_.reflectance[i] * surfaces_.reflectance[i] * missed[i];
            solution_.missed += surfaces_.area[i] * glm::dot(more, Vec3(1.0));
            solution_.standard_error[i] = known ? glm::sqrt(variance[i] + more) : Vec3(unknown);
        }
        if (!known)
            solution_.variance = unknown;
    }

    SolverInput input_;
    Solution solution_;
    Workers workers_;
    BatchSolutions batches_;
    PatchTree tree_;
    Links links_;
    LostRays lost_rays_;
    Surfaces surfaces_;
    std::vector<double> mean_reflectance_;
    double emitted_ = 0; ///< power, mean of channels, local units
    /// The squares of what the last refinement has changed (squares_of_changes), if there was any.
    std::vector<Vec3> changes_;
    bool changes_known_ = false;
    Refinement refinement_ = Refinement::not_needed; ///< state in this step
    double tolerance_ = first_tolerance;
    double rays_; ///< rays per patch, of the next step
    std::uint64_t traced_ = 0;
};

} // namespace

extern const Method hierarchical_method{
    .name = "hierarchical",
    .summary = "links between large and small parts of surfaces (Hanrahan et al. 1991)",
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .05},
    .make = make_solver_of<HierarchicalSolver>,
    .work = {.linear_systems = true, .passes = true},
    .bytes =
        [](const SolveOptions&, double patches) {
            return bytes_per_link * patches * std::min(patches, links_per_patch);
        },
};

} // namespace hemilux
