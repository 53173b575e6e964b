#include "app/loading/sides.h"

#include "app/loading/load.h"
#include "app/terminal/log.h"
#include "geometry/polygon.h"
#include "io/files/text_words.h"
#include "io/scene_files/inspect.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/point_emitter.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

namespace {

std::string names_of(const std::vector<std::uint32_t>& groups, const Scene& scene) {
    constexpr std::size_t most = 4;
    std::vector<std::string> names;
    for (const std::uint32_t g : groups)
        names.push_back(scene.groups[g]);
    return (names.size() == 1 ? "group " : "groups ") + list_names(names, most);
}

/// Returns "1 closed surface inside out, 1 lamp facing a wall at once or nothing".
std::string kinds_text(const Orientation& found) {
    std::string text;
    const auto add = [&](std::size_t count, const std::string& one, const std::string& many) {
        if (count > 0)
            text += (text.empty() ? "" : ", ") + counted(count, one, many);
    };
    add(found.inside_out, "closed surface inside out", "closed surfaces inside out");
    add(found.from_behind, "open surface lit from behind", "open surfaces lit from behind");
    add(found.emitters, "lamp facing a wall at once or nothing",
        "lamps facing a wall at once or nothing");
    add(found.mixed, "surface whose faces disagree", "surfaces whose faces disagree");
    if (found.mixed > 0)
        text += " along " + counted(found.clashing_edges, "edge", "edges");
    return text;
}

std::string faces_text(const Orientation& found, const Scene& scene) {
    return grouped(found.faces) + " of " + counted(scene.faces, "face", "faces") + " (" +
           names_of(found.groups, scene) + ": " + kinds_text(found) + ")";
}

/// Returns the power that the fronts emit, over all channels [W].
double emitted_power(const Scene& scene) {
    double power = 0;
    for (const Facet& facet : scene.facets) {
        const Vec3& e = scene.materials[facet.material].emission;
        if (e != Vec3(0.0))
            power += polygon_of(scene.vertices, facet.vertex).area() * (e.r + e.g + e.b);
    }
    return power;
}

/// Returns "3 faces (group shade)" for those that stay as they are.
std::string doubt_text(const Orientation& found, const Scene& scene) {
    return counted(found.in_doubt, "face", "faces") + " (" +
           names_of(found.groups_in_doubt, scene) + ")";
}

void log_sides(const Orientation& found, const Scene& scene, Sides sides, Verbosity verbosity) {
    const std::string fell = percent(found.light.backs) + " of the emitted light ";
    if (found.faces > 0 && sides == Sides::automatic)
        log_line(verbosity, Verbosity::normal,
                 "turned " + faces_text(found, scene) + ", which looked away from the light; " +
                     fell + "fell on backs; --sides front trusts the file");
    else if (found.faces > 0)
        log_line(verbosity, Verbosity::normal,
                 "warning: " + faces_text(found, scene) + " look away from the light; " + fell +
                     "falls on backs, which absorb it; --sides auto turns these faces");
    if (found.in_doubt > 0)
        log_line(
            verbosity, Verbosity::normal,
            "note: " + doubt_text(found, scene) +
                " may look away from the light, or be meant to; they stay as they are; --sides "
                "both lets both sides emit and reflect");
}

std::string both_sides_text(const Scene& scene) {
    const double power = emitted_power(scene);
    return formatted("lamps shine to both sides: %g W, where one side emits %g W", 2 * power,
                     power);
}

/// Returns the power that is reflected, relative to what is emitted [-]; both over all channels.
double reflected_share(const Mesh& mesh, std::span<const Vec3> radiosity) {
    const Vec3 of_points = power_of_point_emitters(mesh.scene());
    double reflected = 0;
    double emitted = glm::dot(of_points, Vec3(1.0)) / mesh.frame().area_to_world(1.0);
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 power = mesh.patches()[i].area * mesh.material(i).emission;
        emitted += glm::dot(power, Vec3(1.0));
        reflected +=
            mesh.patches()[i].area * glm::dot(radiosity[i], Vec3(1.0)) - glm::dot(power, Vec3(1.0));
    }
    return emitted > 0 ? reflected / emitted : 0;
}

bool anything_reflects(const Mesh& mesh) {
    return std::ranges::any_of(mesh.scene().facets, [&](const Facet& facet) {
        return mesh.scene().materials[facet.material].reflectance != Vec3(0.0);
    });
}

} // namespace

