#include "radiosity/engine/linear/batch_solutions.h"

#include "geometry/compensated_sum.h"
#include "radiosity/engine/linear/unsolved_light.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"
#include "radiosity/paper/solution/solve_error.h"

namespace hemilux {

SolvedBatch solve_closed(const FormFactorProduct& multiply, const Transport& transport,
                         const SolverInput& input, std::vector<Vec3>& radiosity) {
    ArrivingLight light = arriving_light(multiply, input.mesh, radiosity, input.needs);
    const EnergyBalance energy = close_energy(transport, light.incident);
    for (std::size_t i = 0; i < radiosity.size(); ++i)
        radiosity[i] = transport.emission[i] + transport.reflectance[i] * light.incident[i];
    return {energy, light.unsolved};
}

BatchSolutions::BatchSolutions(const SolverInput& input, std::size_t batches,
                               const Solution& before)
    : input_(input), radiosity_(batches, before.radiosity) {}

std::optional<bool> BatchSolutions::solve(const SearchForWayOut& search, const Solution& last,
                                          const SolveBatch& solve_batch) {
    input_.monitor.phase = "solving";
    CompensatedSum<Vec3> absorbed, escaped;
    double unsolved = 0;
    bool drained = true;
    for (std::size_t r = 0; r < radiosity_.size(); ++r) {
        const SolvedBatch batch = solve_batch(r, radiosity_[r]);
        const EnergyBalance& energy = batch.energy;
        unsolved += batch.unsolved / double(radiosity_.size());
        absorbed += energy.absorbed;
        escaped += energy.escaped;
        drained = drained && search.is_drained(energy);
        if (input_.monitor.interrupted)
            return false;
    }
    if (!drained) {
        radiosity_.assign(radiosity_.size(), last.radiosity);
        return std::nullopt;
    }
    for (const std::vector<Vec3>& of_batch : radiosity_)
        check_finite(input_.mesh, of_batch, "the radiosity", last.steps + 1);
    check_bounded(unsolved);
    absorbed_ = absorbed.value() / double(radiosity_.size());
    escaped_ = escaped.value() / double(radiosity_.size());
    unsolved_ = unsolved;
    return true;
}

void BatchSolutions::add_unsolved_to(Solution& solution) const {
    add_unsolved(unsolved_, input_.mesh, solution);
}

std::vector<Vec3> BatchSolutions::combine(Solution& solution) const {
    const std::size_t count = radiosity_.size();
    std::vector<double> products(count * count);
    std::vector<Vec3> off(count), variance;
    solution.variance = 0;
    for (std::size_t i = 0; i < solution.radiosity.size(); ++i) {
        const double area = input_.mesh.patches()[i].area;
        Vec3 mean(0.0), squares(0.0);
        for (const std::vector<Vec3>& of_batch : radiosity_)
            mean += of_batch[i] / double(count);
        for (std::size_t r = 0; r < count; ++r) {
            off[r] = radiosity_[r][i] - mean;
            squares += off[r] * off[r];
        }
        for (std::size_t r = 0; r < count; ++r)
            for (std::size_t t = 0; t < count; ++t)
                products[r * count + t] += area * glm::dot(off[r], off[t]);
        solution.radiosity[i] = mean;
        variance.push_back(squares / double(count * (count - 1)));
        *solution.variance += area * glm::dot(variance.back(), Vec3(1.0));
    }
    solution.effective_freedom =
        believed_freedom(solution.effective_freedom, effective_freedom(products, count));
    const double to_world = input_.mesh.frame().area_to_world(1.0);
    solution.energy.absorbed = to_world * absorbed_;
    solution.energy.escaped = to_world * escaped_;
    solution.energy.unshot = Vec3(0.0);
    return pooled_over_neighbours(input_.mesh, variance);
}

} // namespace hemilux
