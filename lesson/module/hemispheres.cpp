// Divided hemispheres: the table that all patches share, the counts of a patch, and those of 1997.

#include "module/calls.h"
#include "module/room.h"
#include "parallel/workers.h"
#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/pages/ray_numbers.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>

using namespace hemilux;
using namespace hemilux::lesson;

/// Puts the directions of the vertices, in a patch's own frame.
LESSON_CALL bool hemisphere_vertices(int depth) {
    return answered([&] {
        const Hemisphere hemisphere(depth);
        for (const Vec3& vertex : hemisphere.vertices())
            put(vertex);
    });
}

/// Puts, for each triangle: three vertices, the level, the first of four children (0 at the last
/// level), the solid angle [sr] and the projected solid angle [sr].
LESSON_CALL bool hemisphere_cells(int depth) {
    return answered([&] {
        const Hemisphere hemisphere(depth);
        for (const Hemisphere::Cell& cell : hemisphere.cells()) {
            for (const std::uint16_t vertex : cell.vertex)
                put(vertex);
            put(cell.level), put(cell.first_child);
            put(cell.solid_angle), put(cell.projected_solid_angle);
        }
    });
}

/// Puts directions of a triangle, in a patch's own frame, as rays of the page of section 5 have
/// them: by the cosine law.
LESSON_CALL bool hemisphere_rays(int depth, std::uint32_t cell, std::uint32_t rays, double seed) {
    return answered([&] {
        const Hemisphere hemisphere(depth);
        const std::uint64_t key = hash_words({static_cast<std::uint64_t>(seed), cell});
        for (std::uint32_t ray = 0; ray < rays; ++ray) {
            plain::RayNumbers random(key, ray);
            put(hemisphere.cells().at(cell).shape.sample_rejection(random));
        }
    });
}

/// Puts the three axes of the frame in which the hemisphere of a patch stands.
LESSON_CALL bool room_axes(const Room* room, std::uint32_t patch) {
    return answered([&] {
        const Frame frame = room->mesh.hemisphere_frame(patch);
        for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
            put(frame.to_world(axis));
    });
}

/// Puts the surfaces that density rays from the centre of a patch count, by vertex of the
/// hemisphere.
LESSON_CALL bool room_counts(const Room* room, std::uint32_t patch, int depth) {
    return answered([&] {
        const Hemisphere hemisphere(depth);
        const Frame frame = room->mesh.hemisphere_frame(patch);
        const Patch& from = room->mesh.patches()[patch];
        for (const Vec3& vertex : hemisphere.vertices())
            put(std::min(room->tracer.count({.origin = from.centre,
                                             .direction = frame.to_world(density_direction(vertex)),
                                             .from = from.facet}),
                         255U));
    });
}

/// Puts the triangles of the technique of 1997 over one whole patch, after `stored` steps by counts
/// and `estimated` steps by estimates: for each of three corners the direction, in the patch's
/// frame, and its count.
LESSON_CALL bool room_hemisphere_1997(const Room* room, std::uint32_t patch, int stored,
                                      int estimated) {
    return answered([&] {
        Monitor monitor;
        Subdivision1997 division(room->mesh, room->needs,
                                 {.stored_steps = static_cast<std::uint32_t>(stored),
                                  .estimated_steps = static_cast<std::uint32_t>(estimated),
                                  .parts = 1});
        for (int level = 0; level <= stored; ++level)
            division.find(level, room->tracer, Workers(1), monitor);
        const int last = stored + estimated;
        for (std::size_t k = 0; k < Subdivision1997::triangles(last); ++k)
            for (const CountedDirection& corner : division.triangle(patch, 0, last, k))
                put(corner.direction), put(corner.surfaces);
    });
}
