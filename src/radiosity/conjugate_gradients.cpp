#include "radiosity/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

/// 0 / 0 is 0: a channel that is done, or dark, stands still.
Vec3 ratio(const Vec3& a, const Vec3& b) {
    const auto one = [](double x, double y) { return y > 0 ? x / y : 0.0; };
    return {one(a.x, b.x), one(a.y, b.y), one(a.z, b.z)};
}

} // namespace

GradientResult solve_by_gradients(const ExchangeMatrix& factors, std::span<const double> area,
                                  std::span<const Vec3> reflectance, std::span<const Vec3> d,
                                  std::vector<Vec3>& h, const Workers& workers,
                                  const GradientOptions& options) {
    const std::size_t n = h.size();
    std::vector<Vec3> weight(n), r(n), p(n), q(n);
    std::vector<Lanes> reflected(n);
    std::vector<Vec3> part((n + factors.rows_per_chunk - 1) / factors.rows_per_chunk);
    /// Sum of term(i) over all patches, in an order that does not depend on the threads.
    const auto sum = [&](const auto& term) {
        factors.for_rows(workers, [&](std::size_t begin, std::size_t end) {
            Vec3 some(0.0);
            for (std::size_t i = begin; i < end; ++i)
                some += term(i);
            part[begin / factors.rows_per_chunk] = some;
        });
        return std::accumulate(part.begin(), part.end(), Vec3(0.0));
    };
    const auto reflect = [&](std::size_t i, const Vec3& x) {
        reflected[i] = factors.scaled(i, reflectance[i] * x);
    };
    const Vec3 size = sum([&](std::size_t i) {
        weight[i] = area[i] * reflectance[i];
        reflect(i, h[i]);
        return weight[i] * d[i] * d[i];
    });
    Vec3 squares = sum([&](std::size_t i) {
        r[i] = d[i] - (h[i] - factors.row_times(i, reflected));
        return weight[i] * r[i] * r[i];
    });
    Vec3 more(0.0);
    GradientResult result;
    const auto worst = [&] {
        const Vec3 share = glm::sqrt(ratio(squares, size));
        return std::max({share.x, share.y, share.z});
    };
    const auto interrupted = [&] { return options.interrupted && *options.interrupted; };
    for (result.residual = worst();
         result.residual > options.tolerance && result.iterations < options.most && !interrupted();
         result.residual = worst(), ++result.iterations) {
        factors.for_rows(workers, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                p[i] = r[i] + more * p[i];
                reflect(i, p[i]);
            }
        });
        const Vec3 curvature = sum([&](std::size_t i) {
            q[i] = p[i] - factors.row_times(i, reflected);
            return weight[i] * p[i] * q[i];
        });
        const Vec3 step = ratio(squares, curvature);
        const Vec3 before = squares;
        squares = sum([&](std::size_t i) {
            h[i] += step * p[i];
            r[i] -= step * q[i];
            return weight[i] * r[i] * r[i];
        });
        more = ratio(squares, before);
    }
    // Where nothing is reflected the weight is 0: there one more step without a product tells h.
    for (std::size_t i = 0; i < n; ++i)
        h[i] += r[i];
    return result;
}

} // namespace hemilux
