#pragma once
// What is known of the pairs of each patch while they are measured, and as bytes, so that a run can
// go on where another ended.

#include "radiosity/engine/factors/rows/exchange_list.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hemilux {

class StateReader;
class StateWriter;

/// The work that pairs took.
struct PairWork {
    std::uint64_t rays = 0, lines = 0;
    std::uint64_t exact_pairs = 0, line_pairs = 0, ray_pairs = 0;
    /// Pairs of which neither a certificate nor a line says that something hides a part.
    std::uint64_t clear_pairs = 0;

    PairWork& operator+=(const PairWork& other);
};

/// The pairs of a patch with those of higher index.
struct MeasuredRow {
    /// The tolerances it was measured with, as a multiple of those asked for.
    double scale = std::numeric_limits<double>::infinity();
    PairWork work; ///< rays and lines of all that it was measured with, pairs of the last
    std::vector<PairExchange> pairs; ///< ascending
    /// By pair: the exchange of other pairs like it that were not found, as the chance of finding
    /// it says.
    std::vector<float> missed;

    [[nodiscard]] bool is_measured() const {
        return scale < std::numeric_limits<double>::infinity();
    }
};

/// Appends those that are measured.
void save_rows(std::span<const MeasuredRow> rows, StateWriter& to);

/// Reads what save_rows() wrote of as many rows. Throws StateError.
void load_rows(StateReader& from, std::span<MeasuredRow> rows);

} // namespace hemilux
