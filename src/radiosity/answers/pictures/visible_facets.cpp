#include "radiosity/answers/pictures/visible_facets.h"

#include "parallel/workers.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {

/// Values that are linear across the picture: at + x column + y row at sample (x, y).
struct VisibleFacets::Triangle {
    struct Linear {
        double at, column, row;
    };
    std::array<Linear, 3> inside; ///< all three are at least 0 within the triangle
    Linear nearness;
};

VisibleFacets::VisibleFacets(const Mesh& mesh, const CameraRays& camera, const SampleGrid& grid,
                             std::span<const Vec2> offsets, unsigned threads)
    : mesh_(mesh), grid_(grid), offsets_(offsets), eye_(camera.eye()),
      bands_((grid.rows + rows_per_band - 1) / rows_per_band), origin_(camera.direction(0, 0)),
      column_(camera.direction(grid.column_width, 0) - origin_),
      row_(camera.direction(0, grid.row_height) - origin_) {
    struct Bands {
        std::uint16_t first = 0, end = 0; // of at most 16384 rows
    };
    for (const Vec2& offset : offsets)
        centre_ += offset / double(offsets.size());
    const std::size_t halves = 2 * mesh.soup_to_trace().facets.size();
    std::vector<Bands> bands(halves);
    Workers(threads).for_chunks(halves, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t half = begin; half < end; ++half) {
            int first = 0, last = 0;
            if (rows_of(static_cast<std::uint32_t>(half), first, last))
                bands[half] = {static_cast<std::uint16_t>(first / rows_per_band),
                               static_cast<std::uint16_t>(last / rows_per_band + 1)};
        }
    });
    first_.assign(static_cast<std::size_t>(bands_) + 1, 0);
    for (const auto& [first, end] : bands)
        for (int band = first; band < end; ++band)
            ++first_[static_cast<std::size_t>(band) + 1];
    for (std::size_t band = 1; band < first_.size(); ++band)
        first_[band] += first_[band - 1];
    halves_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t half = 0; half < halves; ++half)
        for (int band = bands[half].first; band < bands[half].end; ++band)
            halves_[next[static_cast<std::size_t>(band)]++] = half;
}

/// Returns the corners of a half, relative to the eye. The second half of a triangle has one corner
/// twice, so that its volume is 0.
VisibleFacets::Corners VisibleFacets::corners_of(std::uint32_t half) const {
    const FacetSoup soup = mesh_.soup_to_trace();
    const FacetCorners& all = soup.facets[half / 2];
    const bool second = half % 2 == 1;
    return {soup.vertices[all[0]] - eye_, soup.vertices[all[second ? 2 : 1]] - eye_,
            soup.vertices[all[second ? 3 : 2]] - eye_};
}

/// Returns six times the volume between the eye and the triangle; it is negative where the
/// triangle's front faces the eye.
double VisibleFacets::volume(const Corners& corner) {
    return glm::dot(corner[0], glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
}

/// Finds the first and the last row that may show the half; false where no row does.
bool VisibleFacets::rows_of(std::uint32_t half, int& first, int& last) const {
    const Corners corner = corners_of(half);
    const double volume_seen = volume(corner);
    if (!(volume_seen < 0) && !(mesh_.has_back(half / 2) && volume_seen > 0))
        return false;
    // A corner is depth * (origin_ + x column_ + y row_).
    const double all = glm::dot(origin_, glm::cross(column_, row_));
    Vec2 low(grid_.columns, grid_.rows), high(-1.0);
    int behind = 0;
    for (const Vec3& v : corner) {
        const double depth = glm::dot(v, glm::cross(column_, row_)) / all;
        if (!(depth > 0)) {
            ++behind;
            continue;
        }
        const Vec2 place(glm::dot(v, glm::cross(row_, origin_)) / (all * depth),
                         glm::dot(v, glm::cross(origin_, column_)) / (all * depth));
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    if (behind == 3)
        return false;
    const double rows = grid_.rows;
    if (behind > 0) { // it may reach anywhere
        first = 0;
        last = grid_.rows - 1;
        return true;
    }
    first = static_cast<int>(std::floor(std::clamp(low.y - 1, 0.0, rows)));
    last = static_cast<int>(std::floor(std::clamp(high.y + 1, -1.0, rows - 1)));
    return first <= last && high.x >= -1 && low.x <= grid_.columns + 1;
}

VisibleFacets::Triangle VisibleFacets::set_up(std::uint32_t half) const {
    const Corners corner = corners_of(half);
    const auto linear = [&](const Vec3& v, double scale) {
        return Triangle::Linear{scale * glm::dot(v, origin_), scale * glm::dot(v, column_),
                                scale * glm::dot(v, row_)};
    };
    const double volume_seen = volume(corner), sign = volume_seen < 0 ? -1 : 1;
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k)
        triangle.inside[k] = linear(glm::cross(corner[k], corner[(k + 1) % 3]), sign);
    triangle.nearness =
        linear(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), 1 / volume_seen);
    return triangle;
}

