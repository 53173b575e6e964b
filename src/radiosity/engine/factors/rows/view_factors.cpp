#include "radiosity/engine/factors/rows/view_factors.h"

#include "geometry/compensated_sum.h"
#include "geometry/elementary.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// What a pair of patches adds to an entry of a row.
struct Term {
    std::uint32_t column;
    double exchange, deviation;
};

/// Puts the terms of all pairs into the rows, in the order of the list, and frees the list.
void scatter_pairs(std::vector<std::vector<PairExchange>> pairs,
                   std::span<const std::uint32_t> row_of, ViewFactors& factors) {
    factors.row_begin.assign(factors.rows() + 1, 0);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (const PairExchange& pair : pairs[i])
            if (pair.exchange > 0)
                for (const std::uint32_t row : {row_of[i], row_of[pair.to]})
                    ++factors.row_begin[row + 1];
    std::partial_sum(factors.row_begin.begin(), factors.row_begin.end(), factors.row_begin.begin());
    const std::size_t terms = factors.row_begin.back();
    factors.column.resize(terms);
    factors.factor.resize(terms);
    factors.standard_error.resize(terms);
    std::vector<std::size_t> next(factors.row_begin.begin(), factors.row_begin.end() - 1);
    const auto put = [&](std::uint32_t row, std::uint32_t column, const PairExchange& pair) {
        const std::size_t at = next[row]++;
        factors.column[at] = column;
        factors.factor[at] = pair.exchange;
        factors.standard_error[at] = pair.deviation;
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        for (const PairExchange& pair : pairs[i])
            if (pair.exchange > 0) {
                put(row_of[i], row_of[pair.to], pair);
                put(row_of[pair.to], row_of[i], pair);
            }
        pairs[i] = {};
    }
}

/// Sums the terms of each row in place, which are many more than the entries where surfaces have
/// several patches.
void sum_terms(ViewFactors& factors) {
    std::vector<Term> terms;
    std::size_t begin = 0, entries = 0;
    for (std::size_t row = 0; row < factors.rows(); ++row) {
        const std::size_t end = factors.row_begin[row + 1];
        terms.clear();
        for (std::size_t at = begin; at < end; ++at)
            terms.push_back({factors.column[at], factors.factor[at], factors.standard_error[at]});
        std::ranges::stable_sort(terms, {}, &Term::column);
        for (std::size_t k = 0; k < terms.size(); ++entries) {
            const std::uint32_t column = terms[k].column;
            CompensatedSum<double> exchange;
            double variance = 0;
            // Within one surface each pair of patches is there from both sides, with one error.
            const double twice = column == row ? 2 : 1;
            for (; k < terms.size() && terms[k].column == column; ++k) {
                exchange += terms[k].exchange;
                variance += twice * (terms[k].deviation * terms[k].deviation);
            }
            factors.column[entries] = column;
            factors.factor[entries] = exchange.value() / factors.area[row];
            factors.standard_error[entries] = std::sqrt(variance) / factors.area[row];
        }
        factors.row_begin[row + 1] = entries;
        begin = end;
    }
    factors.column.resize(entries);
    factors.factor.resize(entries);
    factors.standard_error.resize(entries);
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

ViewFactors sum_over_rows(ExchangeList list, std::span<const std::uint32_t> row_of,
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
    scatter_pairs(std::move(list.pairs), row_of, factors);
    sum_terms(factors);
    return factors;
}

ViewFactors view_factors(const Mesh& mesh, const WideBvh& tree,
                         std::span<const std::uint32_t> row_of, std::size_t rows,
                         const ExchangeOptions& options, const Workers& workers, Monitor& monitor) {
    FoundExchange found = find_exchange(mesh, tree, options, workers, monitor);
    if (found.is_void)
        return {};
    const ClosingAudit audit = close_rows(found.list, options.rays);
    ViewFactors factors = sum_over_rows(std::move(found.list), row_of, rows);
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
