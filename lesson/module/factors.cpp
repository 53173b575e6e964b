// Form factors: in closed form, by rays and by a hemicube.

#include "module/calls.h"
#include "module/room.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/form_factors/closed_form_factors.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <numbers>
#include <optional>

using namespace hemilux;
using namespace hemilux::lesson;

/// Puts A_i F_ij [m2] of two patches with nothing in between, by contour integration.
LESSON_CALL bool factor_closed(const Room* room, std::uint32_t i, std::uint32_t j) {
    return answered([&] {
        const auto patches = room->mesh.patches();
        put(room->mesh.frame().area_to_world(exchange_area(patches[i].shape, patches[j].shape)));
    });
}

/// Traces rays from a patch by the cosine law. Puts for each, as room_noted does: where it starts
/// and ends [m], and the patch that it hits.
LESSON_CALL bool factor_rays(Room* room, std::uint32_t patch, std::uint32_t rays, double seed) {
    return answered([&] {
        const auto start = PatchStart::in_any_axes(room->mesh, patch);
        Rng random(hash_words({static_cast<std::uint64_t>(seed), patch}));
        room->tracer.note(rays);
        for (std::uint32_t ray = 0; ray < rays; ++ray)
            (void)room->tracer.closest(start.cosine_ray(random));
        const LocalFrame& frame = room->mesh.frame();
        for (const NotedRay& ray : room->tracer.noted()) {
            put(frame.to_world(ray.from)), put(frame.to_world(ray.to));
            put(ray.patch != none ? double(ray.patch) : ray.escaped ? -1.0 : -2.0);
        }
        room->tracer.note(0);
    });
}

/// Puts, for each pixel of a hemicube over a patch: its direction in the world, of any length, its
/// delta factor [-] and the patch that it shows, or -1.
LESSON_CALL bool factor_hemicube(const Room* room, std::uint32_t patch, std::uint32_t edge) {
    return answered([&] {
        const Hemicube cube(edge);
        const Frame frame = room->mesh.hemisphere_frame(patch);
        const Patch& from = room->mesh.patches()[patch];
        for (std::size_t pixel = 0; pixel < cube.pixels(); ++pixel) {
            const Vec3 direction = frame.to_world(cube.direction(pixel));
            const auto hit = room->tracer.closest(
                {.origin = from.centre, .direction = direction, .from = from.facet});
            const std::uint32_t seen = hit ? room->mesh.patch_at(*hit) : none;
            put(direction), put(cube.delta_factor(pixel)), put(seen == none ? -1.0 : seen);
        }
    });
}

/// Puts the matrix F of a room, row by row. Pairs that see each other fully are exact; the others
/// are integrals along lines, and so many rays from each patch, a power of two, find what is lost.
LESSON_CALL bool room_factors(const Room* room, std::uint32_t rays, double seed) {
    return answered([&] {
        const Workers workers(1);
        Monitor monitor;
        const ClosedFormFactors exact(room->mesh, room->tracer, workers, monitor);
        const std::optional<ClosedFactors> factors = exact.batch(
            static_cast<std::uint64_t>(seed), std::max(rays, ClosedFormFactors::min_rays),
            relative_above(.01, 1e-3), workers, monitor);
        const SparseMatrix& F = factors->matrix;
        const std::size_t n = F.rows();
        answer().assign(n * n, 0.0);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = F.row_begin[i]; k < F.row_begin[i + 1]; ++k)
                answer()[i * n + F.column[k]] = F.value[k];
    });
}

namespace {

/// A point of a surface in the local frame.
struct Point {
    Vec3 place, normal;
    std::uint32_t facet;
};

/// Returns the irradiance from what patches emit [W/m2], by so many shadow rays to each emitter.
Vec3 direct_light(const Room& room, const Point& at, std::uint32_t rays, Rng& random) {
    Vec3 sum(0.0);
    for (const Patch& patch : room.mesh.patches()) {
        const Vec3 emission = room.mesh.material(patch).emission;
        for (std::uint32_t ray = 0; ray < rays && emission != Vec3(0.0); ++ray) {
            const double u = random.uniform(), v = random.uniform();
            const Vec3 to = patch.shape.sample({u, v}) - at.place;
            const double r_squared = glm::dot(to, to);
            const double cosines = glm::dot(at.normal, to) * glm::dot(patch.normal, -to);
            const Ray shadow{.origin = at.place, .direction = to, .t_max = 1, .from = at.facet};
            if (glm::dot(at.normal, to) > 0 && cosines > 0 &&
                !room.tracer.occluded(shadow, patch.facet))
                sum += emission * patch.area * cosines /
                       (std::numbers::pi * r_squared * r_squared * double(rays));
        }
    }
    return sum;
}

/// Returns the irradiance from what patches reflect [W/m2], where their radiosity is three numbers
/// each.
Vec3 reflected_light(const Room& room, const Point& at, const double* radiosity, std::uint32_t rays,
                     Rng& random) {
    const Frame frame = Frame::from_normal(at.normal);
    Vec3 sum(0.0);
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
        const auto hit = room.tracer.closest({.origin = at.place,
                                              .direction = frame.to_world(sample_cosine(random)),
                                              .from = at.facet});
        const std::uint32_t seen = hit ? room.mesh.patch_at(*hit) : none;
        if (seen == none)
            continue;
        const double* const B = radiosity + std::size_t{3} * seen;
        sum += Vec3(B[0], B[1], B[2]) - room.mesh.material(seen).emission;
    }
    return sum / double(rays);
}

} // namespace

/// Puts, for each point, the irradiance [W/m2] in three channels that rays gather from a radiosity,
/// and shadow rays from what is emitted. A point is seven numbers: place [m], normal and the patch
/// that it lies on.
LESSON_CALL bool room_gather(const Room* room, const double* radiosity, const double* points,
                             std::uint32_t count, std::uint32_t rays, double seed) {
    return answered([&] {
        for (std::uint32_t p = 0; p < count; ++p) {
            const double* const at = points + std::size_t{7} * p;
            const Point point{room->mesh.frame().to_local({at[0], at[1], at[2]}),
                              {at[3], at[4], at[5]},
                              room->mesh.patches()[static_cast<std::size_t>(at[6])].facet};
            Rng random(hash_words({static_cast<std::uint64_t>(seed), p}));
            put(direct_light(*room, point, std::max(1U, rays / 8), random) +
                reflected_light(*room, point, radiosity, rays, random));
        }
    });
}
