#include "radiosity/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

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
    std::vector<Vec3> r(n), p(n), q(n), reflected(n);
    /// y = (I - F rho) x
    const auto apply = [&](const std::vector<Vec3>& x, std::vector<Vec3>& y) {
        for (std::size_t i = 0; i < n; ++i)
            reflected[i] = reflectance[i] * x[i];
        factors.multiply(reflected, y, workers);
        for (std::size_t i = 0; i < n; ++i)
            y[i] = x[i] - y[i];
    };
    const auto product = [&](const auto& x, const auto& y) {
        Vec3 sum(0.0);
        for (std::size_t i = 0; i < n; ++i)
            sum += area[i] * reflectance[i] * x[i] * y[i];
        return sum;
    };
    apply(h, q);
    for (std::size_t i = 0; i < n; ++i)
        p[i] = r[i] = d[i] - q[i];
    const Vec3 size = product(d, d);
    Vec3 squares = product(r, r);
    GradientResult result;
    const auto worst = [&] {
        const Vec3 share = glm::sqrt(ratio(squares, size));
        return std::max({share.x, share.y, share.z});
    };
    const auto interrupted = [&] { return options.interrupted && *options.interrupted; };
    for (result.residual = worst();
         result.residual > options.tolerance && result.iterations < options.most && !interrupted();
         result.residual = worst(), ++result.iterations) {
        apply(p, q);
        const Vec3 step = ratio(squares, product(p, q));
        for (std::size_t i = 0; i < n; ++i) {
            h[i] += step * p[i];
            r[i] -= step * q[i];
        }
        const Vec3 before = squares;
        squares = product(r, r);
        const Vec3 more = ratio(squares, before);
        for (std::size_t i = 0; i < n; ++i)
            p[i] = r[i] + more * p[i];
    }
    // Where nothing is reflected the weight is 0: there one product tells h.
    apply(h, q);
    for (std::size_t i = 0; i < n; ++i)
        h[i] += d[i] - q[i];
    return result;
}

} // namespace hemilux
