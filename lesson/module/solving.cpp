// The methods, step by step.

#include "module/calls.h"
#include "module/own_strategy.h"
#include "module/room.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/solution/solution.h"

#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

using namespace hemilux;
using namespace hemilux::lesson;

namespace {

/// A solver with what it refers to. The room outlives it.
struct Run {
    Run(const Room& of, const SolveOptions& with) : room(of), options(with) {}
    [[nodiscard]] SolverInput input() {
        return {room.mesh, room.tracer, options, monitor, room.needs};
    }

    const Room& room;
    SolveOptions options;
    Monitor monitor;
    std::unique_ptr<Solver> solver;
};

/// Sets options of the method from a text such as "--guide pyramid".
void set_own_options(const Method& method, SolveOptions& options, std::string_view text) {
    if (text.empty())
        return;
    const std::string_view name = text.substr(0, text.find(' '));
    const std::string_view value = name.size() < text.size() ? text.substr(name.size() + 1) : "yes";
    for (const MethodOption& option : method.own_options())
        if (option.name == name && option.set(options, value))
            return;
    throw std::invalid_argument("no option of this method: " + std::string(text));
}

std::span<const Vec3> colours_of(const double* numbers, const Room& room) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    return {reinterpret_cast<const Vec3*>(numbers), room.mesh.patches().size()};
}

} // namespace

/// Begins to solve a room and puts the handle of the run. `page`: 1 for the method's page. `own`:
/// one option of the method, or nothing. A seed has 53 bits at most.
LESSON_CALL bool run_new(const Room* room, const char* name, int page, double rays, int depth,
                         double threshold, int literal, double seed, double steps,
                         const char* own) {
    return answered([&] {
        const Method* const method = find_method(name);
        if (!method || (page && !method->plain))
            throw std::invalid_argument(std::string("no such method: ") + name);
        SolveOptions options{.rays = rays,
                             .depth = depth,
                             .threshold = threshold,
                             .literal = literal != 0,
                             .seed = static_cast<std::uint64_t>(seed),
                             .threads = 1};
        if (steps > 0)
            options.stop.steps = static_cast<std::uint32_t>(steps);
        else
            options.stop = method->default_stop;
        set_own_options(*method, options, own);
        auto run = std::make_unique<Run>(*room, options);
        if (page) {
            run->solver = method->plain(run->input());
        } else {
            auto solver = method->make(run->input());
            if (options.stop.error)
                solver->aim_at(*options.stop.error);
            run->solver = std::move(solver);
        }
        put(handle_of(run.release()));
    });
}

/// Begins to solve a room by a strategy of the page's own (own_strategy.h).
LESSON_CALL bool run_own(const Room* room, const double* triangles, std::uint32_t count, int depth,
                         int from_centre, int rounded, double rays, double seed) {
    return answered([&] {
        auto run =
            std::make_unique<Run>(*room, SolveOptions{.rays = rays,
                                                      .depth = depth,
                                                      .seed = static_cast<std::uint64_t>(seed),
                                                      .threads = 1});
        const OwnRules rules{.from_centre = from_centre != 0, .rounded = rounded != 0};
        run->solver = own_strategy(run->input(), {triangles, count}, rules);
        put(handle_of(run.release()));
    });
}

LESSON_CALL void run_delete(const Run* run) { delete run; }

/// Takes a step. Puts 1 if the run has ended by itself.
LESSON_CALL bool run_step(Run* run) {
    return answered([&] {
        if (!run->solver->step())
            throw std::runtime_error("the step was interrupted");
        put(run->solver->finished() ? 1 : 0);
    });
}

/// Puts the radiosity of each patch [W/m2].
LESSON_CALL bool run_light(const Run* run) {
    return answered([&] {
        for (const Vec3& B : run->solver->solution().radiosity)
            put(B);
    });
}

/// Puts the standard error of the radiosity of each patch [W/m2].
LESSON_CALL bool run_errors(const Run* run) {
    return answered([&] {
        for (const Vec3& error : run->solver->solution().standard_error)
            put(error);
    });
}

/// Puts: steps, energy rays, density rays, bytes of densities, estimated error [-]; emitted,
/// absorbed, escaped and unshot power, means of the channels [W].
LESSON_CALL bool run_figures(const Run* run) {
    return answered([&] {
        const Solution& solution = run->solver->solution();
        put(solution.steps);
        put(double(solution.rays_energy));
        put(double(solution.rays_density));
        put(double(solution.bytes_density));
        put(estimated_error(run->room.mesh, solution));
        const EnergyBalance& energy = solution.energy;
        for (const Vec3& power : {energy.emitted, energy.absorbed, energy.escaped, energy.unshot})
            put(mean_of_channels(power));
    });
}

/// Puts the error of a radiosity relative to that of a reference [-].
LESSON_CALL bool room_error(const Room* room, const double* radiosity, const double* reference) {
    return answered([&] {
        put(true_error(room->mesh, colours_of(radiosity, *room), colours_of(reference, *room)).all);
    });
}
