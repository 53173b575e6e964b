#include "radiosity/answers/pictures/gather_grid.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hemilux {
namespace {

constexpr Vec2 pixel_centre(.5);

} // namespace

Ray ray_between(const SurfacePoint& a, const SurfacePoint& b) {
    const double height = .5 * glm::distance(a.position, b.position);
    const Vec3 from = a.position + height * a.normal, to = b.position + height * b.normal;
    return {.origin = from, .direction = to - from, .t_max = 1};
}

GatherGrid::GatherGrid(const Mesh& mesh, const CameraRays& camera, int width, int height,
                       const std::function<void()>& check, const Workers& workers)
    : columns_((width + step - 1) / step), rows_((height + step - 1) / step) {
    const std::array<Vec2, 1> offsets{pixel_centre};
    const VisibleFacets visible(mesh, camera,
                                {columns_, rows_, double(step) / width, double(step) / height},
                                offsets, workers.threads());
    const auto columns = static_cast<std::size_t>(columns_);
    points_.resize(columns * static_cast<std::size_t>(rows_));
    for (GridPoint& point : points_)
        point.at.facet = none;
    visible.for_each_band(workers, check, [&](const VisibleFacets::Band& band, int first, int end) {
        const auto begin = static_cast<std::size_t>(first) * columns;
        for (std::size_t k = begin; k < static_cast<std::size_t>(end) * columns; ++k) {
            const std::uint32_t half = band.half[k - begin];
            if (half == nothing_visible)
                continue;
            const Vec2 place(static_cast<double>(k % columns), static_cast<double>(k / columns));
            const Vec3 direction = visible.direction(place + pixel_centre);
            const Hit hit = visible.hit_at(half, direction);
            const std::uint32_t patch = mesh.patch_at(hit);
            points_[k].at = {visible.eye() + hit.t * direction, mesh.patches()[patch].normal,
                             hit.facet};
        }
    });
    check(); // before what is gathered takes memory
}

double GatherGrid::spacing(int x, int y) const {
    const GridPoint* const here = point(x, y);
    double largest = 0;
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}})
        if (const GridPoint* const there = point(x + dx, y + dy);
            there && here->is_of_surface(*there))
            largest = std::max(largest, glm::distance(here->at.position, there->at.position));
    return largest;
}

void GatherGrid::ask_neighbours(int first, int end, const Workers& workers) {
    const auto columns = static_cast<std::size_t>(columns_);
    std::vector<Asked> asked = std::move(asked_); // of row first - 1, then of the others
    const std::size_t before = asked.size(), begin = static_cast<std::size_t>(first) * columns;
    asked.resize(before + static_cast<std::size_t>(end - first) * columns);
    for_each_point(first, end, workers, [&](const GridPoint& here, int x, int y) {
        float sum = 0, count = 0;
        Asked& of = asked[before + number_of(here) - begin];
        for_each_around(here, x, y, 1, [&](const GridPoint& there) {
            sum += there.nearness;
            ++count;
            of.shadow |= there.shadow;
        });
        of.nearness = sum / count;
    });
    const std::size_t left = end < rows_ ? columns : 0;
    for (std::size_t k = 0; k + left < asked.size(); ++k) {
        GridPoint& point = points_[begin - before + k];
        point.nearness = asked[k].nearness;
        point.shadow = asked[k].shadow;
    }
    asked_.assign(asked.end() - static_cast<std::ptrdiff_t>(left), asked.end());
}

} // namespace hemilux
