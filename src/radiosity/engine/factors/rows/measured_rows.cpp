#include "radiosity/engine/factors/rows/measured_rows.h"

#include "radiosity/engine/saving/state.h"

#include <bit>

namespace hemilux {
namespace {

constexpr std::size_t bytes_of_pair = 5 * sizeof(std::uint32_t);

void add_float(StateWriter& to, float value) { to.add(std::bit_cast<std::uint32_t>(value)); }

float float_from(StateReader& from) {
    std::uint32_t bits = 0;
    from.get(bits);
    const auto value = std::bit_cast<float>(bits);
    if (!(value >= 0 && value <= std::numeric_limits<float>::max()))
        throw StateError("a number in it is not finite, or negative");
    return value;
}

template <class Work, class Use>
void for_each_number(Work& work, const Use& use) {
    for (auto* const number : {&work.rays, &work.lines, &work.exact_pairs, &work.line_pairs,
                               &work.ray_pairs, &work.clear_pairs})
        use(*number);
}

void load_pairs(StateReader& from, std::size_t i, std::size_t patches, MeasuredRow& row) {
    row.pairs.resize(from.count(bytes_of_pair));
    row.missed.resize(row.pairs.size());
    std::size_t before = i;
    for (std::size_t k = 0; k < row.pairs.size(); ++k) {
        PairExchange& pair = row.pairs[k];
        from.get(pair.to);
        if (pair.to <= before || pair.to >= patches)
            throw StateError("a pair in it is not one of the patches");
        before = pair.to;
        pair.deviation = float_from(from);
        from.get(pair.exchange, bounds::non_negative);
        row.missed[k] = float_from(from);
    }
}

} // namespace

PairWork& PairWork::operator+=(const PairWork& other) {
    rays += other.rays;
    lines += other.lines;
    exact_pairs += other.exact_pairs;
    line_pairs += other.line_pairs;
    ray_pairs += other.ray_pairs;
    clear_pairs += other.clear_pairs;
    return *this;
}

void save_rows(std::span<const MeasuredRow> rows, StateWriter& to) {
    to.add(std::uint64_t{rows.size()});
    for (const MeasuredRow& row : rows) {
        to.add(row.is_measured() ? row.scale : 0.0);
        if (!row.is_measured())
            continue;
        for_each_number(row.work, [&to](std::uint64_t number) { to.add(number); });
        to.add(std::uint64_t{row.pairs.size()});
        for (std::size_t k = 0; k < row.pairs.size(); ++k) {
            to.add(row.pairs[k].to);
            add_float(to, row.pairs[k].deviation);
            to.add(row.pairs[k].exchange);
            add_float(to, row.missed[k]);
        }
    }
}

void load_rows(StateReader& from, std::span<MeasuredRow> rows) {
    if (from.whole() != rows.size())
        throw StateError("the number of rows is not that of the patches");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        MeasuredRow& row = rows[i];
        const double scale = from.number(bounds::non_negative);
        if (!(scale > 0))
            continue;
        row.scale = scale;
        for_each_number(row.work, [&from](std::uint64_t& number) { from.get(number); });
        load_pairs(from, i, rows.size(), row);
    }
}

} // namespace hemilux
