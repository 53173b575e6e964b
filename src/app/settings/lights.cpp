#include "app/settings/lights.h"

#include "app/settings/numbers.h"

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

/// Returns whether the value belongs to the word, and was read.
bool read_pair(LightSettings& light, const std::string& word, const std::string& value) {
    if (word == "at" || word == "towards") {
        const std::optional<Vec3> vector = vector_of(value);
        (word == "at" ? light.at : light.towards) = vector.value_or(Vec3(0.0));
        return vector.has_value();
    }
    if (word == "watts" || word == "emission")
        return ((word == "watts" ? light.watts : light.emission) =
                    parse_colour(value, non_negative))
            .has_value();
    if (word == "radius" && light.is_disc) {
        light.width = light.height = 2 * parse_number(value).value_or(0);
        return true;
    }
    const auto sides = parse_numbers(value, 'x');
    if (word != "size" || light.is_disc || !sides || sides->size() != 2)
        return false;
    light.width = (*sides)[0];
    light.height = (*sides)[1];
    return true;
}

} // namespace

std::optional<LightSettings> parse_light(std::string_view text) {
    std::istringstream words{std::string(text)};
    std::string kind, word, value;
    words >> kind;
    LightSettings light;
    light.is_disc = kind == "disc";
    if (!light.is_disc && kind != "rectangle")
        return std::nullopt;
    std::vector<std::string> given;
    while (words >> word) {
        if (!(words >> value) || std::ranges::count(given, word) > 0 ||
            !read_pair(light, word, value))
            return std::nullopt;
        given.push_back(word);
    }
    const bool is_placed = std::ranges::count(given, "at") > 0 && light.towards != Vec3(0.0);
    const bool has_size = light.width > 0 && light.height > 0;
    if (!is_placed || !has_size || light.watts.has_value() == light.emission.has_value())
        return std::nullopt;
    return light;
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
