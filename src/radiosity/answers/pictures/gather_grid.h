#pragma once
// The points of a picture at which light is gathered: one at every second pixel of every second
// row, where a surface is visible.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/answers/pictures/visible_facets.h"
#include "radiosity/light/final_gather/surface_points.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace hemilux {

/// Returns whether two points with unit normals belong to one surface, which may be bent a little.
/// The normals' cosine says how much; so does the second one's distance from the plane of the first
/// as a share of their distance.
[[nodiscard]] inline bool is_same_surface(const Vec3& a, const Vec3& normal_a, const Vec3& b,
                                          const Vec3& normal_b) {
    constexpr double alike = .9, flatness = .2;
    const Vec3 way = b - a;
    const double off = glm::dot(normal_a, way);
    return glm::dot(normal_a, normal_b) > alike &&
           off * off <= flatness * flatness * glm::dot(way, way);
}

/// Returns a ray between two points of one surface, which meets what stands between them and is
/// higher than half of their distance.
[[nodiscard]] Ray ray_between(const SurfacePoint& a, const SurfacePoint& b);

/// The results of a point's shadow rays, as bits: both together say that some rays were blocked.
enum Shadow : std::uint8_t { none_blocked = 1, all_blocked = 2 };

struct GridPoint {
    SurfacePoint at;         ///< facet none: no surface is visible there
    float nearness = 0;      ///< mean inverse distance of hits, or of emitters [1/local unit]
    float noise = 0;         ///< error of the mean of the points around, relative to all light
    float light = 0;         ///< all that arrives, by the first rays [W/m2]
    unsigned rays = 0;       ///< number of rays that gathered the light
    Vec2 squares{0.0};       ///< of the light that the rays read, and of that of bright patches
    bool aims = false;       ///< further rays are partly aimed at bright patches
    std::uint8_t shadow = 0; ///< Shadow, of rays from here and from the points beside it
    bool is_coarse = false;  ///< light changes faster than points are close together
    /// The part of a picture, such as a chart of a lightmap, in which neighbours are near each
    /// other on the surface.
    std::uint32_t part = 0;

    [[nodiscard]] bool is_of_surface(const SurfacePoint& point, std::uint32_t part_of_point) const {
        return part_of_point == part &&
               is_same_surface(point.position, point.normal, at.position, at.normal);
    }
    [[nodiscard]] bool is_of_surface(const GridPoint& other) const {
        return is_of_surface(other.at, other.part);
    }
};

class GatherGrid {
  public:
    /// The distance between points [pixels].
    static constexpr int step = 2;

    /// Finds the points of a picture of this size [pixels]. `check` may throw to end it; it is
    /// called by several threads.
    GatherGrid(const Mesh& mesh, const CameraRays& camera, int width, int height,
               const std::function<void()>& check, const Workers& workers);
    /// Takes points row after row, those without a surface with facet none.
    GatherGrid(int columns, int rows, std::vector<GridPoint> points)
        : columns_(columns), rows_(rows), points_(std::move(points)) {}

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    /// Returns the number of all points, also those without a surface. They are numbered row after
    /// row.
    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] GridPoint& operator[](std::size_t number) { return points_[number]; }
    [[nodiscard]] std::size_t number_of(const GridPoint& point) const {
        return static_cast<std::size_t>(&point - points_.data());
    }
    /// Returns null outside of the picture, and where no surface is visible.
    [[nodiscard]] const GridPoint* point(int x, int y) const {
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_)
            return nullptr;
        const GridPoint& found =
            points_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(x)];
        return found.at.facet == none ? nullptr : &found;
    }
    /// Calls visit(there) for the points of the same surface in a square around `here`, itself
    /// included. The square reaches `reach` points to each side.
    template <class Visit>
    void for_each_around(const GridPoint& here, int x, int y, int reach, const Visit& visit) const {
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx)
                if (const GridPoint* const there = point(x + dx, y + dy);
                    there && here.is_of_surface(*there))
                    visit(*there);
    }
    /// Calls visit(point, x, y) for each point with a surface of the rows from `first` up to `end`,
    /// in several threads. Calls check(), which may throw to end it, before some rows at a time.
    template <class Visit, class Check = void (*)()>
    void for_each_point(
        int first, int end, const Workers& workers, const Visit& visit,
        const Check& check = [] {}) const {
        workers.for_chunks(static_cast<std::size_t>(end - first), 4,
                           [&](std::size_t begin, std::size_t past) {
                               check();
                               for (int y = first + static_cast<int>(begin);
                                    y < first + static_cast<int>(past); ++y)
                                   for (int x = 0; x < columns_; ++x)
                                       if (const GridPoint* const here = point(x, y))
                                           visit(*here, x, y);
                           });
    }

    /// Returns the distance from a point with a surface to the farthest of its four neighbours on
    /// it, in local units; 0 without any.
    [[nodiscard]] double spacing(int x, int y) const;
    /// Joins what each point knows of nearness and shadows with the points beside it: a few rays
    /// estimate nearness badly, and may miss a shadow. It is called for some rows after the other;
    /// row `end`, if there is one, must know its own. The last of the rows takes what it has asked
    /// by the next call only, as the row after it asks it too.
    void ask_neighbours(int first, int end, const Workers& workers);

  private:
    struct Asked {
        float nearness = 0;
        std::uint8_t shadow = 0;
    };

    int columns_, rows_;
    std::vector<GridPoint> points_;
    std::vector<Asked> asked_; ///< of the last row of the last call
};

} // namespace hemilux
