// Stored transport: rays tell form factors in both directions, and a linear system all bounces.
//
// Each patch looks around along well-distributed rays and keeps which patches they hit, not what
// light they brought (ray_counts.h). What two patches saw of each other is put together, all rows
// are closed (exchange_matrix.h), and all bounces are solved on the result by conjugate gradients
// (transport_system.h): no ray is traced twice for another bounce. Small emitters are reached by
// shadow rays with their exact factor (direct_light.h).
//
// Parameter: --rays, of the first step, half of them random, half to the emitters. Each step adds
// as many, or as many as there are, or as many as an error asked for will take (ray_plan.h), of the
// kind that the error comes from. Four independent batches of both give four solutions, whose
// spread is the standard error; the result is the solution of all rays together.
//
// Consistent: the solution depends on what was counted in a non-linear way, so its bias falls as
// one over the rays, and its error more slowly. Good nearly everywhere: it needs ten to fifty times
// fewer rays than shooting, most where light is even and surfaces reflect much. Costs 8 bytes per
// patch and patch that it saw, and twice as many more to solve.

#include "radiosity/emitters/direct_light.h"
#include "radiosity/emitters/small_emitters.h"
#include "radiosity/form_factors/exchange_matrix.h"
#include "radiosity/form_factors/ray_counts.h"
#include "radiosity/linear/energy_ledger.h"
#include "radiosity/plain/plain.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/saving/solution_state.h"
#include "radiosity/saving/state.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solution/error_spread.h"
#include "radiosity/solution/solve_error.h"
#include "radiosity/solving/check_input.h"
#include "radiosity/solving/method.h"
#include "radiosity/stored_transport/batch_light.h"
#include "radiosity/stored_transport/importance.h"
#include "radiosity/stored_transport/linked_parts.h"
#include "radiosity/stored_transport/ray_plan.h"
#include "radiosity/stored_transport/row_spread.h"
#include "radiosity/stored_transport/transport_errors.h"
#include "radiosity/stored_transport/transport_system.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

constexpr unsigned batches = 4;
constexpr std::size_t patches_per_chunk = 512;

/// Bytes that are needed to put counts together, for each byte of them.
constexpr double merging = 3.5;

class StoredTransportSolver final : public Solver {
  public:
    explicit StoredTransportSolver(const SolverInput& input)
        : input_(input), solution_(solution_before_steps(input)), workers_(input.options.threads),
          emitters_(small_emitters(input.mesh)), system_(input.mesh, emitters_, input.needs.closed),
          aim_(input.mesh, system_, input.target), plan_(first_plan(input, !emitters_.empty())),
          light_(batches, input.mesh.patches().size()) {
        solution_.standard_error.assign(input.mesh.patches().size(), Vec3(0.0)); // can be saved
        renew();
        plan_.aim(aim_.importance());
    }

    bool step() override {
        SearchForWayOut search(input_);
        std::optional<bool> done;
        while (!(done = try_step(search)))
            search.go_on(traced_, !finished() && room_to_grow() >= RayPlan::least_growth);
        return *done;
    }

    void aim_at(double error) override { plan_.aim_at(error); }

    /// Whether it was not interrupted; nothing where the rays have seen no way out for the light.
    [[nodiscard]] std::optional<bool> try_step(const SearchForWayOut& search) {
        if (!plan_.has_begun() && !begin())
            return false;
        plan();
        const auto& [rays, samples] = plan_.rays();
        input_.monitor.phase = "rays";
        constexpr double share_of_rays = 2.0 / 3;
        traced_ += RayCounts::trace_up_to(counts_, rays, workers_, input_.monitor, share_of_rays);
        traced_ += direct_->sample_up_to(samples, workers_, input_.monitor);
        if (input_.monitor.interrupted)
            return false;
        input_.monitor.phase = "solving";
        const double error = solution_.steps > 0 ? estimated_error(input_.mesh, solution_)
                                                 : std::numeric_limits<double>::quiet_NaN();
        std::vector<BatchLight::Light> found = light_.solved();
        const ExchangeMatrix all =
            system_.solve({counts_, *direct_}, error, found, workers_, input_.monitor.interrupted);
        if (input_.monitor.interrupted)
            return false;
        planned_ = false;
        drained_ = std::ranges::all_of(
            found, [&](const BatchLight::Light& light) { return search.is_drained(light.energy); });
        if (!drained_)
            return std::nullopt;
        light_.solved() = std::move(found);
        for (std::size_t s = 0; s <= batches; ++s)
            check_finite(input_.mesh, light_.solved()[s].incident, "the light that reaches",
                         solution_.steps + 1);
        combine(all);
        return true;
    }

    [[nodiscard]] bool finished() const override { return plan_.at_most(); }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

