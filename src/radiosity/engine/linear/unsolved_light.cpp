#include "radiosity/engine/linear/unsolved_light.h"

#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solution/solve_error.h"

#include <cmath>
#include <limits>

namespace hemilux {

double unsolved_error(double residual, double lost_at_least) {
    return lost_at_least > 0 ? residual / lost_at_least : std::numeric_limits<double>::infinity();
}

void check_bounded(double share) {
    if (!std::isfinite(share))
        throw SolveError("light is reflected for so long that the solver does not come to its end, "
                         "and surfaces of reflectance 1 leave no bound of the error. A reflectance "
                         "below 1 gives one",
                         0);
}

void add_unsolved(double share, const Mesh& mesh, Solution& solution) {
    if (!(share > 0))
        return;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i) {
        const Vec3 off = share * (solution.radiosity[i] - mesh.material(i).emission);
        const Vec3 before = solution.standard_error[i];
        solution.missed += mesh.patches()[i].area * glm::dot(off, off);
        solution.standard_error[i] = glm::sqrt(before * before + off * off);
    }
}

} // namespace hemilux
