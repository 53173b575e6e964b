#include "radiosity/answers/run/sides.h"

#include "geometry/polygon.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/light/layers/layered_mesh.h"

#include <utility>

namespace hemilux {
namespace {

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
           names_of_groups(found.groups, scene) + ": " + kinds_text(found) + ")";
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

void tell_of_sides(const Orientation& found, const Scene& scene, Sides sides, Watcher& watcher) {
    const std::string fell = percent(found.light.backs) + " of the emitted light ";
    if (found.faces > 0 && sides == Sides::automatic)
        watcher.take({Finding::Kind::note,
                      "turned " + faces_text(found, scene) +
                          ", which looked away from the light; " + fell + "fell on backs",
                      "--sides front trusts the file"});
    else if (found.faces > 0)
        watcher.take({Finding::Kind::warning,
                      faces_text(found, scene) + " look away from the light; " + fell +
                          "falls on backs, which absorb it",
                      "--sides auto turns these faces"});
    if (found.in_doubt > 0)
        watcher.take({Finding::Kind::note,
                      "note: " + doubt_text(found, scene) +
                          " may look away from the light, or be meant to; they stay as they are",
                      "--sides both lets both sides emit and reflect"});
}

} // namespace

std::string names_of_groups(const std::vector<std::uint32_t>& groups, const Scene& scene) {
    constexpr std::size_t most = 4;
    std::vector<std::string> names;
    for (const std::uint32_t g : groups)
        names.push_back(scene.groups[g]);
    return (names.size() == 1 ? "group " : "groups ") + list_names(names, most);
}

std::string doubt_text(const Orientation& found, const Scene& scene) {
    return counted(found.in_doubt, "face", "faces") + " (" +
           names_of_groups(found.groups_in_doubt, scene) + ")";
}

std::string both_sides_text(const Scene& scene) {
    const double power = emitted_power(scene);
    return power > 0 ? formatted("lamps shine to both sides: %g W, where one side emits %g W",
                                 2 * power, power)
                     : "";
}

SidedMesh divide_with_sides(Scene scene, Sides sides, const MeshOptions& options,
                            Watcher& watcher) {
    if (sides == Sides::front)
        for (Facet& facet : scene.facets)
            facet.two_sided = false;
    if (sides == Sides::both) {
        if (std::string text = both_sides_text(scene); !text.empty())
            watcher.tell(Finding::Kind::note, std::move(text));
        return {layered_mesh(std::move(scene), options), {}};
    }
    const auto divide = [&](Scene sided) {
        Mesh mesh = layered_mesh(std::move(sided), options);
        MadeTracer made = make_tracer(mesh, options.threads);
        return SidedMesh{std::move(mesh), std::move(made)};
    };
    SidedMesh sided = divide(std::move(scene));
    const Orientation found = find_orientation(sided.mesh, *sided.made.tracer);
    tell_of_sides(found, sided.mesh.scene(), sides, watcher);
    if (found.faces == 0 || sides != Sides::automatic)
        return sided;
    Scene turned = sided.mesh.scene();
    turn_faces(turned, found);
    return divide(std::move(turned));
}

} // namespace hemilux
