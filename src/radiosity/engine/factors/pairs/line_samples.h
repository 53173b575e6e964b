#pragma once
// The share of the kernel between two patches that facets leave to be seen, by lines.
//
// From a point of one patch, a line across the other is seen but for the shadows of what stands
// between: each facet hides an interval of it. The kernel along the line has a closed form, so that
// a line is one sample of three dimensions where a ray is one of four, and it changes steadily
// where rays say yes or no. Points and lines are those of one scrambled Sobol sequence, whose error
// falls nearly as their number. Blocks of it are nets of their own. How neighbouring blocks differ,
// and how that changes as they are joined to larger ones, says how large the error of all is.

#include "geometry/polygon_sampler.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"
#include "radiosity/engine/sampling/sobol.h"

#include <array>
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
    /// The fewest lines.
    static constexpr std::uint32_t first_lines = 16;

    /// Lines lie across the larger of the two. `between` are the facets that may stand between
    /// them; those that hide most are moved to its front.
    LineSamples(const FacePlane& a, const FacePlane& b, std::span<Polygon> between,
                LinesAlong along, std::uint64_t seed);

    /// Goes on to so many lines, a power of two, first_lines at least. They have the same bytes for
    /// the same seed.
    void go_on_to(std::uint32_t lines);
    [[nodiscard]] SeenShare seen() const;

  private:
    static constexpr std::size_t max_blocks = 64;

    struct Line;
    [[nodiscard]] bool hidden_by(const Polygon& facet, const Line& line, Vec2& interval) const;
    [[nodiscard]] double seen_of(const Line& line, double whole);
    /// Returns the seen and the whole kernel along a line.
    [[nodiscard]] Vec2 sample(const Vec3& x, double s);
    /// Returns the variance of the share by what blocks differ by, `prior` being what is known of
    /// it from elsewhere.
    [[nodiscard]] double variance_of_blocks(const Vec2& sum, double prior) const;

    const FacePlane &points_, &lines_;
    std::span<Polygon> between_;
    PolygonSampler sampler_;
    Polygon shape_; ///< that lines lie across
    SobolBlocks<4> places_;
    std::uint32_t count_ = 0, clear_ = 0;
    std::uint32_t of_block_ = 1;          ///< lines
    std::array<Vec2, max_blocks> sums_{}; ///< seen and whole kernel of consecutive lines
    double whole_squares_ = 0;
    std::vector<Vec2> hidden_; ///< intervals of a line
};

} // namespace hemilux