    /// Also within a step that was interrupted.
    void save(StateWriter& state) const override {
        light_.save(state);
        state.add(std::uint64_t{planned_});
        state.add(traced_);
        state.add(variance_);
        state.add(direct_variance_);
        state.add(in_dark_);
        aim_.save(state);
        plan_.save(state);
        for (const RayCounts& batch : counts_)
            batch.save(state);
        direct_->save(state);
        save_solution(solution_, state);
    }
    void load(StateReader& state) override {
        light_.load(state);
        renew();
        planned_ = state.flag();
        state.get(traced_);
        state.get(variance_, bounds::non_negative);
        state.get(direct_variance_, bounds::non_negative);
        state.get(in_dark_, bounds::non_negative);
        aim_.load(state);
        plan_.aim(aim_.importance());
        plan_.load(state);
        for (RayCounts& batch : counts_)
            batch.load(state);
        direct_->load(state);
        load_solution(solution_, state);
        solution_.unneeded = aim_.unneeded();
        if (!plan_.has_begun() && (planned_ || solution_.steps > 0))
            throw StateError("steps were done without a plan");
    }

  private:
    static RayPlan first_plan(const SolverInput& input, bool small_emitters) {
        const double each = input.options.rays / (small_emitters ? 2 * batches : batches);
        return {input.mesh, input.needs, each, small_emitters ? each : 0,
                RayGoal{!input.options.stop.steps, input.options.stop.error.value_or(0)}};
    }

    /// A few rays find the parts of the scene that light can reach, which alone get more.
    [[nodiscard]] bool begin() {
        plan_.begin();
        input_.monitor.phase = "rays";
        traced_ +=
            RayCounts::trace_up_to(counts_, plan_.rays().random, workers_, input_.monitor, 0);
        traced_ += direct_->sample_up_to(plan_.rays().to_emitters, workers_, input_.monitor);
        if (input_.monitor.interrupted)
            return false;
        const LinkedParts parts = find_linked_parts(counts_);
        std::vector<bool> lit_part(parts.count), lit;
        for (std::uint32_t i = 0; i < parts.of.size(); ++i)
            if (system_.emission()[i] != Vec3(0.0) || direct_->hits(i) > 0)
                lit_part[parts.of[i]] = true;
        for (const std::uint32_t part : parts.of)
            lit.push_back(lit_part[part]);
        plan_.leave_out(lit);
        if (aim_.has_target()) {
            aim_.begin(factors_so_far(), workers_);
            plan_.aim(aim_.importance());
        }
        return true;
    }

    [[nodiscard]] ExchangeMatrix factors_so_far() const {
        std::vector<ExchangeMatrix> parts(batches);
        for_batches(batches, input_.ranks, workers_, [&](std::size_t batch, const Workers& own) {
            parts[batch] = ExchangeMatrix(input_.mesh, counts_[batch], own);
        });
        return {std::move(parts), workers_};
    }

    /// Unless an interrupted step is to be taken up.
    void plan() {
        if (planned_)
            return;
        if (aim_.is_outdated()) {
            aim_.renew(factors_so_far(), workers_);
            plan_.aim(aim_.importance());
        }
        ErrorSoFar known{0, variance_, direct_variance_, drained_};
        if (solution_.steps > 0) {
            const double all = std::exchange(solution_.missed, solution_.missed - in_dark_);
            known.relative = estimated_error(input_.mesh, solution_);
            solution_.missed = all;
        }
        const double room = room_to_grow();
        if (room >= RayPlan::least_growth) {
            plan_.grow(known, room, workers_);
        } else { // as many rays as before, all anew
            light_.begin_generation();
            renew();
        }
        planned_ = true;
    }

    /// New rays, independent of all before.
    void renew() {
        counts_.clear();
        std::vector<std::uint64_t> seeds;
        for (std::uint64_t s = 0; s < batches; ++s) {
            const std::uint64_t seed = hash_words({input_.options.seed, s, light_.generation()});
            counts_.emplace_back(input_.mesh, input_.tracer, hash_words({seed, 0}), input_.ranks);
            seeds.push_back(hash_words({seed, 1}));
        }
        direct_.emplace(input_.mesh, input_.tracer, input_.needs, emitters_, std::move(seeds),
                        input_.ranks);
    }

    /// How many times as many rays may be stored.
    [[nodiscard]] double room_to_grow() const {
        std::uint64_t stored = 0;
        for (const RayCounts& batch : counts_)
            stored += batch.bytes();
        return input_.options.memory == 0 || solution_.steps == 0
                   ? std::numeric_limits<double>::infinity()
                   : static_cast<double>(input_.options.memory) /
                         (merging * static_cast<double>(stored));
    }

    /// How the batches differ, of some patches.
    struct Spread {
        std::array<double, batches * batches> products{}; ///< of deviations
        double direct_variance = 0;
    };

