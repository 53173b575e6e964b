#include "radiosity/answers/picture_check/picture_check.h"

#include "radiosity/answers/picture_check/place_of_light.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/answers/views/automatic_camera.h"
#include "radiosity/answers/views/lit_patches.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

namespace hemilux {
namespace {

/// What a grid of rays through the picture meets [shares of the rays].
struct Seen {
    double surfaces = 0, far = 0; ///< the scene; suns and skies
    double black = 0;             ///< of both, what has less than a hundredth of a screen's light
    double white = 0;             ///< of surfaces, what has all channels near a screen's limit
    double lit = 0;               ///< surfaces by how lit they are
    double emitters = 0;
    std::map<std::string, double> emitters_by_group; ///< the same
};

void add_tone(Seen& seen, const glm::vec3& shown, bool is_far, double share) {
    constexpr float dark = 0.01f, bright = 0.95f;
    seen.black += luminance(shown) < dark ? share : 0;
    seen.white += !is_far && std::min({shown.r, shown.g, shown.b}) > bright ? share : 0;
}

Seen seen_in(const ShownPicture& shown, std::span<const float> lit) {
    constexpr int columns = 48, rows = 36;
    constexpr double share = 1.0 / (columns * rows);
    const Mesh& mesh = shown.mesh;
    const Image& image = shown.picture;
    const CameraRays rays(shown.camera, mesh, double(image.width) / image.height);
    Seen seen;
    for (int k = 0; k < columns * rows; ++k) {
        const int x = (2 * (k % columns) + 1) * image.width / (2 * columns);
        const int y = (2 * (k / columns) + 1) * image.height / (2 * rows);
        const auto at =
            look(mesh, shown.tracer, rays.ray((x + .5) / image.width, (y + .5) / image.height));
        if (!at)
            continue;
        const Material& material = mesh.material(at->patch);
        (material.is_far ? seen.far : seen.surfaces) += share;
        add_tone(seen, shown.display(image.at(x, y)), material.is_far, share);
        seen.lit += share * lit[at->patch];
        const double all = mean_of_channels(shown.radiosity[at->patch]);
        if (material.is_far || !(mean_of_channels(material.emission) > all / 2))
            continue;
        seen.emitters += share;
        const Scene& scene = mesh.scene();
        seen.emitters_by_group[scene.groups[scene.facets[at->hit.facet].group]] += share;
    }
    return seen;
}

std::string number(double value, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string whole_percent(double share) { return number(100 * share, "%.0f %%"); }

/// Returns the factor from the exposure of the picture to the automatic one.
double from_automatic(const ShownPicture& shown) {
    return exposure_of(shown.picture, shown.mesh, shown.tracer, shown.camera) /
           shown.display.exposure;
}

std::string exposure_text(const ShownPicture& shown, double factor) {
    return "--exposure " + number(shown.display.exposure, "%.3g") + "; the automatic one is " +
           number(factor * shown.display.exposure, "%.3g");
}

/// Returns the advice to choose another camera, where the automatic one sees the light.
std::string other_camera(const ShownPicture& shown) {
    constexpr double much = 0.1;
    const double aspect = double(shown.picture.width) / shown.picture.height;
    const AutomaticView view =
        automatic_view(shown.mesh, shown.tracer, shown.radiosity, {.aspect = aspect});
    return view.lit > much ? "; --camera auto shows what is lit" : "";
}

std::string why_black(const ShownPicture& shown, const LitPatches& lit, const Seen& seen) {
    constexpr double nothing = 0.005, hardly = 0.02, far_off = 8;
    if (seen.surfaces + seen.far < nothing)
        return "the camera sees nothing of the scene" + other_camera(shown);
    if (const double factor = from_automatic(shown); factor > far_off)
        return exposure_text(shown, factor);
    if (lit.brightest.empty())
        return "no surface reflects light";
    if (seen.lit > hardly)
        return "what is lit fills " + whole_percent(seen.lit) + " of it" + other_camera(shown);
    return text_of(place_of_light(shown.mesh, shown.tracer, shown.radiosity), shown.mesh) +
           ", and the camera sees none of it" + other_camera(shown);
}

std::string why_white(const ShownPicture& shown, const Seen& seen) {
    constexpr double most = 0.5, far_off = 1.0 / 8;
    if (seen.far > most)
        return "the sky fills " + whole_percent(seen.far) + " of it";
    if (seen.emitters > most) {
        const auto largest = std::ranges::max_element(
            seen.emitters_by_group, {}, [](const auto& group) { return group.second; });
        return "lamps fill " + whole_percent(seen.emitters) + " of it, most of them '" +
               largest->first + "'" + other_camera(shown);
    }
    if (const double factor = from_automatic(shown); factor < far_off)
        return exposure_text(shown, factor);
    return "all that it shows is equally bright";
}

/// Returns words for light that stays inside a small part of the scene.
std::string confined_text(const ShownPicture& shown) {
    constexpr double small = 0.1;
    const PlaceOfLight place = place_of_light(shown.mesh, shown.tracer, shown.radiosity);
    if (!place.enclosed || place.of_area > small)
        return "";
    return text_of(place, shown.mesh) + "; the rest of the scene is dark";
}

} // namespace

std::string picture_warning(const ShownPicture& shown) {
    constexpr double nearly_all = 0.96, something = 0.005;
    const LitPatches lit = lit_patches(shown.mesh, shown.radiosity);
    const Seen seen = seen_in(shown, lit.weight);
    const double all = seen.surfaces + seen.far;
    if (all < something || seen.black >= nearly_all * all)
        return (seen.black < all ? "the picture is nearly black: " : "the picture is black: ") +
               why_black(shown, lit, seen);
    if (seen.surfaces < something || seen.white >= nearly_all * seen.surfaces ||
        seen.emitters >= nearly_all)
        return "the picture is nearly white: " + why_white(shown, seen);
    return confined_text(shown);
}

} // namespace hemilux
