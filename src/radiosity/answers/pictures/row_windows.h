#pragma once
// Rows of a picture that are finished by what is in the rows around them.

#include <algorithm>

namespace hemilux {

/// Gathers some rows, then finishes those whose windows are known, which reach `reach` rows to each
/// side, and forgets those that no window reaches any more. So few rows are kept at a time. Calls
/// gather(first, end), finish(first, end) and forget(y).
template <class Gather, class Finish, class Forget>
void for_row_windows(int rows, int at_once, int reach, const Gather& gather, const Finish& finish,
                     const Forget& forget) {
    int finished = 0;
    for (int from = 0; from < rows; from += at_once) {
        const int to = std::min(from + at_once, rows);
        gather(from, to);
        const int known = to == rows ? rows : std::max(to - reach, finished);
        finish(finished, known);
        for (int y = std::max(finished - reach, 0); y < known - reach; ++y)
            forget(y);
        finished = known;
    }
}

} // namespace hemilux
