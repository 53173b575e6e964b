#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/solving/shared_stop.h"

#include "geometry/numeric.h"
#include "parallel/gathered_vector.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace hemilux {
namespace {

constexpr int max_iterations = 1000;

/// Returns the square of a residual relative to the light it belongs to. It is at most 1, also
/// where there is no light yet. What is not reflected is left to the step after the last.
Vec3 relative_square(const Vec3& residual, const Vec3& light, const Vec3& weight) {
    const auto one = [](double r, double h, double w) {
        if (!(w > 0) || r == 0)
            return 0.0;
        return std::abs(r) < std::abs(h) ? (r / h) * (r / h) : 1.0;
    };
    return {one(residual.x, light.x, weight.x), one(residual.y, light.y, weight.y),
            one(residual.z, light.z, weight.z)};
}

/// Returns whether there is light that is reflected, by channel 1 or 0.
Vec3 is_lit(const Vec3& residual, const Vec3& light, const Vec3& weight) {
    const auto one = [](double r, double h, double w) {
        return w > 0 && (r != 0 || h != 0) ? 1.0 : 0.0;
    };
    return {one(residual.x, light.x, weight.x), one(residual.y, light.y, weight.y),
            one(residual.z, light.z, weight.z)};
}

/// Sums over patches.
struct Sums {
    Vec3 squares{0.0};            ///< squares of the residual, weighted
    Vec3 relative{0.0}, lit{0.0}; ///< squares of the relative residual; area

    Sums& operator+=(const Sums& other) {
        squares += other.squares;
        relative += other.relative;
        lit += other.lit;
        return *this;
    }
};

} // namespace

GradientsResult solve_by_gradients(const ExchangeMatrix& factors, std::span<const double> area,
                                   std::span<const Vec3> reflectance, std::span<const Vec3> d,
                                   std::vector<Vec3>& h, const Workers& workers, double tolerance,
                                   const StopFlag* interrupted) {
    const std::size_t n = h.size();
    // The arrays hold values of this rank's patches only; the others' are never touched.
    const auto of_patches = [n] { return std::make_unique_for_overwrite<Vec3[]>(n); };
    const auto r = of_patches(), p = of_patches(), q = of_patches();
    const auto weight = [&](std::size_t i) { return area[i] * reflectance[i]; };
    const std::size_t chunks = (n + factors.rows_per_chunk - 1) / factors.rows_per_chunk;
    const OwnBlocks& rows = factors.own_rows();
    GatheredVector<Lanes> reflected(rows);
    const OwnBlocks own_chunks(rows.ranks(), chunks, rows.block() / factors.rows_per_chunk);
    GatheredVector<Vec3> parts_of_curvature(own_chunks);
    GatheredVector<Sums> parts_of_sums(own_chunks);
    /// Sums term(i) over all patches, in an order that does not depend on the threads or ranks.
    const auto sum = [&]<class Term>(GatheredVector<Term>& parts, const auto& term) {
        factors.for_rows(workers, [&](std::size_t begin, std::size_t end) {
            Term some{};
            for (std::size_t i = begin; i < end; ++i)
                some += term(i);
            parts[begin / factors.rows_per_chunk] = some;
        });
        parts.gather();
        Term all{};
        for (std::size_t chunk = 0; chunk < chunks; ++chunk)
            all += parts[chunk];
        return all;
    };
    const auto residual_at = [&](std::size_t i) {
        return Sums{weight(i) * r[i] * r[i], area[i] * relative_square(r[i], h[i], weight(i)),
                    area[i] * is_lit(r[i], h[i], weight(i))};
    };
    const auto reflect = [&](std::size_t i, const Vec3& x) {
        reflected[i] = factors.scaled(i, reflectance[i] * x);
    };
    factors.for_rows(workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            p[i] = Vec3(0.0);
            reflect(i, h[i]);
        }
    });
    reflected.gather();
    Sums sums = sum(parts_of_sums, [&](std::size_t i) {
        r[i] = d[i] - (h[i] - factors.row_times(i, reflected));
        return residual_at(i);
    });
    Vec3 more(0.0);
    const auto worst = [&] {
        const Vec3 share = glm::sqrt(ratio_or_zero(sums.relative, sums.lit));
        return std::max({share.x, share.y, share.z});
    };
    const auto is_interrupted = [&] { return interrupted && agree(*interrupted); };
    int iterations = 0;
    for (; worst() > tolerance && iterations < max_iterations && !is_interrupted(); ++iterations) {
        factors.for_rows(workers, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                p[i] = r[i] + more * p[i];
                reflect(i, p[i]);
            }
        });
        reflected.gather();
        const Vec3 curvature = sum(parts_of_curvature, [&](std::size_t i) {
            q[i] = p[i] - factors.row_times(i, reflected);
            return weight(i) * p[i] * q[i];
        });
        // A channel that is done, or dark, stands still.
        const Vec3 step = ratio_or_zero(sums.squares, curvature);
        const Vec3 before = sums.squares;
        sums = sum(parts_of_sums, [&](std::size_t i) {
            h[i] += step * p[i];
            r[i] -= step * q[i];
            return residual_at(i);
        });
        more = ratio_or_zero(sums.squares, before);
    }
    // Where nothing is reflected the weight is 0: there one more step without a product gives h.
    factors.for_rows(workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            h[i] += r[i];
    });
    rows.gather(h);
    factors.count_products(1 + iterations);
    const double residual = worst();
    return {iterations, residual, iterations < max_iterations || !(residual > tolerance)};
}

} // namespace hemilux
