#include "io/pictures/automatic_camera.h"

#include "geometry/box.h"
#include "geometry/elementary.h"
#include "parallel/workers.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace hemilux {
namespace {

constexpr double outside_fov = 40, inside_fov = 60; // vertical [degrees]

/// Returns whether the patch belongs to the scene and not to a sun or sky around it.
bool is_near(const Mesh& mesh, std::size_t patch) {
    return !mesh.material(static_cast<std::uint32_t>(patch)).is_far;
}

/// Returns the box around all near patches.
Box box_of_near(const Mesh& mesh) {
    Box box;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i)
        if (is_near(mesh, i))
            box.include(box_of(mesh.patches()[i].shape.corner));
    return box;
}

/// Returns a unit vector from its azimuth and elevation [degrees].
Vec3 direction(int up, double azimuth, double elevation) {
    const Vec2 around = elementary::on_circle(azimuth * std::numbers::pi / 180);
    const Vec2 above = elementary::on_circle(elevation * std::numbers::pi / 180);
    Vec3 result;
    result[up] = above.y;
    result[(up + 1) % 3] = above.x * around.y;
    result[(up + 2) % 3] = above.x * around.x;
    return result;
}

/// Returns a camera outside the box, as near as the whole box fits into the picture.
Camera outside_camera(const Box& box, const Vec3& up, const Vec3& toward_eye, double aspect) {
    const double tan_y = elementary::tan(outside_fov * std::numbers::pi / 360),
                 tan_x = aspect * tan_y;
    const Vec3 right = glm::normalize(glm::cross(up, toward_eye));
    const Vec3 upward = glm::cross(toward_eye, right), centre = box.centre();
    double distance = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 q = 0.51 * box.extent() *
                       Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const double across =
            std::max(std::abs(glm::dot(q, right)) / tan_x, std::abs(glm::dot(q, upward)) / tan_y);
        distance = std::max(distance, across + glm::dot(q, toward_eye));
    }
    return {centre + distance * toward_eye, centre, up, outside_fov};
}

/// Returns views from outside, and from the middles of about 500 cells of the box. All are in the
/// local frame.
std::vector<Camera> candidates(const Box& box, int up_axis, double aspect) {
    Vec3 up(0.0);
    up[up_axis] = 1;
    std::vector<Camera> cameras;
    for (const double elevation : {0.0, 15.0, 30.0, 50.0})
        for (double azimuth = 0; azimuth < 360; azimuth += 22.5)
            cameras.push_back(
                outside_camera(box, up, direction(up_axis, azimuth, elevation), aspect));
    const Vec3 extent = glm::max(box.extent(), Vec3(0.01));
    const double ahead = .5 * glm::length(box.extent()); // the target is a place to read and change
    const Vec3 n = glm::clamp(
        glm::round(extent / elementary::pow(extent.x * extent.y * extent.z / 500, 1.0 / 3)), 1.0,
        64.0);
    for (double x = 0.5; x < n.x; ++x)
        for (double y = 0.5; y < n.y; ++y)
            for (double z = 0.5; z < n.z; ++z)
                for (double azimuth = 22.5; azimuth < 360; azimuth += 45) {
                    const Vec3 eye = box.low + box.extent() * Vec3(x, y, z) / n;
                    cameras.push_back(
                        {eye, eye + ahead * direction(up_axis, azimuth, -10), up, inside_fov});
                }
    return cameras;
}

/// Marks the near patches that have more than a tenth of the mean reflected light; in a dark scene
/// it marks all of them.
std::vector<bool> lit_patches(const Mesh& mesh, std::span<const Vec3> radiosity) {
    const auto light = [&](std::size_t i) { return glm::dot(radiosity[i], Vec3(1)); };
    double power = 0, area = 0;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        if (!is_near(mesh, i))
            continue;
        const Vec3 emission = mesh.material(static_cast<std::uint32_t>(i)).emission;
        power += mesh.patches()[i].area * (light(i) - glm::dot(emission, Vec3(1)));
        area += mesh.patches()[i].area;
    }
    std::vector<bool> lit;
    for (std::size_t i = 0; i < radiosity.size(); ++i)
        lit.push_back(is_near(mesh, i) && (!(power > 0) || light(i) > 0.1 * power / area));
    return lit;
}

/// Returns one number for surfaces that look alike: of one group and material, turned to one side.
std::uint64_t kind_of(const Mesh& mesh, const Patch& patch) {
    const int axis = largest_axis(patch.normal), side = 2 * axis + (patch.normal[axis] > 0);
    const std::uint64_t group = mesh.scene().facets[patch.facet].group;
    return (group << 32) + std::uint64_t{patch.material} * 6 + static_cast<std::uint64_t>(side);
}

