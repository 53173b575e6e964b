#include "io/pictures/automatic_camera.h"

#include "geometry/box.h"
#include "io/pictures/view_judge.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hemilux {
namespace {

constexpr double outside_fov = 40, inside_fov = 60; // vertical [degrees]

/// A camera in the local frame and what it is worth.
struct Candidate {
    Camera camera;
    double score = 0;
};

/// The box of the scene, local frame, and which way is up.
struct Place {
    Box box;
    int up; ///< axis

    /// A unit vector by its azimuth and elevation [rad].
    Vec3 direction(double azimuth, double elevation) const {
        Vec3 result;
        result[up] = std::sin(elevation);
        result[(up + 1) % 3] = std::cos(elevation) * std::sin(azimuth);
        result[(up + 2) % 3] = std::cos(elevation) * std::cos(azimuth);
        return result;
    }
    Vec3 up_vector() const {
        Vec3 result(0.0);
        result[up] = 1;
        return result;
    }
};

/// Lamps shine down, floors and ceilings are wider than walls, rooms wider than high. y unless most
/// of that speaks for z.
int guess_up(const Mesh& mesh, const Box& box) {
    constexpr double enough = 0.7;
    Vec3 down(1e-9), facing(1e-9);
    for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        const Vec3& e = mesh.material(static_cast<std::uint32_t>(i)).emission;
        down += patch.area * (e.x + e.y + e.z) * glm::max(-patch.normal, Vec3(0.0));
        facing += patch.area * glm::abs(patch.normal);
    }
    const Vec3 extent = glm::max(box.extent(), Vec3(1e-9));
    const auto for_z = [](double y, double z) { return std::clamp(std::log(z / y), -1.0, 1.0); };
    const double evidence =
        for_z(down.y, down.z) + for_z(facing.y, facing.z) + 0.5 * for_z(extent.z, extent.y);
    return evidence > enough ? 2 : 1;
}

/// From outside, as near as the whole box fits into the picture.
Camera outside_camera(const Place& place, const Vec3& toward_eye, double aspect) {
    const double tan_y = std::tan(outside_fov * std::numbers::pi / 360), tan_x = aspect * tan_y;
    const Vec3 right = glm::normalize(glm::cross(place.up_vector(), toward_eye));
    const Vec3 upward = glm::cross(toward_eye, right);
    const Vec3 half = 0.5 * place.box.extent();
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 q(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                     corner & 4 ? half.z : -half.z);
        const double needed =
            std::max(std::abs(glm::dot(q, right)) / tan_x, std::abs(glm::dot(q, upward)) / tan_y);
        distance = std::max(distance, needed + glm::dot(q, toward_eye));
    }
    constexpr double margin = 1.02;
    const Vec3 centre = place.box.centre();
    return {centre + margin * distance * toward_eye, centre, place.up_vector(), outside_fov};
}

std::vector<Camera> outside_cameras(const Place& place, double aspect) {
    constexpr int azimuths = 16;
    std::vector<Camera> cameras;
    for (const double degrees : {0.0, 15.0, 35.0, 55.0, 75.0})
        for (int i = 0; i < azimuths; ++i)
            cameras.push_back(outside_camera(place,
                                             place.direction(2 * std::numbers::pi * i / azimuths,
                                                             degrees * std::numbers::pi / 180),
                                             aspect));
    return cameras;
}

/// The middles of about `wanted` nearly cubic cells that fill the box.
std::vector<Vec3> grid_in(const Box& box, double wanted) {
    constexpr double thinnest = 0.01, most = 64;
    const Vec3 extent = glm::max(box.extent(), Vec3(thinnest));
    const double cell = std::cbrt(extent.x * extent.y * extent.z / wanted);
    const Vec3 n = glm::clamp(glm::round(extent / cell), 1.0, most);
    std::vector<Vec3> points;
    for (double x = 0.5; x < n.x; ++x)
        for (double y = 0.5; y < n.y; ++y)
            for (double z = 0.5; z < n.z; ++z)
                points.push_back(box.low + box.extent() * Vec3(x, y, z) / n);
    return points;
}

Camera to_world(const Camera& camera, const LocalFrame& frame) {
    return {frame.to_world(camera.eye), frame.to_world(camera.target), camera.up,
            camera.vertical_fov_degrees};
}

/// The best view from a point inside, by few rays; score 0 where it is not inside.
Candidate inside_candidate(const ViewJudge& judge, const Place& place, const Vec3& eye,
                           double aspect, const LocalFrame& frame) {
    constexpr int azimuths = 8;
    Candidate best;
    if (!judge.is_inside(eye))
        return best;
    for (const double degrees : {-5.0, -20.0})
        for (int i = 0; i < azimuths; ++i) {
            const Vec3 forward = place.direction(2 * std::numbers::pi * (i + 0.5) / azimuths,
                                                 degrees * std::numbers::pi / 180);
            const Camera camera =
                to_world({eye, eye + forward, place.up_vector(), inside_fov}, frame);
            const double score = judge.score(camera, aspect, 8, 6);
            if (score > best.score)
                best = {camera, score};
        }
    return best;
}

/// The views from inside that look best at first sight.
std::vector<Candidate> inside_candidates(const ViewJudge& judge, const Place& place, double aspect,
                                         const LocalFrame& frame) {
    constexpr double places = 1000; // more: better views of large maps, proportionally slower
    constexpr std::size_t most = 32;
    const std::vector<Vec3> eyes = grid_in(place.box, places);
    std::vector<Candidate> candidates(eyes.size());
    Workers(0).for_chunks(eyes.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            candidates[i] = inside_candidate(judge, place, eyes[i], aspect, frame);
    });
    std::erase_if(candidates, [](const Candidate& c) { return !(c.score > 0); });
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    candidates.resize(std::min(candidates.size(), most));
    return candidates;
}

} // namespace

Camera automatic_camera(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                        double aspect) {
    Place place{.box = {}, .up = 1};
    for (const Patch& patch : mesh.patches())
        for (const Vec3& corner : patch.shape.corner)
            place.box.include(corner);
    place.up = guess_up(mesh, place.box);

    // The best views from inside and all from outside are judged by more rays.
    const ViewJudge judge(mesh, tracer, radiosity);
    std::vector<Candidate> candidates = inside_candidates(judge, place, aspect, mesh.frame());
    const std::size_t inside = candidates.size();
    for (const Camera& camera : outside_cameras(place, aspect))
        candidates.push_back({to_world(camera, mesh.frame()), 0});
    Workers(0).for_chunks(candidates.size(), 1, [&](std::size_t i, std::size_t) {
        constexpr double favour = 1.3; // an open box is meant to be looked into
        candidates[i].score =
            (i < inside ? 1 : favour) * judge.score(candidates[i].camera, aspect, 32, 24);
    });
    const auto worse = [](const Candidate& a, const Candidate& b) { return a.score < b.score; };
    return std::max_element(candidates.begin(), candidates.end(), worse)->camera;
}

} // namespace hemilux
