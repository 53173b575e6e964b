#pragma once
// Conjugate gradients with a diagonal preconditioner (Hestenes and Stiefel 1952) for one right-hand
// side and a symmetric positive definite matrix that is known by its products.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace hemilux {

struct GradientsLimit {
    /// The iterations end when the square of the residual r, sum r_i^2 / diagonal_i, is at most
    /// this share of what it was, or of `least_scale` if that is more.
    double square;
    double least_scale = 0;
    int iterations;
};

struct GradientsEnd {
    int iterations = 0;
    double residual = 0; ///< |r| as a share of what it was, or of what `least_scale` stands for [-]
    bool converged = true; ///< false where the iterations ended at their limit
};

/// Adds to x the solution for the right-hand side `residual`, which is that of x before.
/// multiply(direction, product) gives the product with the matrix. Rows whose diagonal is 0 keep
/// their x.
template <class Multiply>
[[nodiscard]] GradientsEnd add_solution(std::span<const double> diagonal,
                                        std::vector<double> residual, const GradientsLimit& limit,
                                        const Multiply& multiply, std::span<double> x) {
    const std::size_t rows = diagonal.size();
    std::vector<double> direction(rows), product(rows), scaled(rows);
    const auto precondition = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < rows; ++i) {
            scaled[i] = diagonal[i] > 0 ? residual[i] / diagonal[i] : 0;
            sum += scaled[i] * residual[i];
        }
        return sum;
    };
    double size = precondition();
    const double scale = std::max(size, limit.least_scale), enough = limit.square * scale;
    direction = scaled;
    int k = 0;
    for (; k < limit.iterations && size > enough; ++k) {
        multiply(direction, product);
        double curvature = 0;
        for (std::size_t i = 0; i < rows; ++i)
            curvature += direction[i] * product[i];
        if (!(curvature > 0))
            break;
        const double step = size / curvature;
        for (std::size_t i = 0; i < rows; ++i) {
            x[i] += step * direction[i];
            residual[i] -= step * product[i];
        }
        const double before = size;
        size = precondition();
        for (std::size_t i = 0; i < rows; ++i)
            direction[i] = scaled[i] + size / before * direction[i];
    }
    return {k, scale > 0 ? std::sqrt(size / scale) : 0, k < limit.iterations || size <= enough};
}

} // namespace hemilux
