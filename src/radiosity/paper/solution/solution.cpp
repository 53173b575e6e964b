#include "radiosity/paper/solution/solution.h"

#include "geometry/compensated_sum.h"
#include "geometry/elementary.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double squared(const Vec3& v) { return glm::dot(v, v); }

/// The ratio sqrt(sum of squared errors / sum of squared values); NaN where there is no value.
struct Ratio {
    double error = 0, value = 0;
    [[nodiscard]] double root() const { return value > 0 ? std::sqrt(error / value) : nan; }
    /// Adds a patch by its standard error, and the light that it reflects.
    void add(const Mesh& mesh, const Solution& solution, std::uint32_t patch, double weight) {
        const double area = weight * mesh.patches()[patch].area;
        error += area * squared(solution.standard_error[patch]);
        value += area * squared(solution.radiosity[patch] - mesh.material(patch).emission);
    }
};

} // namespace

double EnergyBalance::imbalance() const {
    const double most = std::max({emitted.x, emitted.y, emitted.z});
    if (!(most > 0))
        return 0;
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
        CompensatedSum<double> off; // powers may be many times what is emitted
        for (const double power : {emitted[c], -absorbed[c], -escaped[c], -unshot[c]})
            off += power;
        const double share = std::abs(off.value()) / (emitted[c] > 0 ? emitted[c] : most);
        if (std::isnan(share))
            return share;
        largest = std::max(largest, share);
    }
    return largest;
}

RelativeError true_error(const Mesh& mesh, std::span<const Vec3> radiosity,
                         std::span<const Vec3> reference, const std::vector<bool>& detail) {
    Ratio all, inside, outside;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const double area = mesh.patches()[i].area;
        const double error = area * squared(radiosity[i] - reference[i]);
        const double value = area * squared(reference[i] - mesh.material(i).emission);
        Ratio& part = !detail.empty() && detail[i] ? inside : outside;
        for (Ratio* ratio : {&all, &part}) {
            ratio->error += error;
            ratio->value += value;
        }
    }
    return {all.root(), inside.root(), outside.root()};
}

double estimated_error(const Mesh& mesh, const Solution& solution) {
    Ratio all;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i)
        all.add(mesh, solution, i, solution.weight_of(i));
    if (solution.variance)
        all.error = *solution.variance;
    all.value -= all.error; // the square of an estimate is too large by its variance
    if (all.error > 0) {
        const double more = error_spread_besides_level(mesh, solution).reported();
        const double of_level = ErrorSpread{1, solution.level_freedom}.reported();
        const double rest = std::max(all.error - solution.variance_of_level, 0.0);
        all.error = std::max(all.error,
                             more * more * rest + of_level * of_level * solution.variance_of_level);
    }
    all.error += solution.missed;
    if (!solution.may_find_light && all.error == 0)
        return 0;
    // An error relative to light that is less than the error has no meaning. A single ray that
    // found a patch may stand for many times what truly arrives.
    return all.error > all.value ? nan : all.root();
}

double estimated_error_elsewhere(const Mesh& mesh, const Solution& solution) {
    Ratio rest;
    for (std::uint32_t i = 0; i < solution.weight.size(); ++i)
        if (!(solution.weight[i] > 0))
            rest.add(mesh, solution, i, 1);
    rest.value -= rest.error; // as above
    return rest.error > rest.value ? nan : rest.root();
}

ZScores z_scores(const Mesh& mesh, const Solution& solution, std::span<const Vec3> reference,
                 std::span<const Vec3> reference_error, std::uint64_t min_hits) {
    ZScores z;
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
        if (solution.hits[i] < min_hits)
            continue;
        for (int c = 0; c < 3; ++c) {
            const double sigma =
                elementary::hypot(solution.standard_error[i][c], reference_error[i][c]);
            if (!(sigma > 0))
                continue;
            const double score = (solution.radiosity[i][c] - reference[i][c]) / sigma;
            sum += score;
            squares += score * score;
            z.largest = std::max(z.largest, std::abs(score));
            ++z.count;
        }
    }
    const auto n = static_cast<double>(z.count);
    z.mean = z.count > 0 ? sum / n : nan;
    z.rms = z.count > 0 ? std::sqrt(squares / n) : nan;
    return z;
}

} // namespace hemilux
