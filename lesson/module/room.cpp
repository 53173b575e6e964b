#include "module/room.h"

#include "module/calls.h"
#include "radiosity/engine/needs/find_needs.h"

namespace hemilux::lesson {

void NotingTracer::note(std::size_t rays) {
    noted_.clear();
    room_for_ = rays;
}

std::optional<Hit> NotingTracer::closest(const Ray& ray) const {
    const std::optional<Hit> hit = tracer_->closest(ray);
    note(ray, hit);
    return hit;
}

void NotingTracer::closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const {
    tracer_->closest_stream(rays, out);
    for (std::size_t k = 0; k < rays.size() && noted_.size() < room_for_; ++k)
        note(rays[k], out[k].facet == none ? std::nullopt
                                           : std::optional(tracer_->locate(rays[k], out[k].facet)));
}

void NotingTracer::note(const Ray& ray, const std::optional<Hit>& hit) const {
    if (noted_.size() >= room_for_)
        return;
    constexpr double far = 4; // scenes lie in [-1,1]^3
    const double t = hit ? hit->t : far / glm::length(ray.direction);
    noted_.push_back(
        {ray.origin, ray.origin + t * ray.direction, hit ? mesh_.patch_at(*hit) : none, !hit});
}

Room::Room(Scene scene, double max_edge)
    : mesh(std::move(scene), {.max_edge = max_edge}), needs(find_needs(mesh)),
      tracer(mesh, make_tracer(mesh, 1).tracer) {}

namespace {

/// Reads facets as five numbers each: four corners, the last two alike in a triangle, and the
/// material. A material is six numbers: reflectance, then emission.
Scene scene_of(const double* vertices, std::uint32_t vertex_count, const double* facets,
               std::uint32_t facet_count, const double* materials, std::uint32_t material_count) {
    Scene scene;
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        scene.vertices.emplace_back(vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]);
    for (std::uint32_t m = 0; m < material_count; ++m) {
        const double* const of = materials + 6 * m;
        scene.materials.push_back({.name = std::to_string(m),
                                   .reflectance = {of[0], of[1], of[2]},
                                   .emission = {of[3], of[4], of[5]}});
    }
    scene.groups = {"room"};
    for (std::uint32_t f = 0; f < facet_count; ++f) {
        const auto of = [&](std::uint32_t k) {
            return static_cast<std::uint32_t>(facets[5 * f + k]);
        };
        scene.facets.push_back({{of(0), of(1), of(2), of(3)}, scene.faces++, of(4), 0});
    }
    return scene;
}

} // namespace
} // namespace hemilux::lesson

using namespace hemilux;
using namespace hemilux::lesson;

/// Makes a room and puts its handle. Facets are divided until no edge is longer than `max_edge`
/// [m]; 0 divides none.
LESSON_CALL bool room_new(const double* vertices, std::uint32_t vertex_count, const double* facets,
                          std::uint32_t facet_count, const double* materials,
                          std::uint32_t material_count, double max_edge) {
    return answered([&] {
        put(handle_of(new Room(
            scene_of(vertices, vertex_count, facets, facet_count, materials, material_count),
            max_edge)));
    });
}

LESSON_CALL void room_delete(const Room* room) { delete room; }

/// Puts, for each patch, in world units: the number of its corners, four corners, centre, normal,
/// area [m2], facet, material, reflectance, emission.
LESSON_CALL bool room_patches(const Room* room) {
    return answered([&] {
        const LocalFrame& frame = room->mesh.frame();
        for (const Patch& patch : room->mesh.patches()) {
            put(patch.shape.size());
            for (const Vec3& corner : patch.shape.corner)
                put(frame.to_world(corner));
            put(frame.to_world(patch.centre));
            put(patch.normal);
            put(frame.area_to_world(patch.area));
            put(patch.facet);
            put(patch.material);
            put(room->mesh.material(patch).reflectance);
            put(room->mesh.material(patch).emission);
        }
    });
}

/// Puts the patch on which a ray through the world ends and its distance [m]; -1 for no patch.
LESSON_CALL bool room_look(const Room* room, double x, double y, double z, double dx, double dy,
                           double dz) {
    return answered([&] {
        const LocalFrame& frame = room->mesh.frame();
        Ray ray{.origin = frame.to_local({x, y, z}), .direction = {dx, dy, dz}};
        // A room is seen from outside through the backs of its walls.
        for (int walls = 0; walls < 64; ++walls) {
            const auto hit = room->tracer.closest(ray);
            if (!hit)
                break;
            if (const std::uint32_t patch = room->mesh.patch_at(*hit); patch != none) {
                put(patch), put(hit->t / frame.scale);
                return;
            }
            ray.t_min = hit->t * (1 + 1e-9);
        }
        put(-1), put(0);
    });
}

LESSON_CALL bool room_note(Room* room, std::uint32_t rays) {
    return answered([&] { room->tracer.note(rays); });
}

/// Puts, for each ray that was noted, where it starts and ends [m] and the patch that it hit: -1
/// where it left the scene, -2 on the back of a face.
LESSON_CALL bool room_noted(const Room* room) {
    return answered([&] {
        const LocalFrame& frame = room->mesh.frame();
        for (const NotedRay& ray : room->tracer.noted()) {
            put(frame.to_world(ray.from)), put(frame.to_world(ray.to));
            put(ray.patch != none ? double(ray.patch) : ray.escaped ? -1.0 : -2.0);
        }
    });
}
