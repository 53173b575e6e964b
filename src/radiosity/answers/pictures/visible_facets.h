#pragma once
// This finds which facet each sample of a picture shows first, for all samples of some rows at
// once.
//
// Rays of a pinhole camera have one origin. So what a ray needs to know of a triangle is linear
// across the picture. Let a, b, c be the corners seen from the eye. The ray of direction d is
// inside where det(a, b, d), det(b, c, d) and det(c, a, d) have one sign (Olano and Greer 1997).
// The inverse of its distance is linear in d as well. So triangles are filled row by row into a
// depth buffer (Catmull 1974), with no ray traced. Neighbours evaluate their common edge with the
// same rounding and opposite signs: nothing shows between them.

#include "geometry/vector.h"
#include "radiosity/answers/views/camera_rays.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class Workers;

/// Samples in columns and rows. Sample (x, y) of a set lies at (x + offset.x, y + offset.y).
struct SampleGrid {
    int columns, rows;
    double column_width, row_height; ///< as shares of the picture's width and height
};

/// The mark of a sample that shows nothing. All other values are halves of facets that are quads,
/// or whole triangles: facet * 2 + (second half ? 1 : 0).
inline constexpr std::uint32_t nothing_visible = 0xffffffff;

class VisibleFacets {
  public:
    /// `offsets` are those of the sets of samples within a pixel, from 0 to 1.
    VisibleFacets(const Mesh& mesh, const CameraRays& camera, const SampleGrid& grid,
                  std::span<const Vec2> offsets, unsigned threads);

    /// The number of rows that are filled together, a band.
    static constexpr int rows_per_band = 8;
    [[nodiscard]] int bands() const { return bands_; }
    /// Halves of facets in a band: sample set s, row y of the band and column x stand at
    /// [(s * rows_per_band + y) * columns + x].
    struct Band {
        std::vector<std::uint32_t> half;
        std::vector<double> nearness; ///< inverse of the distance along CameraRays::direction
    };
    void fill(int band, Band& out) const;
    using VisitBand = std::function<void(const Band& band, int first, int end)>;
    /// Calls visit(band, first, end) for each of some bands, `from` to `to`, once it is filled,
    /// with its rows of the picture, in several threads. Calls check(), which may throw to end it,
    /// before each band.
    void for_bands(int from, int to, const Workers& workers, const std::function<void()>& check,
                   const VisitBand& visit) const;
    /// Does the same for all bands.
    void for_each_band(const Workers& workers, const std::function<void()>& check,
                       const VisitBand& visit) const {
        for_bands(0, bands_, workers, check, visit);
    }
    /// Returns CameraRays::direction through a place in samples.
    [[nodiscard]] Vec3 direction(const Vec2& place) const {
        return origin_ + place.x * column_ + place.y * row_;
    }
    [[nodiscard]] const Vec3& eye() const { return eye_; }

    /// Calls visit(half, place, sample, count) for what pixel (x, y) of the band shows: `half` in
    /// `count` samples from number `sample` on, around `place`. Samples that all show one half are
    /// visited together, unless `one_by_one` is set; else each is visited by itself.
    template <class Visit>
    void visit_pixel(const Band& band, int x, int y, bool one_by_one, const Visit& visit) const;

    /// Returns the hit of the ray through a point of the picture on the plane of a facet's half
    /// that it shows. t counts in lengths of CameraRays::direction.
    [[nodiscard]] Hit hit_at(std::uint32_t half, const Vec3& direction) const;

  private:
    struct Triangle;
    using Corners = std::array<Vec3, 3>;
    [[nodiscard]] Corners corners_of(std::uint32_t half) const;
    [[nodiscard]] static double volume(const Corners& corner);
    [[nodiscard]] bool rows_of(std::uint32_t half, int& first, int& last) const;
    [[nodiscard]] Triangle set_up(std::uint32_t half) const;
    void fill_row(const Triangle& triangle, const Vec2& start, std::uint32_t half,
                  std::uint32_t* halves, double* nearness) const;

    const Mesh& mesh_;
    SampleGrid grid_;
    std::span<const Vec2> offsets_;
    Vec2 centre_{0.0}; ///< of the offsets
    Vec3 eye_;
    int bands_;
    /// The direction at sample (0, 0), and what a column and a row add to it.
    Vec3 origin_, column_, row_;
    /// Halves that reach into band b: halves_[first_[b]] to halves_[first_[b + 1]], in order.
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> halves_;
};

template <class Visit>
void VisibleFacets::visit_pixel(const Band& band, int x, int y, bool one_by_one,
                                const Visit& visit) const {
    const auto columns = static_cast<std::size_t>(grid_.columns);
    const std::size_t set = columns * rows_per_band;
    const std::uint32_t* const half =
        &band.half[static_cast<std::size_t>(y % rows_per_band) * columns +
                   static_cast<std::size_t>(x)];
    const auto samples = static_cast<unsigned>(offsets_.size());
    bool same = !one_by_one;
    for (unsigned s = 1; s < samples && same; ++s)
        same = half[s * set] == half[0];
    if (same) {
        if (half[0] != nothing_visible)
            visit(half[0], Vec2(x, y) + centre_, 0u, samples);
        return;
    }
    for (unsigned s = 0; s < samples; ++s)
        if (half[s * set] != nothing_visible)
            visit(half[s * set], Vec2(x, y) + offsets_[s], s, 1u);
}

} // namespace hemilux
