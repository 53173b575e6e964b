#include "app/loading/default_light.h"

#include "app/loading/lights.h"
#include "app/loading/load.h"
#include "geometry/elementary.h"
#include "io/scene_files/inspect.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/views/automatic_camera.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/light/rooms/default_light.h"
#include "radiosity/light/rooms/reached_places.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>
#include <vector>

namespace hemilux {
namespace {

/// Returns the places that a camera shows, which looks through backs.
std::vector<SeenPlace> places_of_picture(const Mesh& mesh, const Tracer& tracer,
                                         const Camera& camera, PixelSize size) {
    constexpr int columns = 32, rows = 24;
    std::vector<SeenPlace> places;
    if (mesh.frame().to_local(camera.eye) == mesh.frame().to_local(camera.target))
        return places; // which is refused later
    const CameraRays view(camera, mesh, double(size.width) / size.height);
    for (int k = 0; k < columns * rows; ++k) {
        const Ray ray = view.ray((k % columns + 0.5) / columns, (k / columns + 0.5) / rows);
        const auto visible = look(mesh, tracer, ray);
        if (!visible || mesh.material(visible->patch).is_far)
            continue;
        const Hit& hit = visible->hit;
        places.push_back({ray.origin + hit.t * ray.direction,
                          mesh.whole_side(hit.facet, !hit.front).normal, hit.facet});
    }
    return places;
}

/// Returns a scene with the sides that were asked for; none is turned.
Mesh mesh_of(Scene scene, Sides sides) {
    for (Facet& facet : scene.facets)
        facet.two_sided = facet.two_sided && sides != Sides::front;
    return Mesh(std::move(scene), {.two_sided = sides == Sides::both});
}

/// Returns whether light reaches what can be looked at.
bool is_lit(const Mesh& mesh, const Tracer& tracer, Sides sides, const ViewSettings& view,
            const std::optional<Camera>& camera) {
    constexpr double min_of_picture = 0.01, min_of_spaces = 0.1;
    if (camera) {
        const auto places = places_of_picture(mesh, tracer, *camera, view.size);
        if (!places.empty())
            return share_reached_by_light(mesh, tracer, places) >= min_of_picture;
    }
    const auto spaces_are_lit = [&tracer](const Mesh& sided) {
        const FreeSpace free = find_free_space(sided, tracer, Around::always);
        return share_of_lit_spaces(sided, tracer, free) >= min_of_spaces;
    };
    // Which sides look away from the light is found later, so any side may be lit.
    return spaces_are_lit(sides == Sides::front ? mesh : mesh_of(mesh.scene(), Sides::both));
}

/// Returns a coordinate to a hundredth of `unit`.
std::string coordinate_text(double x, double unit) {
    constexpr int most = 15;
    constexpr double smallest = 1e-12, largest = 1e12; // beyond, powers of ten are easier to read
    if (unit < smallest || unit > largest)
        return formatted("%.12g", x);
    const int decimals = std::clamp(
        2 - static_cast<int>(std::floor(elementary::log(unit) / std::numbers::ln10)), 0, most);
    return rounded_text(x, decimals);
}

/// Returns a number above 0 to two digits.
std::string number_text(double x) {
    const double rounded = std::strtod(formatted("%.2g", x).c_str(), nullptr);
    return coordinate_text(rounded, rounded);
}

std::string text_of(const Vec3& v, double unit) {
    return coordinate_text(v.x, unit) + "," + coordinate_text(v.y, unit) + "," +
           coordinate_text(v.z, unit);
}

/// Returns a lamp as --light takes it. What it lights gets about 1 W/m2.
std::string lamp_text(const RoomLamp& lamp, const LocalFrame& frame, int up) {
    Vec3 down(0.0);
    down[up] = -1;
    const double radius = lamp.radius / frame.scale;
    return "disc at " + text_of(frame.to_world(lamp.centre), radius) + " towards " +
           text_of(down, 1) + " radius " + number_text(radius) + " watts " +
           number_text(frame.area_to_world(lamp.area));
}

/// What is known of a scene whose light is chosen.
struct Dark {
    const Scene& read; ///< without lights of options
    const Mesh& mesh;
    const Tracer& tracer;
    const ViewSettings& view;
    std::optional<Camera> camera;
    int up;
};

void add(PutIn& to, const std::string& option) {
    to.options += (to.options.empty() ? "" : " ") + option;
}

/// Adds a sky of 1 W/m2 and a sun of 3.
void add_daylight(PutIn& to, SceneSettings& settings, const Vec3& direction) {
    if (!settings.sky) {
        settings.sky = Vec3(1.0);
        add(to, "--sky 1");
    }
    const std::string sun = text_of(direction, 1) + ",3";
    settings.suns.push_back(parse_sun(sun).value());
    add(to, "--sun=" + sun); // a number below 0 is no option then
}

void add_lamp(PutIn& to, SceneSettings& settings, const std::string& text) {
    if (const std::optional<LightSettings> light = parse_light(text)) {
        settings.lights.push_back(*light);
        add(to, "--light '" + text + "'");
    }
}

/// Adds a chosen light to the settings and to what is said of it.
void add(PutIn& to, SceneSettings& settings, const Dark& dark, const DefaultLight& light) {
    for (const RoomLamp& lamp : light.lamps)
        add_lamp(to, settings, lamp_text(lamp, dark.mesh.frame(), dark.up));
    if (light.sky)
        add_daylight(to, settings, light.sun);
}

/// Returns whether the camera sees next to nothing by the light that was put in.
bool stays_dark(const Dark& dark, const SceneSettings& settings) {
    if (!dark.camera)
        return false;
    Scene scene = dark.read;
    add_lights(scene, settings);
    const Mesh mesh = mesh_of(std::move(scene), settings.sides);
    const MadeTracer made = make_tracer(mesh);
    return !is_lit(mesh, *made.tracer, settings.sides, dark.view, dark.camera);
}

} // namespace

std::optional<PutIn> put_in_light(const ReadResult& read, SceneSettings& settings,
                                  const ViewSettings& view) {
    if (read.scene.facets.empty() || !find_bad_reflectances(read).empty())
        return std::nullopt; // which is refused later
    Scene scene = read.scene;
    add_lights(scene, settings);
    const bool has_light = emits(scene);
    const Mesh mesh = mesh_of(std::move(scene), settings.sides);
    const MadeTracer made = make_tracer(mesh);
    const FileView file = view_of_file(settings.path, read);
    const std::optional<Camera> camera =
        view.camera || !view.uses_camera_of_scene ? view.camera : file.camera;
    if (has_light && is_lit(mesh, *made.tracer, settings.sides, view, camera))
        return std::nullopt;
    const int up = view.up ? *view.up : guess_up(mesh, file.usual_up);
    const Dark dark{read.scene, mesh, *made.tracer, view, camera, up};
    const FreeSpace free = find_free_space(mesh, *made.tracer);
    const auto put_in = [&](SceneSettings& to, bool rooms_too) {
        PutIn added{.why = !has_light ? "nothing emits light"
                           : camera   ? "hardly any light reaches what the camera shows"
                                      : "hardly any light reaches where one can look",
                    .options = {}};
        add(added, to, dark, choose_default_light(mesh, *made.tracer, free, up, rooms_too));
        return added;
    };
    SceneSettings lit = settings;
    PutIn added = put_in(lit, false);
    if (stays_dark(dark, lit)) {
        lit = settings;
        added = put_in(lit, true);
    }
    settings = std::move(lit);
    return added;
}

} // namespace hemilux
