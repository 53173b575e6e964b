#include "radiosity/paper/solution/error_spread.h"

#include "geometry/elementary.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace hemilux {
namespace {

/// Returns what Fisher's F with these degrees of freedom is below in 975 of 1000 cases. Its cube
/// root is nearly a ratio of normal variables (Paulson 1942).
double quantile_of_f(double above, double below) {
    constexpr double z = 1.96;
    const double a = 2 / (9 * above), b = 2 / (9 * below);
    const double root = std::sqrt((1 - b) * (1 - b) * a + (1 - a) * (1 - a) * b - z * z * a * b);
    const double below_of_ratio = (1 - b) * (1 - b) - z * z * b;
    return below_of_ratio <= 0
               ? std::numeric_limits<double>::infinity()
               : elementary::whole_power(((1 - a) * (1 - b) + z * root) / below_of_ratio, 3);
}

/// The largest number of degrees of freedom that a few batches can tell from any larger one.
constexpr double max_freedom = 16;

double freedom_by_patch(const Mesh& mesh, const Solution& solution) {
    const auto variance = [&](std::size_t i) {
        const Vec3& sigma = solution.standard_error[i];
        return solution.weight_of(i) * mesh.patches()[i].area * glm::dot(sigma, sigma);
    };
    std::vector<double> of_patch;
    for (std::size_t i = 0; i < solution.standard_error.size(); ++i)
        of_patch.push_back(variance(i));
    return effective_freedom_of(of_patch, 0);
}

} // namespace

double ErrorSpread::uncertainty() const { return 1 / std::sqrt(2 * freedom * batch_freedom); }

double ErrorSpread::bound() const {
    return std::sqrt(quantile_of_f(freedom, freedom * batch_freedom));
}

double ErrorSpread::reported() const {
    constexpr double tolerance = 1.5;
    const ErrorSpread careful{1 / (1 / freedom + 1 / max_freedom), batch_freedom};
    return std::max(1.0, careful.bound() / tolerance);
}

ErrorSpread error_spread_besides_level(const Mesh& mesh, const Solution& solution) {
    const double batches = solution.error_batches > 0 ? solution.error_batches : solution.steps;
    if (!(batches > 1)) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        return {unknown, unknown};
    }
    return {solution.effective_freedom ? *solution.effective_freedom
                                       : freedom_by_patch(mesh, solution),
            batches - 1};
}

ErrorSpread error_spread(const Mesh& mesh, const Solution& solution) {
    ErrorSpread spread = error_spread_besides_level(mesh, solution);
    if (std::isfinite(solution.level_freedom) && solution.variance_of_level > 0) {
        const double all = solution.variance.value_or(0) / solution.variance_of_level;
        spread.freedom = std::min(spread.freedom, std::max(all * all, 1.0));
    }
    return spread;
}

double effective_freedom_of(std::span<const double> of_patch, double shared) {
    const double sum = std::accumulate(of_patch.begin(), of_patch.end(), 0.0);
    if (!(sum > 0))
        return std::numeric_limits<double>::infinity();
    double squares = 0; // of the shares, as those of variances may be too small
    for (const double variance : of_patch)
        squares += variance / sum * (variance / sum);
    squares = std::max(squares, shared / sum * (shared / sum));
    return squares > 0 ? std::max(1 / squares, 1.0) : std::numeric_limits<double>::infinity();
}

double effective_freedom(std::span<const double> products, std::size_t batches) {
    const double n = static_cast<double>(batches) - 1;
    double trace = 0, share = 0; // share: 1 / n to 1
    for (std::size_t s = 0; s < batches; ++s)
        trace += products[s * (batches + 1)];
    for (const double product : products)
        share += (product / trace) * (product / trace);
    const double freedom = (n + 1 - 2 * share) / (n * share - 1);
    return trace > 0 && freedom >= 0 ? std::max(freedom, 1.0)
                                     : std::numeric_limits<double>::infinity();
}

double believed_freedom(std::optional<double> before, double now) {
    return std::min(now, before.value_or(now));
}

} // namespace hemilux
