// Stored transport: rays give form factors in both directions, and a linear system all bounces.
//
// Each patch looks around along well-distributed rays and keeps which patches they hit, not what
// light they brought (stored_rays.h). What two patches saw of each other is put together, and all
// rows are closed (exchange_matrix.h). All bounces are solved on the result by conjugate gradients
// (transport_system.h): no ray is traced twice for another bounce. Small emitters are reached by
// shadow rays with their exact factor (direct_light.h).
//
// The parameter is --rays, the rays of the first step, half of them random, half to the emitters.
// Each step adds as many, or as many as there are, or as many as an error asked for will take
// (ray_plan.h). They are of the kind that the error comes from. Four independent batches of both
// give four solutions, whose spread gives the standard error (step_errors.h); the result is the
// solution of all rays together.
//
// The method is consistent: the solution depends on what was counted in a non-linear way, so its
// bias falls as one over the rays, and its error more slowly. It is good nearly everywhere: it
// needs ten to fifty times fewer rays than shooting, most where light is even and surfaces reflect
// much. It costs 4 bytes per patch and patch that it saw, and twice as many more to solve.

#include "radiosity/engine/stored_transport/page/stored_transport.h"
#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/emitters/point_emitters.h"
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/linear/energy_ledger.h"
#include "radiosity/engine/linear/unsolved_light.h"
#include "radiosity/engine/saving/solution_state.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/relighting.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/engine/solving/transport_figures.h"
#include "radiosity/engine/stored_transport/batch_light.h"
#include "radiosity/engine/stored_transport/importance.h"
#include "radiosity/engine/stored_transport/ray_plan.h"
#include "radiosity/engine/stored_transport/row_spread.h"
#include "radiosity/engine/stored_transport/step_errors.h"
#include "radiosity/engine/stored_transport/stored_rays.h"
#include "radiosity/engine/stored_transport/transport_errors.h"
#include "radiosity/engine/stored_transport/transport_system.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/check_input.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

constexpr unsigned batches = StoredRays::batches;

/// The bytes that are needed to put counts together, for each byte of them: they have as many as an
/// entry of a matrix, and each stands in two rows.
constexpr double merging = 4;

/// The bytes of a random ray: a count, two entries, and room to grow.
constexpr double bytes_per_ray = 16;

/// The bytes of a patch besides its rays: the light of each batch, the rows of the system, the
/// errors, the plan of its rays.
constexpr double bytes_per_patch = 1300;

class StoredTransportSolver final : public EngineSolver, public KeepsRays {
  public:
    explicit StoredTransportSolver(const SolverInput& input)
        : input_(input), solution_(solution_before_steps(input)), workers_(input.options.threads),
          rays_(input), system_(input.mesh, rays_.emitters(), input.needs.closed,
                                power_of_points(input.mesh, input.tracer)),
          aim_(input.mesh, input.target), plan_(first_plan(input, rays_.has_shadow_rays())),
          light_(input.mesh.patches().size()) {
        solution_.standard_error.assign(input.mesh.patches().size(), Vec3(0.0)); // can be saved
        plan_.aim(aim_.importance());
    }

    bool step() override {
        SearchForWayOut search(input_);
        std::optional<bool> done;
        while (!(done = try_step(search)))
            search.go_on(traced_, !finished() && room_to_grow() >= RayPlan::min_growth);
        return *done;
    }