void VisibleFacets::fill(int band, Band& out) const {
    const auto columns = static_cast<std::size_t>(grid_.columns);
    const std::size_t size = columns * rows_per_band * offsets_.size();
    out.half.assign(size, nothing_visible);
    out.nearness.assign(size, 0.0);
    const int begin = band * rows_per_band, end = std::min(begin + rows_per_band, grid_.rows);
    for (std::size_t k = first_[static_cast<std::size_t>(band)];
         k < first_[static_cast<std::size_t>(band) + 1]; ++k) {
        const Triangle triangle = set_up(halves_[k]);
        std::size_t at = 0;
        for (const Vec2& offset : offsets_) {
            for (int row = begin; row < end; ++row)
                fill_row(triangle, {offset.x, row + offset.y}, halves_[k],
                         out.half.data() + at + columns * static_cast<std::size_t>(row - begin),
                         out.nearness.data() + at +
                             columns * static_cast<std::size_t>(row - begin));
            at += columns * rows_per_band;
        }
    }
}

void VisibleFacets::for_bands(int from, int to, const Workers& workers,
                              const std::function<void()>& check, const VisitBand& visit) const {
    workers.for_chunks_with(
        static_cast<std::size_t>(to - from), 1, [] { return Band(); },
        [&](Band& band, std::size_t k, std::size_t) {
            check();
            const int number = from + static_cast<int>(k);
            fill(number, band);
            const int first = number * rows_per_band;
            visit(band, first, std::min(first + rows_per_band, grid_.rows));
        });
}

/// Fills the samples of a row in which the half is the nearest so far. `start` is the place of the
/// first sample.
void VisibleFacets::fill_row(const Triangle& triangle, const Vec2& start, std::uint32_t half,
                             std::uint32_t* halves, double* nearness) const {
    int low = 0, high = grid_.columns - 1;
    for (const Triangle::Linear& edge : triangle.inside) {
        const double first = edge.at + edge.row * start.y + edge.column * start.x;
        const auto value = [&](int x) { return first + edge.column * x; };
        // A division may be off by one sample; the sign decides.
        const double root = std::clamp(-first / edge.column, -1.0, double(grid_.columns));
        if (edge.column > 0) {
            int x = std::max(0, static_cast<int>(std::ceil(root)));
            if (x > 0 && value(x - 1) >= 0)
                --x;
            else if (x < grid_.columns && !(value(x) >= 0))
                ++x;
            low = std::max(low, x);
        } else if (edge.column < 0) {
            int x = std::min(grid_.columns - 1, static_cast<int>(std::floor(root)));
            if (x + 1 < grid_.columns && value(x + 1) >= 0)
                ++x;
            else if (x >= 0 && !(value(x) >= 0))
                --x;
            high = std::min(high, x);
        } else if (!(first >= 0)) {
            return;
        }
    }
    const auto& [at, column, row] = triangle.nearness;
    const double first = at + row * start.y + column * start.x;
    for (int x = low; x <= high; ++x) {
        const double near = first + column * x;
        const bool is_nearer = near > nearness[x];
        nearness[x] = is_nearer ? near : nearness[x];
        halves[x] = is_nearer ? half : halves[x];
    }
}

Hit VisibleFacets::hit_at(std::uint32_t half, const Vec3& direction) const {
    const Corners corner = corners_of(half);
    const Vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    // Its sign says for all samples alike which side faces the eye, as in rows_of().
    const double volume_seen = volume(corner);
    const double distance = volume_seen / glm::dot(normal, direction);
    const Vec3 point = distance * direction;
    const double square = glm::dot(normal, normal);
    const double u =
        glm::dot(normal, glm::cross(point - corner[0], corner[2] - corner[0])) / square;
    const double v =
        glm::dot(normal, glm::cross(corner[1] - corner[0], point - corner[0])) / square;
    return {half / 2, distance, u, v, half % 2 == 1, volume_seen < 0};
}

} // namespace hemilux