SidedMesh divide_with_sides(Scene scene, const SceneSettings& settings, const SolveOptions& options,
                            Verbosity verbosity) {
    if (settings.sides == Sides::front)
        for (Facet& facet : scene.facets)
            facet.two_sided = false;
    if (settings.sides == Sides::both) {
        if (emitted_power(scene) > 0)
            log_line(verbosity, Verbosity::normal, both_sides_text(scene));
        return {divide_scene(std::move(scene), settings, options.threads), {}};
    }
    const auto divide = [&](Scene sided) {
        Mesh mesh = divide_scene(std::move(sided), settings, options.threads);
        MadeTracer made = make_tracer(mesh, options.threads);
        return SidedMesh{std::move(mesh), std::move(made)};
    };
    SidedMesh sided = divide(std::move(scene));
    const Orientation found = find_orientation(sided.mesh, *sided.made.tracer);
    log_sides(found, sided.mesh.scene(), settings.sides, verbosity);
    if (found.faces == 0 || settings.sides != Sides::automatic)
        return sided;
    Scene turned = sided.mesh.scene();
    turn_faces(turned, found);
    return divide(std::move(turned));
}

std::string describe(const Orientation& found, const Scene& scene, Sides sides) {
    std::string text;
    const auto add = [&](const std::string& name, std::size_t count, const std::string& one,
                         const std::string& many) {
        if (count > 0)
            text += info_line(name, std::to_string(count) + " (" + (count == 1 ? one : many) + ")");
    };
    if (found.faces > 0)
        text +=
            info_line("looking away",
                      std::to_string(found.faces) + " of " + counted(scene.faces, "face", "faces") +
                          " (" + names_of(found.groups, scene) + "); " +
                          (sides == Sides::automatic ? "solve turns them, --sides front does not"
                                                     : "--sides auto turns them"));
    if (found.in_doubt > 0)
        text += info_line("in doubt", doubt_text(found, scene) +
                                          "; much light falls on their backs, maybe on purpose");
    add("inside out", found.inside_out, "closed surface whose back is lit",
        "closed surfaces whose backs are lit");
    add("lit from behind", found.from_behind, "open surface whose back is lit",
        "open surfaces whose backs are lit");
    add("lamps turned away", found.emitters, "it faces a wall at once, or nothing",
        "they face a wall at once, or nothing");
    add("faces disagree", found.mixed, "surface some of whose faces look away",
        "surfaces some of whose faces look away");
    add("clashing edges", found.clashing_edges,
        "edge that two faces run along in the same direction, so one of them looks away",
        "edges that two faces run along in the same direction, so one of them looks away");
    add("without sides", found.one_sided, "surface such as a Moebius strip; left as it is",
        "surfaces such as a Moebius strip; left as they are");
    if (found.light.backs + found.light.escaped > 0)
        text += info_line("light lost", percent(found.light.backs) +
                                            " of what is emitted falls on "
                                            "backs, " +
                                            percent(found.light.escaped) +
                                            " escapes (with the faces as in the file)");
    return text;
}

std::string describe_both_sides(const Scene& scene) {
    return emitted_power(scene) > 0 ? info_line("both sides", both_sides_text(scene)) : "";
}

LightShares as_in_ledger(LightShares light, const EnergyBalance& energy) {
    const auto sum = [](const Vec3& power) { return power.r + power.g + power.b; };
    const double emitted = sum(energy.emitted), lost = light.backs + light.escaped;
    if (!(emitted > 0))
        return light;
    const double escaped = std::clamp(sum(energy.escaped) / emitted, 0.0, 1.0);
    constexpr double by_chance = .05; // three times the standard error of the paths
    const bool agrees = std::abs(light.escaped - escaped) < by_chance;
    return {agrees ? light.backs : std::max(lost - escaped, 0.0), escaped};
}

std::string lost_light_text(const Mesh& mesh, std::span<const Vec3> radiosity,
                            const LightShares& light, Sides sides) {
    constexpr double nearly_all = 0.9, well_lit = 0.5, hardly = 0.1;
    const double reflected = reflected_share(mesh, radiosity);
    const bool lit = reflected > 0;
    if (lit && (light.backs + light.escaped <= nearly_all || reflected > well_lit))
        return "";
    if (!lit && !anything_reflects(mesh))
        return "nothing is lit: all reflectances are 0; --reflectance 'MATERIAL=R,G,B' changes "
               "them";
    std::string text = (!lit                 ? "nothing is lit: "
                        : reflected < hardly ? "hardly anything is lit: "
                                             : "much light is lost: ") +
                       percent(light.backs) + " of the emitted light fell on backs of faces, " +
                       percent(light.escaped) + " escaped; ";
    if (light.backs < light.escaped)
        return text + "turn the lamp to the scene or move it, or try --sides both";
    return text + (sides == Sides::front ? "--sides auto turns faces that look away, --sides both "
                                           "lets both sides emit and reflect"
                                         : "--sides both lets both sides emit and reflect");
}

} // namespace hemilux