    void aim_at(double error) override { plan_.aim_at(error); }
    [[nodiscard]] bool finished() const override {
        return plan_.at_most() || (1 + least_growth) * double(traced_) > max_rays() ||
               (solution_.steps > 0 && traced_ == traced_before_);
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

    /// Saves the state, also within a step that was interrupted.
    void save(StateWriter& state) const override {
        light_.save(state);
        state.add(std::uint64_t{planned_});
        state.add(traced_);
        errors_.save(state);
        aim_.save(state);
        plan_.save(state);
        rays_.save(state);
        save_solution(solution_, state);
    }
    void load(StateReader& state) override {
        light_.load(state);
        rays_.renew(light_.generation());
        planned_ = state.flag();
        state.get(traced_);
        errors_.load(state);
        aim_.load(state);
        plan_.aim(aim_.importance());
        plan_.load(state);
        rays_.load(state);
        load_solution(solution_, state);
        solution_.figures.set(transport_figures::unneeded, aim_.unneeded());
        if (!plan_.has_begun() && (planned_ || solution_.steps > 0))
            throw StateError("steps were done without a plan");
    }

    [[nodiscard]] std::unique_ptr<Relighting> relighting(const Workers& workers) const override;

  private:
    class ByItsRays;
    static RayPlan first_plan(const SolverInput& input, bool shadow_rays) {
        const double each = input.options.rays / (shadow_rays ? 2 * batches : batches);
        return {input.mesh, input.needs, each, shadow_rays ? each : 0,
                RayGoal{!input.options.stop.steps, input.options.stop.error.value_or(0)}};
    }

    /// Returns whether it was not interrupted; nothing if the rays have seen no way out for the
    /// light.
    [[nodiscard]] std::optional<bool> try_step(const SearchForWayOut& search) {
        if (!plan_.has_begun() && !begin())
            return false;
        plan();
        constexpr double share_of_rays = 2.0 / 3;
        if (!trace(share_of_rays))
            return false;
        input_.monitor.phase = "solving";
        const double error = solution_.steps > 0 ? estimated_error(input_.mesh, solution_)
                                                 : std::numeric_limits<double>::quiet_NaN();
        std::vector<BatchLight::Light> found = light_.solved();
        const TransportSystem::Solved solved = system_.solve(
            rays_.counts(), rays_.direct(), error, found, workers_, input_.monitor.interrupted);
        if (input_.monitor.interrupted)
            return false;
        planned_ = false;
        drained_ = std::ranges::all_of(
            found, [&](const BatchLight::Light& light) { return search.is_drained(light.energy); });
        if (!drained_)
            return std::nullopt;
        check_bounded(solved.unsolved);
        light_.solved() = std::move(found);
        for (std::size_t s = 0; s <= batches; ++s)
            check_finite(input_.mesh, light_.solved()[s].incident, "the light that reaches",
                         solution_.steps + 1);
        combine(solved);
        return true;
    }

    /// Finds by a few rays the parts of the scene that light can reach, which alone get more.
    [[nodiscard]] bool begin() {
        plan_.begin();
        if (!trace(0))
            return false;
        if (!input_.options.keep_all)
            plan_.leave_out(rays_.lit_patches(system_.emission()));
        if (aim_.has_target())
            renew_aim();
        return true;
    }

    void renew_aim() {
        aim_.renew(input_.mesh, system_, rays_.factors(system_.area(), workers_), workers_);
        plan_.aim(aim_.importance());
    }

    /// Traces the rays that are planned. Returns whether it was not interrupted.
    [[nodiscard]] bool trace(double share_of_step) {
        input_.monitor.phase = "rays";
        traced_ += rays_.trace_up_to(plan_.rays(), share_of_step, workers_);
        return !input_.monitor.interrupted;
    }

    /// Plans the rays of a step, unless an interrupted step is to be taken up.
    void plan() {
        if (planned_)
            return;
        traced_before_ = traced_;
        if (aim_.is_outdated())
            renew_aim();
        const double relative = solution_.steps > 0 ? errors_.relative(input_.mesh, solution_) : 0;
        const double room = room_to_grow();
        if (room >= RayPlan::min_growth) {
            plan_.grow({relative, errors_.variance, errors_.from_emitters, drained_}, room,
                       max_rays() / batches, workers_);
        } else { // as many rays as before, all anew
            light_.begin_generation();
            rays_.renew(light_.generation());
        }
        planned_ = true;
    }

    [[nodiscard]] double max_rays() const {
        const std::optional<std::uint64_t>& rays = input_.options.stop.rays;
        return rays ? double(*rays) : std::numeric_limits<double>::infinity();
    }

    /// Returns how many times as many rays may be stored.
    [[nodiscard]] double room_to_grow() const {
        const auto stored = static_cast<double>(rays_.bytes_of_hits());
        return input_.options.memory == 0 || solution_.steps == 0
                   ? std::numeric_limits<double>::infinity()
                   : static_cast<double>(input_.options.memory) / (merging * stored);
    }

    /// Sets what the step has found, how large its error may be, and what the next step depends on.
    void combine(const TransportSystem::Solved& solved) {
        const ExchangeMatrix& all = solved.factors;
        const RowSpread rows = spread_of_rows(all, set_light(), workers_);
        const TransportResult result{input_.mesh, system_, light_,         rays_.counts(),
                                     all,         rows,    rays_.direct(), input_.target};
        const BatchSpread spread = spread_of_batches(result, aim_, workers_);
        TransportErrors errors = errors_of(result, workers_);
        if (input_.options.keep_all)
            keep_all_patches(errors);
        errors_ = StepErrors(errors, spread);
        report(errors, spread, input_.needs, solution_);
        add_unsolved(solved.unsolved, input_.mesh, solution_);
        if (aim_.has_target()) {
            aim_.step_done(errors.part, errors.lit);
            solution_.figures.set(transport_figures::unneeded, aim_.unneeded());
            plan_.aim(aim_.importance());
        }
        plan_.weigh(rows.variance, errors.needs_rays);
        plan_.weigh_emitters(spread.direct_variances, errors.lit);
        account();
        solution_.figures.set(transport_figures::bytes,
                              all.bytes() + rays_.direct().bytes() + rays_.bytes_of_counts());
        ++solution_.steps;
    }

    /// Lets all patches have rays: as if all were lit, and of one part.
    static void keep_all_patches(TransportErrors& errors) {
        errors.lit.assign(errors.lit.size(), true);
        errors.needs_rays = errors.lit;
        errors.part.assign(errors.part.size(), 0);
    }

    /// Sets the light of all patches. Returns what each sends that random rays must find.
    std::vector<Vec3> set_light() {
        std::vector<Vec3> sent;
        for (std::uint32_t i = 0; i < solution_.radiosity.size(); ++i) {
            const Vec3 reflected = system_.reflectance()[i] * light_.incident(batches, i);
            solution_.radiosity[i] = system_.emission()[i] + reflected;
            solution_.hits[i] =
                rays_.direct().hits(i) + std::uint64_t{plan_.rays().random[i]} * batches;
            sent.push_back(reflected + system_.sampled_emission()[i]);
        }
        return sent;
    }

    void account() {
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        const EnergyBalance local = light_.energy();
        solution_.energy = {to_world * local.emitted, to_world * local.absorbed,
                            to_world * local.escaped, Vec3(0.0)};
        solution_.rays_energy = traced_;
    }

    SolverInput input_;
    Solution solution_;
    Workers workers_;
    StoredRays rays_;
    TransportSystem system_;
    TargetAim aim_;
    RayPlan plan_;
    BatchLight light_;
    StepErrors errors_;    ///< errors of the last step
    bool planned_ = false; ///< rays of the present step, which may have been traced in part
    bool drained_ = true;  ///< the rays of the last try have seen a way out for the light
    std::uint64_t traced_ = 0,
                  traced_before_ = 0; ///< rays in all, and when the last step was planned
};

/// The light is the mean of the solutions by the batches' rays, its error their spread.
class StoredTransportSolver::ByItsRays final : public Relighting {
  public:
    ByItsRays(const StoredTransportSolver& solver, const Workers& workers)
        : solver_(solver), factors_(solver.system_.factors(solver.rays_.counts(), workers)) {}

