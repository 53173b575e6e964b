#include "radiosity/engine/linear/hemicube_matrix.h"

#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/linear/radiosity_system.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/check_input.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

class HemicubeMatrix final : public EngineSolver {
  public:
    explicit HemicubeMatrix(const SolverInput& input)
        : input_(input), solution_(solution_before_steps(input)) {
        solution_.standard_error.assign(input.mesh.patches().size(), Vec3(unknown));
    }

    bool step() override {
        const Workers workers(input_.options.threads);
        const Hemicube cube(own_options<FactorOptions>(input_.options).hemicube_edge);
        input_.monitor.phase = "hemicubes";
        const HemicubeFormFactors factors =
            hemicube_form_factors(cube, input_.mesh, input_.tracer, workers, input_.monitor);
        if (input_.monitor.interrupted)
            return false;
        input_.monitor.phase = "solving";
        // Whether it is solved is checked below, as its error is not estimated.
        const std::vector<Vec3> incident =
            arriving_light([&](auto x, auto y) { factors.matrix.multiply(x, y, workers); },
                           input_.mesh, solution_.radiosity, input_.needs)
                .incident;
        if (input_.monitor.interrupted)
            return false;
        check_solved(factors.matrix, incident, workers);
        const EnergyBalance energy = balance(factors, incident);
        for (std::uint32_t i = 0; i < incident.size(); ++i) {
            const Material& material = input_.mesh.material(i);
            solution_.radiosity[i] = material.emission + material.reflectance * incident[i];
        }
        check_finite(input_.mesh, solution_.radiosity, "the radiosity", 1);
        solution_.energy = energy;
        solution_.hits.assign(incident.size(), cube.pixels());
        solution_.rays_energy = factors.rays;
        solution_.steps = 1;
        return true;
    }

    [[nodiscard]] bool finished() const override { return solution_.steps > 0; }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    /// Throws SolveError where light ends nowhere, as there is no solution: between surfaces of
    /// reflectance 1 whose pixels show no way out.
    void check_solved(const SparseMatrix& f, std::span<const Vec3> incident,
                      const Workers& workers) const {
        constexpr double negligible = 1e-6; // of the most light that arrives anywhere
        std::vector<double> leaving(incident.size()), arriving(incident.size());
        for (int c = 0; c < 3; ++c) {
            double most = 0, off = 0;
            for (std::uint32_t i = 0; i < incident.size(); ++i) {
                const Material& material = input_.mesh.material(i);
                leaving[i] = material.emission[c] + material.reflectance[c] * incident[i][c];
                most = std::max(most, incident[i][c]);
            }
            f.multiply(leaving, arriving, workers);
            for (std::size_t i = 0; i < incident.size(); ++i)
                off = std::max(off, std::abs(arriving[i] - incident[i][c]));
            if (!(off <= negligible * most))
                throw SolveError("the pixels of the hemicubes do not show where light leaves the "
                                 "scene or is absorbed: the opening is small. More pixels "
                                 "(--factors hemicube:N) or --factors rays look for it",
                                 0);
        }
    }

    [[nodiscard]] EnergyBalance balance(const HemicubeFormFactors& factors,
                                        std::span<const Vec3> incident) const {
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        EnergyBalance energy;
        for (std::uint32_t i = 0; i < incident.size(); ++i) {
            const Material& material = input_.mesh.material(i);
            const double area = to_world * input_.mesh.patches()[i].area;
            const Vec3 leaving = area * (material.emission + material.reflectance * incident[i]);
            const EscapeFraction& lost = factors.lost[i];
            energy.emitted += area * material.emission;
            energy.escaped += lost.escaped * leaving;
            energy.absorbed +=
                area * (1.0 - material.reflectance) * incident[i] + lost.absorbed * leaving;
        }
        energy.unshot = energy.emitted - energy.absorbed - energy.escaped;
        return energy;
    }

    SolverInput input_;
    Solution solution_;
};

} // namespace

std::unique_ptr<EngineSolver> make_hemicube_matrix(const SolverInput& input) {
    return std::make_unique<HemicubeMatrix>(input);
}

} // namespace hemilux
