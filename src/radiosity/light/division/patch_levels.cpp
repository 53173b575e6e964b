#include "radiosity/light/division/patch_levels.h"

#include "geometry/elementary.h"

#include <algorithm>

namespace hemilux {
namespace {

constexpr std::uint8_t max_levels = 2;

/// The share of a squared error that a level leaves: a quarter where light changes evenly, a half
/// along the edge of a shadow.
constexpr double left_by_level = .4, pieces_of_level = 4;

/// Returns the levels until no piece has an error of more than `bound`.
std::uint8_t levels_to(double square, double bound) {
    std::uint8_t levels = 0;
    for (; levels < max_levels && square > bound; ++levels)
        square *= left_by_level / pieces_of_level;
    return levels;
}

struct Outcome {
    double square = 0, pieces = 0;
};

Outcome outcome_of(std::span<const double> square, double bound) {
    Outcome outcome;
    for (const double s : square) {
        const std::uint8_t levels = levels_to(s, bound);
        outcome.square += s * elementary::whole_power(left_by_level, levels);
        outcome.pieces += elementary::whole_power(pieces_of_level, levels);
    }
    return outcome;
}

} // namespace

std::vector<std::uint8_t> levels_of_division(std::span<const double> square,
                                             const LevelOptions& options) {
    std::vector<std::uint8_t> levels(square.size());
    if (square.empty())
        return levels;
    constexpr double step = .8, least = 1e-6; // of the bound; of the largest error
    const double largest = *std::ranges::max_element(square);
    double bound = largest;
    for (double next = bound; next > least * largest; next *= step) {
        const Outcome outcome = outcome_of(square, next);
        if (outcome.pieces > static_cast<double>(options.max_pieces))
            break;
        bound = next;
        const bool is_enough = outcome.square <= options.goal ||
                               // This is the error of all pieces together, if each has that of the
                               // bound.
                               bound * outcome.pieces <= options.goal;
        if (is_enough && outcome.pieces >= static_cast<double>(options.min_pieces))
            break;
    }
    for (std::size_t i = 0; i < square.size(); ++i)
        levels[i] = levels_to(square[i], bound);
    return levels;
}

} // namespace hemilux