    [[nodiscard]] std::optional<Relit> light_of(const Mesh& mesh, double share,
                                                const Workers& workers) const override {
        const Monitor& monitor = solver_.input_.monitor;
        const std::vector<std::uint32_t> emitters = emitters_in(mesh);
        DirectLight shadow_rays = shadow_rays_to(emitters, mesh);
        shadow_rays.sample_up_to(samples(share), workers, solver_.input_.monitor);
        const TransportSystem system(mesh, emitters, solver_.input_.needs.closed,
                                     power_of_points(mesh, solver_.input_.tracer));
        BatchLight light(mesh.patches().size());
        system.solve_batches(factors_, shadow_rays, std::numeric_limits<double>::quiet_NaN(),
                             light.solved(), workers, monitor.interrupted);
        if (monitor.interrupted)
            return std::nullopt;
        Relit relit;
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
            Vec3 squares(0.0);
            for (const Vec3& off : light.deviations(i))
                squares += off * off;
            const Vec3& reflectance = system.reflectance()[i];
            relit.radiosity.push_back(system.emission()[i] +
                                      reflectance * light.incident(batches, i));
            relit.standard_error.push_back(reflectance *
                                           glm::sqrt(squares / double(batches * (batches - 1))));
        }
        return relit;
    }

  private:
    /// Returns those of the solver's emitters that emit in this mesh; all of a facet or none.
    [[nodiscard]] std::vector<std::uint32_t> emitters_in(const Mesh& mesh) const {
        const auto material_of = [](const Mesh& of, std::uint32_t patch) {
            return of.scene().facets[of.patches()[patch].facet].material;
        };
        std::vector<std::uint32_t> emitters;
        for (const std::uint32_t emitter : solver_.rays_.emitters())
            if (material_of(mesh, emitter) == material_of(solver_.input_.mesh, emitter))
                emitters.push_back(emitter);
        return emitters;
    }
    [[nodiscard]] DirectLight shadow_rays_to(std::span<const std::uint32_t> emitters,
                                             const Mesh& mesh) const {
        const SolverInput& input = solver_.input_;
        std::vector<std::uint64_t> seeds;
        for (std::uint64_t s = 0; s < batches; ++s)
            seeds.push_back(hash_words({input.options.seed, s, solver_.light_.generation(), 2}));
        return {mesh,     input.tracer,     input.needs,
                emitters, std::move(seeds), ranks_of(input.monitor.interrupted)};
    }
    [[nodiscard]] std::vector<std::uint32_t> samples(double share) const {
        constexpr double least = 4;
        std::vector<std::uint32_t> samples;
        for (const std::uint32_t planned : solver_.plan_.rays().to_emitters)
            samples.push_back(
                planned > 0 ? std::uint32_t(std::ceil(std::max(share * planned, least))) : 0);
        return samples;
    }

    const StoredTransportSolver& solver_;
    std::vector<ExchangeMatrix> factors_; ///< by batch
};

std::unique_ptr<Relighting> StoredTransportSolver::relighting(const Workers& workers) const {
    return std::make_unique<ByItsRays>(*this, workers);
}

} // namespace

extern const Method stored_transport_method{
    .name = "stored-transport",
    .summary = "rays are kept and all bounces solved on them; lamps by shadow rays",
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .01},
    .make = make_solver_of<StoredTransportSolver>,
    .work = {.pairs = true},
    .takes_points = true,
    .saves = true,
    .plain = plain::stored_transport,
    .max_plain_patches = plain::max_patches_of_stored_transport,
    .role = Role::standard,
    .aims = [] { return true; },
    .bytes =
        [](const SolveOptions& options, double patches) {
            return bytes_per_patch * patches +
                   bytes_per_ray * patches * std::min(patches, options.rays);
        },
    .former_name = "gathering",
};

} // namespace hemilux
