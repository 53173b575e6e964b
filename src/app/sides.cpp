#include "app/sides.h"

#include "app/names.h"
#include "app/talk.h"
#include "app/text.h"
#include "geometry/polygon.h"

namespace hemilux {

namespace {

std::string names_of_groups(const Scene& scene, const Orientation& found) {
    constexpr std::size_t most = 4;
    std::vector<std::string> names;
    for (const std::uint32_t g : found.groups)
        names.push_back(scene.groups[g]);
    return (names.size() == 1 ? "group " : "groups ") + list_names(names, most);
}

/// "1 closed surface inside out, 1 lamp facing a wall at once or nothing"
std::string kinds_text(const Orientation& found) {
    std::string text;
    const auto add = [&](std::size_t count, const std::string& one, const std::string& many) {
        if (count > 0)
            text += (text.empty() ? "" : ", ") + counted(count, one, many);
    };
    add(found.inside_out, "closed surface inside out", "closed surfaces inside out");
    add(found.from_behind, "open surface lit from behind", "open surfaces lit from behind");
    add(found.lamps, "lamp facing a wall at once or nothing",
        "lamps facing a wall at once or nothing");
    add(found.mixed, "surface whose faces disagree", "surfaces whose faces disagree");
    if (found.mixed > 0)
        text += " along " + counted(found.clashing_edges, "edge", "edges");
    return text;
}

std::string faces_text(const Orientation& found, const Scene& scene) {
    return grouped(found.faces) + " of " + counted(scene.faces, "face", "faces") + " (" +
           names_of_groups(scene, found) + ": " + kinds_text(found) + ")";
}

/// Of the fronts, all channels [W].
double emitted_power(const Scene& scene) {
    double power = 0;
    for (const Facet& facet : scene.facets) {
        Polygon shape;
        for (std::size_t i = 0; i < 4; ++i)
            shape.corner[i] = scene.vertices[facet.vertex[i]];
        const Vec3& e = scene.materials[facet.material].emission;
        if (e != Vec3(0.0))
            power += shape.area() * (e.r + e.g + e.b);
    }
    return power;
}

std::string both_sides_text(const Scene& scene) {
    const double power = emitted_power(scene);
    return formatted("lamps shine to both sides: %g W, where one side emits %g W", 2 * power,
                     power);
}

std::string line(std::string name, const std::string& text) {
    constexpr std::size_t column = 20;
    name.resize(std::max(name.size() + 2, column), ' ');
    return name + text + '\n';
}

} // namespace

void settle_sides(Scene& scene, const SceneSettings& settings, Talk talk, unsigned threads) {
    if (settings.sides == Sides::both) {
        if (emitted_power(scene) > 0)
            say(talk, Talk::normal, both_sides_text(scene));
        return;
    }
    const Orientation found = find_orientation(scene, threads);
    if (found.faces == 0)
        return;
    const std::string fell = percent(found.light.backs) + " of the emitted light ";
    if (settings.sides == Sides::automatic) {
        turn_faces(scene, found);
        say(talk, Talk::normal,
            "turned " + faces_text(found, scene) + ", which looked away from the light; " + fell +
                "fell on backs; --sides front trusts the file");
    } else
        say(talk, Talk::normal,
            "warning: " + faces_text(found, scene) + " look away from the light; " + fell +
                "falls on backs, which absorb it; --sides auto turns these faces");
}

std::string describe(const Orientation& found, const Scene& scene, Sides sides) {
    std::string text;
    const auto add = [&](const std::string& name, std::size_t count, const std::string& meaning) {
        if (count > 0)
            text += line(name, std::to_string(count) + " (" + meaning + ")");
    };
    if (found.faces > 0)
        text += line("looking away",
                     std::to_string(found.faces) + " of " + counted(scene.faces, "face", "faces") +
                         " (" + names_of_groups(scene, found) + "); " +
                         (sides == Sides::automatic ? "solve turns them, --sides front does not"
                                                    : "--sides auto turns them"));
    add("inside out", found.inside_out, "closed surfaces whose backs are lit");
    add("lit from behind", found.from_behind, "open surfaces whose backs are lit");
    add("lamps turned away", found.lamps, "they face a wall at once, or nothing");
    add("faces disagree", found.mixed, "surfaces some of whose faces look away");
    add("clashing edges", found.clashing_edges,
        "edges that two faces run along in the same direction, so one of them looks away");
    add("without sides", found.one_sided, "surfaces such as a Moebius strip; left as they are");
    if (found.light.backs + found.light.escaped > 0)
        text += line("light lost", percent(found.light.backs) +
                                       " of what is emitted falls on "
                                       "backs, " +
                                       percent(found.light.escaped) +
                                       " leaves the scene (with the faces as in the file)");
    return text;
}

std::string describe_both_sides(const Scene& scene) {
    return emitted_power(scene) > 0 ? line("both sides", both_sides_text(scene)) : "";
}

} // namespace hemilux
