#include "app/settings/lights.h"

#include "app/settings/numbers.h"
#include "geometry/numeric.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace hemilux {
namespace {

std::optional<Vec3> vector_of(std::string_view text) {
    const auto numbers = parse_numbers(text, ',');
    if (!numbers || numbers->size() != 3)
        return std::nullopt;
    return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

using Kind = LightSettings::Kind;

std::optional<Kind> kind_of(const std::string& word) {
    if (word == "disc")
        return Kind::disc;
    if (word == "rectangle")
        return Kind::rectangle;
    if (word == "point")
        return Kind::point;
    if (word == "spot")
        return Kind::spot;
    return word == "ies" ? std::optional(Kind::ies) : std::nullopt;
}

/// Returns where a light keeps the strength that the word names; nullptr for another word.
std::optional<Vec3>* strength_of(LightSettings& light, const std::string& word) {
    if (word == "watts")
        return &light.watts;
    if (word == "emission" && light.has_extent())
        return &light.emission;
    if (word == "scale" && light.kind == Kind::ies)
        return &light.scale;
    const bool has_intensity = light.kind == Kind::point || light.kind == Kind::spot;
    return word == "intensity" && has_intensity ? &light.intensity : nullptr;
}

/// Returns whether the value belongs to the word, and was read.
bool read_pair(LightSettings& light, const std::string& word, const std::string& value) {
    if (word == "at" || (word == "towards" && light.kind != Kind::point)) {
        const std::optional<Vec3> vector = vector_of(value);
        (word == "at" ? light.at : light.towards) = vector.value_or(Vec3(0.0));
        return vector.has_value();
    }
    if (word == "across" && light.kind == Kind::ies) {
        light.across = vector_of(value).value_or(Vec3(0.0));
        return light.across != Vec3(0.0);
    }
    if (std::optional<Vec3>* const strength = strength_of(light, word))
        return (*strength = parse_colour(value, non_negative)).has_value();
    if ((word == "inner" || word == "outer") && light.kind == Kind::spot) {
        const std::optional<double> angle = parse_number(value);
        (word == "inner" ? light.inner : light.outer) = angle.value_or(0);
        return angle.has_value();
    }
    if (word == "radius" && light.kind == Kind::disc) {
        light.width = light.height = 2 * parse_number(value).value_or(0);
        return true;
    }
    const auto sides = parse_numbers(value, 'x');
    if (word != "size" || light.kind != Kind::rectangle || !sides || sides->size() != 2)
        return false;
    light.width = (*sides)[0];
    light.height = (*sides)[1];
    return true;
}

/// Returns whether a light has all that its kind needs, besides a place.
bool is_complete(const LightSettings& light) {
    constexpr double widest = 90;
    const int strengths = int{light.watts.has_value()} + int{light.emission.has_value()} +
                          int{light.intensity.has_value()} + int{light.scale.has_value()};
    const bool has_size = !light.has_extent() || (light.width > 0 && light.height > 0);
    const bool has_cone = light.kind != Kind::spot ||
                          (0 <= light.inner && light.inner < light.outer && light.outer <= widest);
    const bool has_direction = light.kind == Kind::point || light.towards != Vec3(0.0);
    const bool has_strength = light.kind == Kind::ies ? strengths <= 1 : strengths == 1;
    const bool is_turned =
        light.across == Vec3(0.0) || !has_direction ||
        glm::cross(direction_of(light.across), direction_of(light.towards)) != Vec3(0.0);
    return has_strength && has_direction && is_turned && has_size && has_cone;
}

} // namespace

std::optional<LightSettings> parse_light(std::string_view text) {
    std::istringstream words{std::string(text)};
    std::string kind, word, value;
    words >> kind;
    LightSettings light;
    if (const std::optional<Kind> known = kind_of(kind))
        light.kind = *known;
    else
        return std::nullopt;
    if (light.kind == Kind::ies && !(words >> light.photometry))
        return std::nullopt;
    std::vector<std::string> given;
    while (words >> word) {
        if (!(words >> value) || std::ranges::count(given, word) > 0 ||
            !read_pair(light, word, value))
            return std::nullopt;
        given.push_back(word);
    }
    const bool is_placed = std::ranges::count(given, "at") > 0;
    return is_placed && is_complete(light) ? std::optional(light) : std::nullopt;
}

std::optional<SunSettings> parse_sun(std::string_view text) {
    const auto n = parse_numbers(text, ',');
    if (!n || (n->size() != 4 && n->size() != 6))
        return std::nullopt;
    const std::vector<double>& x = *n;
    const SunSettings sun{.direction = Vec3(x[0], x[1], x[2]),
                          .irradiance = x.size() == 4 ? Vec3(x[3]) : Vec3(x[3], x[4], x[5])};
    const bool shines = std::min({sun.irradiance.r, sun.irradiance.g, sun.irradiance.b}) >= 0;
    return sun.direction != Vec3(0.0) && shines ? std::optional(sun) : std::nullopt;
}

} // namespace hemilux
