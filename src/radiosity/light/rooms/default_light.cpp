#include "radiosity/light/rooms/default_light.h"

#include "geometry/elementary.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <numbers>

namespace hemilux {
namespace {

/// Below this share of directions that lead outside, daylight leaves a space dark; a room with a
/// window has about 0.02.
constexpr double min_openness_of_daylight = 0.05;
/// Above this share, there is an outside.
constexpr double min_openness = 0.004;
/// A space of a smaller share of all places is a cupboard.
constexpr double min_share_of_room = 0.02;
constexpr std::size_t max_lamps = 12;

/// Returns how much of a sun the places get, in the mean [cosine].
double sunshine(const Mesh& mesh, const Tracer& tracer, const std::vector<SeenPlace>& places,
                const Vec3& to_sun) {
    double sum = 0;
    for (const SeenPlace& place : places) {
        const double cosine = glm::dot(place.normal, to_sun);
        if (!(cosine > 0))
            continue;
        const std::optional<Hit> hit =
            tracer.closest({.origin = place.point, .direction = to_sun, .from = place.facet});
        if (!hit || mesh.scene().materials[mesh.scene().facets[hit->facet].material].is_far)
            sum += cosine;
    }
    return sum;
}

/// Returns the direction of the light of a sun as it stands in the afternoon, on the side from
/// which most of it arrives.
Vec3 sun_of(const Mesh& mesh, const Tracer& tracer, const std::vector<SeenPlace>& places, int up) {
    constexpr int sides = 12;
    constexpr double height = 0.9; // tangent of the elevation: 42 degrees
    Vec3 best(0.0);
    double most = -1;
    for (int k = 0; k < sides; ++k) {
        const Vec2 around = elementary::on_circle((k + 0.3) * 2 * std::numbers::pi / sides);
        Vec3 light(0.0);
        light[up] = -height;
        light[(up + 1) % 3] = around.x;
        light[(up + 2) % 3] = around.y;
        const double found = sunshine(mesh, tracer, places, glm::normalize(-light));
        if (found > most) {
            most = found;
            best = light;
        }
    }
    return best;
}

} // namespace

DefaultLight choose_default_light(const Mesh& mesh, const Tracer& tracer, const FreeSpace& free,
                                  int up, bool rooms_too) {
    const auto is_large = [&free](const Space& space) {
        return double(space.places.size()) >= min_share_of_room * double(free.places);
    };
    double openness = 0; // of the most open space
    for (const Space& space : free.spaces)
        openness = std::max(openness, is_large(space) ? space.openness : 0);
    DefaultLight light;
    light.sky = openness > min_openness;
    for (const Space& space : free.spaces) {
        const bool is_room = rooms_too || (openness <= min_openness_of_daylight && is_large(space));
        if (!is_room || space.openness > min_openness_of_daylight)
            continue;
        const auto lamps = lamps_of_space(mesh, tracer, space, free.volume_of_place, up,
                                          max_lamps - light.lamps.size());
        light.lamps.insert(light.lamps.end(), lamps.begin(), lamps.end());
    }
    light.sky = light.sky || light.lamps.empty();
    if (light.sky)
        light.sun = sun_of(mesh, tracer, free.seen(), up);
    return light;
}

} // namespace hemilux
