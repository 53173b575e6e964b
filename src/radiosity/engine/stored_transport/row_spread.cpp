#include "radiosity/engine/stored_transport/row_spread.h"

#include "geometry/numeric.h"
#include "radiosity/engine/form_factors/exchange_matrix.h"

namespace hemilux {
RowSpread spread_of_rows(const ExchangeMatrix& factors, std::span<const Vec3> light,
                         const Workers& workers) {
    const std::size_t n = light.size();
    std::vector<Lanes> once(n), squared(n);
    for (std::size_t i = 0; i < n; ++i) {
        once[i] = factors.scaled(i, light[i]);
        squared[i] = factors.scaled(i, light[i] * light[i]);
    }
    RowSpread spread{std::vector<Vec3>(n), std::vector<Vec3>(n)};
    factors.for_products(workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 mean = factors.row_times(i, once), squares = factors.row_times(i, squared);
            spread.variance[i] = glm::max(squares - mean * mean, 0.0);
            spread.typical[i] = ratio_or_zero(squares, mean);
        }
    });
    factors.own_rows().gather(spread.variance);
    factors.own_rows().gather(spread.typical);
    return spread;
}

} // namespace hemilux
