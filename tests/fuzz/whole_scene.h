#pragma once
// What holds of every scene that a reader returns.

#include "io/files/error.h"
#include "io/scene_files/read_result.h"
#include "radiosity/light/textures/scene_textures.h"

#include <cmath>
#include <cstdlib>

namespace hemilux::fuzz {

/// Aborts where a number is not finite or an index is beyond its list.
inline void check_scene(const Scene& scene) {
    const auto require = [](bool holds) {
        if (!holds)
            std::abort();
    };
    for (const Vec3& v : scene.vertices)
        require(std::isfinite(v.x + v.y + v.z));
    require(!scene.facets.empty());
    for (const Facet& facet : scene.facets) {
        for (const std::uint32_t v : facet.vertex)
            require(v < scene.vertices.size());
        require(facet.face < scene.faces && facet.material < scene.materials.size() &&
                facet.group < scene.groups.size());
    }
    for (const auto& set : textures_of(scene).texcoords)
        require(set.size() == scene.facets.size());
}

/// Reads with a limit of 64 MB, so that an input that asks for much ends soon.
template <class Read>
void check_reading(const Read& read) {
    struct TooLarge {};
    const ReadGuard guard = [](double bytes) {
        constexpr double most = 64e6;
        if (bytes > most)
            throw TooLarge();
    };
    try {
        check_scene(read(guard).scene);
    } catch (const InputError&) {
    } catch (const TooLarge&) {
    }
}

} // namespace hemilux::fuzz
