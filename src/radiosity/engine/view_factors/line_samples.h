#pragma once
// The share of the kernel between two patches that facets leave to be seen, by lines.
//
// From a point of one patch, a line across the other is seen but for the shadows of what stands
// between: each facet hides an interval of it. The kernel along the line has a closed form, so that
// a line is one sample of three dimensions where a ray is one of four, and it changes steadily
// where rays say yes or no. Points and lines are drawn in pairs from equal cells; what the two of a
// cell differ by is the error.

#include "radiosity/engine/view_factors/free_exchange.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct SeenShare {
    double share = 0;    ///< of the kernel [-]
    double variance = 0; ///< variance of the share, above 0
    std::uint32_t lines = 0, clear_lines = 0;
};

/// Two ways in which lines lie across a patch. Where they cross the edges of shadows, few lines are
/// as exact as many along them.
enum class LinesAlong : std::uint8_t { first_edge, second_edge };

class LineSamples {
  public:
    /// Lines lie across the larger of the two. `between` are the facets that may stand between
    /// them; those that hide most are moved to its front. All of it must outlive this.
    LineSamples(const FacePlane& a, const FacePlane& b, std::span<Polygon> between);

    /// Draws two lines in each of cells^3 cells. The share has the same bytes for the same seed.
    [[nodiscard]] SeenShare estimate(unsigned cells, LinesAlong along, std::uint64_t seed);

  private:
    struct Line;
    [[nodiscard]] bool hidden_by(const Polygon& facet, const Line& line, Vec2& interval) const;
    [[nodiscard]] double seen_of(const Line& line, double whole);
    /// Returns the seen and the whole kernel along a line.
    [[nodiscard]] Vec2 sample(const Polygon& shape, const Vec3& x, double s);

    const FacePlane &points_, &lines_;
    std::span<Polygon> between_;
    std::vector<Vec2> hidden_; ///< intervals of a line
    std::vector<Vec2> sums_;   ///< by line
};

} // namespace hemilux
