#pragma once
// The light of a picture that varies slowly: all but the shadows of small emitters. It is gathered
// at the points of a grid by few rays, and smoothed over those around on the same surface.
//
// The farther surfaces are away, the more slowly such light varies (Ward, Rubinstein and Clear
// 1988). So a linear function is fitted to the points within a share of the harmonic mean distance
// of what their rays met.

#include "geometry/vector.h"
#include "radiosity/answers/pictures/gather_grid.h"
#include "radiosity/answers/pictures/slow_light_fit.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace hemilux {

/// The number of points in each direction over which a point averages.
inline constexpr int reach_points = 4;

/// The share of reach_of() within which nothing can stand between two points. It is less than 1, as
/// a few rays estimate nearness badly.
inline constexpr double free_reach = .5;

/// Returns the distance from a point within which the light is taken to be about the same, in local
/// units.
[[nodiscard]] double reach_of(double nearness);

class SlowLightField {
  public:
    /// Both must outlive this object; the grid may still change.
    SlowLightField(const GatherGrid& grid, const Tracer& tracer)
        : grid_(grid), tracer_(tracer), gathered_(grid.size()), once_(grid.size()),
          twice_(grid.size()), slope_(grid.size()), at_barrier_(grid.size()) {}

    /// Returns the light that was gathered at a point of the grid, by its number.
    [[nodiscard]] SlowLight& at(std::size_t point) { return gathered_[point]; }

    /// Returns the error of what fits find at a point, relative to all light that arrives there. It
    /// follows from what a linear function leaves of the points around, as if they were
    /// independent.
    [[nodiscard]] double noise_around(const GridPoint& here, int x, int y) const;

    /// Fits a linear function to the points around each of some rows (local linear regression: Fan
    /// 1992). Light that changes evenly then stays as it is up to the edge of a surface. The light
    /// reaches_once rows around must have been gathered. `check` may throw to end it.
    void fit_once(int first, int end, const std::function<void()>& check, const Workers& workers) {
        fit(1, gathered_, once_, first, end, check, workers);
    }
    /// Does the same once more by points that are farther apart, as light that is smoothed has
    /// little detail between them (the algorithme a trous: Dammertz et al. 2010). The rows
    /// reaches_twice around must have been fitted once.
    void fit_twice(int first, int end, const std::function<void()>& check, const Workers& workers) {
        fit(reach_points, once_, twice_, first, end, check, workers);
    }
    static constexpr int reaches_once = reach_points, reaches_twice = reach_points * reach_points;

    struct Around {
        SlowLight light;
        std::uint8_t shadow = 0;                                ///< Shadow
        bool is_coarse = false;                                 ///< GridPoint::is_coarse of some
        double reach = std::numeric_limits<double>::infinity(); ///< the least of reach_of()
    };
    /// Interpolates from the four points around a place of the picture [pixels], as far as they are
    /// of the same surface. Where none is, as on narrow strips, it takes the twelve around these;
    /// empty where none of them is either.
    [[nodiscard]] std::optional<Around> interpolate(const SurfacePoint& at, const Vec2& pixel,
                                                    std::uint32_t part = 0) const;

  private:
    void fit(int stride, const std::vector<SlowLight>& light, std::vector<SlowLight>& fitted,
             int first, int end, const std::function<void()>& check, const Workers& workers);

    const GatherGrid& grid_;
    const Tracer& tracer_;
    std::vector<SlowLight> gathered_, once_, twice_; ///< by point: gathered, fitted once and twice
    /// The change of the light from a point to the next one on the right, and in the next row.
    std::vector<std::array<SlowLight, 2>> slope_;
    /// Something stands between the point and another near it, by point: 1 or 0.
    std::vector<std::uint8_t> at_barrier_;
};

} // namespace hemilux