    void combine(const ExchangeMatrix& all) {
        const std::size_t n = solution_.radiosity.size();
        std::vector<Spread> parts((n + patches_per_chunk - 1) / patches_per_chunk);
        std::vector<double> direct_variances(n);
        std::vector<Vec3> light(n);
        workers_.for_chunks(n, patches_per_chunk, [&](std::size_t begin, std::size_t end) {
            Spread& part = parts[begin / patches_per_chunk];
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
                combine(i, part, light[i], direct_variances[i]);
        });
        Spread spread;
        for (const Spread& part : parts) {
            for (std::size_t k = 0; k < spread.products.size(); ++k)
                spread.products[k] += part.products[k];
            spread.direct_variance += part.direct_variance;
        }
        const RowSpread rows = spread_of_rows(all, light, workers_);
        TransportErrors errors = errors_of<batches>(
            {input_.mesh, system_, light_, all, rows, *direct_, input_.target}, workers_);
        direct_variance_ = spread.direct_variance + errors.missed_by_shadow_rays;
        in_dark_ = errors.missed_in_dark;
        variance_ = std::max(errors.variance + errors.missed - in_dark_, direct_variance_);
        solution_.standard_error = std::move(errors.standard_error);
        solution_.variance = errors.variance;
        solution_.variance_of_level = errors.of_losses;
        solution_.missed = errors.missed + errors.missed_by_shadow_rays;
        solution_.error_batches = batches;
        solution_.effective_freedom = believed_freedom(solution_.effective_freedom,
                                                       effective_freedom(spread.products, batches));
        solution_.unlit = 0;
        for (std::uint32_t i = 0; i < n; ++i)
            solution_.unlit += !errors.needs_rays[i] && input_.needs.power(i);
        if (aim_.has_target()) {
            aim_.step_done(errors.part, errors.lit);
            solution_.unneeded = aim_.unneeded();
            plan_.aim(aim_.importance());
        }
        plan_.weigh(rows.variance, errors.needs_rays);
        plan_.weigh_emitters(direct_variances, errors.lit);
        account();
        solution_.rays_energy = traced_;
        solution_.bytes_transport = all.bytes() + direct_->bytes();
        for (const RayCounts& batch : counts_)
            solution_.bytes_transport += batch.bytes();
        ++solution_.steps;
    }

    /// Of one patch; `light`: what it sends that random rays are to find.
    void combine(std::uint32_t i, Spread& spread, Vec3& light, double& direct_variance) {
        const double area = system_.area()[i];
        const Vec3 rho = system_.reflectance()[i], direct_mean = direct_->irradiance(i);
        const auto off = light_.deviations<batches>(i);
        Vec3 direct_squares(0.0);
        const double counts = input_.target.empty() ? 1 : input_.target[i];
        const Vec3 weight = counts * area * rho * rho;
        for (std::size_t s = 0; s < batches; ++s) {
            for (std::size_t t = 0; t < batches; ++t)
                spread.products[s * batches + t] += glm::dot(weight * off[s], off[t]);
            const Vec3 direct_off = direct_->irradiance(i, s) - direct_mean;
            direct_squares += direct_off * direct_off;
        }
        const Vec3 reflected = rho * light_.incident(batches, i);
        solution_.radiosity[i] = system_.emission()[i] + reflected;
        solution_.hits[i] = direct_->hits(i) + std::uint64_t{plan_.rays().random[i]} * batches;
        light = reflected + system_.sampled_emission()[i];
        direct_variance =
            area * glm::dot(rho * rho, direct_squares) / double(batches * (batches - 1));
        spread.direct_variance +=
            (aim_.has_target() ? aim_.counts_alone(i) : 1) * direct_variance / light_.generations();
        if (direct_->samples(i) == 0)
            direct_variance = -1;
    }

    void account() {
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        const EnergyBalance local = light_.energy();
        solution_.energy = {to_world * local.emitted, to_world * local.absorbed,
                            to_world * local.escaped, Vec3(0.0)};
    }

    SolverInput input_;
    Solution solution_;
    Workers workers_;
    std::vector<std::uint32_t> emitters_; ///< those reached by shadow rays
    TransportSystem system_;
    TargetAim aim_;
    RayPlan plan_;
    BatchLight light_;
    std::vector<RayCounts> counts_;
    std::optional<DirectLight> direct_; ///< an estimate for each batch
    bool planned_ = false; ///< rays of the present step, which may have been traced in part
    bool drained_ = true;  ///< the rays of the last try have seen a way out for the light
    double variance_ = 0, direct_variance_ = 0; ///< without what follows
    double in_dark_ = 0;                        ///< TransportErrors::missed_in_dark
    std::uint64_t traced_ = 0;
};

std::unique_ptr<Solver> make_stored_transport(const SolverInput& input) {
    return std::make_unique<StoredTransportSolver>(input);
}

} // namespace

extern const Method stored_transport_method;
const Method stored_transport_method{
    .name = "stored-transport",
    .summary = "rays are kept and all bounces solved on them; lamps by shadow rays",
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .01},
    .make = make_stored_transport,
    .strategy = nullptr,
    .work = {.pairs = true},
    .saves = true,
    .plain = plain::stored_transport,
    .most_plain_patches = plain::most_patches_of_stored_transport,
    .role = Role::standard,
    .aims = true,
    .bytes =
        [](const SolveOptions& options, double patches) {
            return bytes_per_factor * patches * std::min(patches, options.rays);
        },
    .former_name = "gathering",
};

} // namespace hemilux