/// The quality of a view, estimated by a few rays.
struct Rating {
    double score = 0;
    double enclosed = 0; ///< the share of rays that meet a front of the scene
};

bool is_from_outside(const Camera& camera) { return camera.vertical_fov_degrees == outside_fov; }

/// Rates a view by how much of the picture shows lit fronts, how many kinds of them, and how far
/// the near ones are.
Rating rate(const Camera& camera, const Mesh& mesh, const Tracer& tracer,
            const std::vector<bool>& lit, double aspect) {
    constexpr int columns = 16, rows = 12;
    const CameraRays view(camera, mesh, aspect);
    std::array<Ray, std::size_t{columns} * rows> rays;
    std::array<FacetHit, rays.size()> hits;
    for (std::size_t k = 0; k < rays.size(); ++k)
        rays[k] =
            view.ray((double(k % columns) + 0.5) / columns, (double(k / columns) + 0.5) / rows);
    tracer.closest_stream(rays, hits);
    std::vector<std::uint64_t> seen;
    std::vector<double> depths;
    Rating result;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (hits[k].facet == none)
            continue;
        const Hit hit = tracer.locate(rays[k], hits[k].facet);
        const std::uint32_t patch = mesh.patch_at(hit);
        if (patch == none)
            continue;
        if (is_near(mesh, patch))
            result.enclosed += 1.0 / rays.size();
        if (lit[patch]) {
            seen.push_back(kind_of(mesh, mesh.patches()[patch]));
            depths.push_back(hit.t);
        }
    }
    if (seen.empty())
        return result;
    const auto pixels = static_cast<double>(seen.size());
    std::ranges::sort(seen);
    const auto kinds = std::unique(seen.begin(), seen.end()) - seen.begin();
    std::ranges::sort(depths);
    // An open box is meant to be looked into.
    const double favour = is_from_outside(camera) ? 1.3 : 1;
    result.score =
        favour * pixels * std::sqrt(double(kinds)) * std::sqrt(depths[depths.size() / 4]);
    return result;
}

/// Returns whether hardly any view from within the scene's box shows walls all around. Such a scene
/// is a thing, not a set of rooms.
bool is_object(std::span<const Camera> cameras, std::span<const Rating> ratings) {
    constexpr double all_around = 0.8, min_of_rooms = 0.1;
    double enclosed = 0, views = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (!is_from_outside(cameras[i])) {
            enclosed += ratings[i].enclosed > all_around;
            views += 1;
        }
    return enclosed < min_of_rooms * views;
}

} // namespace

int guess_up(const Mesh& mesh) {
    const Vec3 extent = glm::max(box_of_near(mesh).extent(), Vec3(1e-9));
    Vec3 down(1e-9), facing(1e-9);
    for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
        if (!is_near(mesh, i))
            continue;
        const Patch& patch = mesh.patches()[i];
        const Vec3& e = mesh.material(static_cast<std::uint32_t>(i)).emission;
        down += patch.area * (e.x + e.y + e.z) * glm::max(-patch.normal, Vec3(0.0));
        facing += patch.area * glm::abs(patch.normal);
    }
    const auto for_z = [](double y, double z) {
        return std::clamp(elementary::log(z / y), -1.0, 1.0);
    };
    const double evidence =
        for_z(down.y, down.z) + for_z(facing.y, facing.z) + 0.5 * for_z(extent.z, extent.y);
    return evidence > 0.7 ? 2 : 1;
}

Camera automatic_camera(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                        double aspect, std::optional<int> up, unsigned threads) {
    const Box box = box_of_near(mesh);
    std::vector<Camera> cameras = candidates(box, up ? *up : guess_up(mesh), aspect);
    std::vector<Rating> ratings(cameras.size());
    const std::vector<bool> lit = lit_patches(mesh, radiosity);
    Workers(threads).for_chunks(cameras.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            cameras[i].eye = mesh.frame().to_world(cameras[i].eye);
            cameras[i].target = mesh.frame().to_world(cameras[i].target);
            ratings[i] = rate(cameras[i], mesh, tracer, lit, aspect);
        }
    });
    if (is_object(cameras, ratings))
        for (std::size_t i = 0; i < cameras.size(); ++i)
            ratings[i].score *= is_from_outside(cameras[i]) ? 1 : 0;
    const auto best = std::ranges::max_element(ratings, {}, &Rating::score);
    return cameras[static_cast<std::size_t>(best - ratings.begin())];
}

} // namespace hemilux
