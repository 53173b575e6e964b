#pragma once
// Where the light of a scene stays, for the words about pictures that show none of it.

#include "bvh/tracer.h"
#include "geometry/box.h"

#include <string>
#include <vector>

namespace hemilux {

class Mesh;

/// The part of a scene from which nearly all light is reflected.
struct PlaceOfLight {
    double of_light = 0;             ///< share of the reflected power in `groups` [-]
    std::vector<std::string> groups; ///< names; those that reflect most come first
    double of_area = 0;    ///< share of the near surface that has 99 % of the reflected power [-]
    bool enclosed = false; ///< whether nearly all that is reflected there arrives there again
    Box box;               ///< box of that surface [m]
};

/// `radiosity` [W/m2] has one value per patch. The result is empty where nothing is reflected.
[[nodiscard]] PlaceOfLight place_of_light(const Mesh& mesh, const Tracer& tracer,
                                          std::span<const Vec3> radiosity);

/// Returns words such as "99 % of the light stays inside 'case', 0.4 wide in a scene of 8".
[[nodiscard]] std::string text_of(const PlaceOfLight& place, const Mesh& mesh);

} // namespace hemilux
