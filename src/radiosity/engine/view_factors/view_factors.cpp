#include "radiosity/engine/view_factors/view_factors.h"

#include "geometry/compensated_sum.h"
#include "geometry/elementary.h"
#include "radiosity/engine/view_factors/sky_bands.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

struct Term {
    std::uint32_t column;
    double exchange, variance;
};

void sum_pairs(const ExchangeList& list, std::span<const std::uint32_t> row_of,
               ViewFactors& factors) {
    const std::size_t rows = factors.rows();
    std::vector<std::size_t> begin(rows + 1);
    const auto for_each = [&](const auto& use) {
        for (std::size_t i = 0; i < list.pairs.size(); ++i)
            for (const PairExchange& pair : list.pairs[i])
                if (pair.exchange > 0) {
                    use(row_of[i], row_of[pair.to], pair);
                    use(row_of[pair.to], row_of[i], pair);
                }
    };
    for_each([&](std::uint32_t row, std::uint32_t, const PairExchange&) { ++begin[row + 1]; });
    for (std::size_t row = 0; row < rows; ++row)
        begin[row + 1] += begin[row];
    std::vector<Term> terms(begin[rows]);
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for_each([&](std::uint32_t row, std::uint32_t column, const PairExchange& pair) {
        const double deviation = pair.deviation;
        terms[next[row]++] = {column, pair.exchange, deviation * deviation};
    });
    factors.row_begin.assign(1, 0);
    factors.column.reserve(terms.size()); // lists that grow would be there twice
    factors.factor.reserve(terms.size());
    factors.standard_error.reserve(terms.size());
    for (std::size_t row = 0; row < rows; ++row) {
        const auto of_row = std::span(terms).subspan(begin[row], begin[row + 1] - begin[row]);
        std::ranges::stable_sort(of_row, {}, &Term::column);
        for (std::size_t k = 0; k < of_row.size();) {
            const std::uint32_t column = of_row[k].column;
            CompensatedSum<double> exchange;
            double variance = 0;
            // Within one surface each pair of patches is there from both sides, with one error.
            const double twice = column == row ? 2 : 1;
            for (; k < of_row.size() && of_row[k].column == column; ++k) {
                exchange += of_row[k].exchange;
                variance += twice * of_row[k].variance;
            }
            factors.column.push_back(column);
            factors.factor.push_back(exchange.value() / factors.area[row]);
            factors.standard_error.push_back(std::sqrt(variance) / factors.area[row]);
        }
        factors.row_begin.push_back(factors.column.size());
    }
}

/// Sums the parts of the sky, which are scaled to what closing left of it.
void sum_bands(const ExchangeList& list, std::span<const std::uint32_t> row_of,
               ViewFactors& factors) {
    const std::size_t bands = list.bands.size() / list.area.size();
    factors.bands.resize(bands * factors.rows());
    for (std::size_t i = 0; i < list.area.size(); ++i) {
        const double share = list.area[i] / factors.area[row_of[i]];
        for (std::size_t k = 0; k < bands; ++k) {
            const OpenShare& of_patch = list.bands[i * bands + k];
            OpenShare& sum = factors.bands[row_of[i] * bands + k];
            sum.factor += share * of_patch.factor;
            sum.standard_error =
                elementary::hypot(sum.standard_error, share * of_patch.standard_error);
        }
    }
    if (bands > 0)
        for (std::size_t row = 0; row < factors.rows(); ++row)
            scale_to_sum(std::span(factors.bands).subspan(row * bands, bands),
                         factors.open[row][static_cast<std::size_t>(Open::sky)].factor);
}

} // namespace

ViewFactors sum_over_rows(const ExchangeList& list, std::span<const std::uint32_t> row_of,
                          std::size_t rows) {
    ViewFactors factors;
    factors.area.assign(rows, 0);
    factors.open.resize(rows);
    factors.unlisted_bound.assign(rows, 0);
    for (std::size_t i = 0; i < list.area.size(); ++i)
        factors.area[row_of[i]] += list.area[i];
    for (std::size_t i = 0; i < list.area.size(); ++i) {
        const std::uint32_t row = row_of[i];
        const double share = list.area[i] / factors.area[row];
        factors.unlisted_bound[row] += share * list.unlisted_bound[i];
        for (std::size_t k = 0; k < opens; ++k) {
            const OpenShare& of_patch = list.open[i][k];
            OpenShare& sum = factors.open[row][k];
            sum.factor += share * of_patch.factor;
            sum.standard_error =
                elementary::hypot(sum.standard_error, share * of_patch.standard_error);
        }
    }
    sum_bands(list, row_of, factors);
    sum_pairs(list, row_of, factors);
    return factors;
}

ViewFactors view_factors(const Mesh& mesh, const WideBvh& tree,
                         std::span<const std::uint32_t> row_of, std::size_t rows,
                         const ExchangeOptions& options, const Workers& workers, Monitor& monitor) {
    FoundExchange found = find_exchange(mesh, tree, options, workers, monitor);
    if (found.is_void)
        return {};
    const ClosingAudit audit = close_rows(found.list, options.rays);
    ViewFactors factors = sum_over_rows(found.list, row_of, rows);
    factors.audit = audit;
    factors.work = found.work;
    return factors;
}

std::size_t ViewFactors::place(std::uint32_t row, std::uint32_t of_column) const {
    const auto begin = column.begin() + static_cast<std::ptrdiff_t>(row_begin[row]),
               end = column.begin() + static_cast<std::ptrdiff_t>(row_begin[row + 1]);
    const auto found = std::lower_bound(begin, end, of_column);
    return found != end && *found == of_column ? static_cast<std::size_t>(found - column.begin())
                                               : column.size();
}

OpenShare ViewFactors::between(std::uint32_t from, std::uint32_t to) const {
    const std::size_t at = place(from, to);
    return at < column.size() ? OpenShare{factor[at], standard_error[at]} : OpenShare{};
}

double ViewFactors::row_sum(std::uint32_t row) const {
    CompensatedSum<double> sum;
    for (const OpenShare& share : open[row])
        sum += share.factor;
    for (std::size_t k = row_begin[row]; k < row_begin[row + 1]; ++k)
        sum += factor[k];
    return sum.value();
}

FactorErrors errors_above(const ViewFactors& factors, double least) {
    FactorErrors errors;
    double squares = 0;
    for (const double& factor : factors.factor) {
        const auto k = static_cast<std::size_t>(&factor - factors.factor.data());
        if (!(factor >= least))
            continue;
        const double relative = factors.standard_error[k] / factor;
        ++errors.factors;
        squares += relative * relative;
        errors.worst = std::max(errors.worst, relative);
    }
    if (errors.factors > 0)
        errors.rms = std::sqrt(squares / static_cast<double>(errors.factors));
    return errors;
}

double worst_reciprocity(const ViewFactors& factors) {
    double worst = 0;
    for (std::uint32_t i = 0; i < factors.rows(); ++i)
        for (std::size_t k = factors.row_begin[i]; k < factors.row_begin[i + 1]; ++k) {
            const std::uint32_t j = factors.column[k];
            const double back = factors.area[j] * factors.between(j, i).factor;
            worst = std::max(worst, std::abs(factors.area[i] * factors.factor[k] / back - 1));
        }
    return worst;
}

} // namespace hemilux
