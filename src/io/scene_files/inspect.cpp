#include "io/scene_files/inspect.h"

#include "geometry/polygon.h"
#include "io/files/text_words.h"
#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/lamps/emitter_shapes.h"
#include "radiosity/light/layers/coplanar_layers.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/check_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hemilux {
namespace {

std::string text_of(double x) {
    constexpr int digits = 6;
    char buffer[32];
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits);
    return {buffer, end.ptr};
}
std::string text_of(std::size_t n) { return std::to_string(n); }
std::string text_of(const Vec3& v) {
    return text_of(v.x) + ' ' + text_of(v.y) + ' ' + text_of(v.z);
}

std::string counted(std::size_t n, const char* one, const char* many) {
    return text_of(n) + ' ' + (n == 1 ? one : many);
}

/// Adds a line only where there is something to doubt.
void add_doubt(std::string& text, const std::string& name, std::size_t count,
               const std::string& noun, const std::string& meaning) {
    if (count > 0)
        text += info_line(name,
                          text_of(count) + " (" + noun + (count == 1 ? " " : "s ") + meaning + ")");
}

bool emits(const Vec3& e) { return e.x > 0 || e.y > 0 || e.z > 0; }

/// Areas are computed in units in which the scene has a size of about 1, so that no square
/// vanishes or overflows.
void sum_areas(const Scene& scene, SceneInfo& info) {
    std::vector<EmitterInfo> of_material(scene.materials.size());
    const Vec3 extent = info.bounds.extent();
    int exponent = 0;
    std::frexp(std::max({extent.x, extent.y, extent.z}), &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    for (const Facet& facet : scene.facets) {
        Polygon shape;
        for (std::size_t i = 0; i < 4; ++i)
            shape.corner[i] = (scene.vertices[facet.vertex[i]] - info.bounds.low) * scale;
        const double area = std::ldexp(shape.area(), 2 * exponent);
        info.total_area += area;
        const Material& material = scene.materials[facet.material];
        if (!emits(material.emission))
            continue;
        const Vec3 power = area * (facet.two_sided ? 2.0 : 1.0) * material.emission;
        info.emitted_power += power;
        EmitterInfo& emitter = of_material[facet.material];
        emitter.name = material.name;
        emitter.emission = material.emission;
        emitter.power += power;
        emitter.both_sides |= facet.two_sided;
    }
    for (EmitterInfo& emitter : of_material)
        if (emits(emitter.emission))
            info.emitters.push_back(std::move(emitter));
}

/// Finds covered facets in the way that Mesh does.
void find_covered(Scene scene, SceneInfo& info) {
    const std::vector<Vec3> vertices = LocalFrame::of(scene).to_local(scene.vertices);
    unite_near_twins(scene, vertices);
    const CoplanarLayers layers = find_coplanar_layers(scene, vertices);
    info.covered_facets = layers.covered;
    info.all_compared = layers.complete;
}

/// Returns a colour as one number where its channels are alike.
std::string text_of_colour(const Vec3& v) {
    return v.x == v.y && v.y == v.z ? text_of(v.x) : text_of(v);
}

/// Returns a line for each of the first of a list, with the name before the first one.
template <class Item, class TextOf>
std::string describe_list(const std::string& name, const std::vector<Item>& items,
                          const TextOf& text_of_item) {
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t k = 0; k < std::min(items.size(), most); ++k)
        text += info_line(k == 0 ? name : "", text_of_item(items[k]));
    if (items.size() > most)
        text += info_line("", "and " + std::to_string(items.size() - most) + " more");
    return text;
}

std::string watts_of(const Vec3& power) {
    return text_of(power.x + power.y + power.z) + " W in all channels";
}

std::string describe_emitters(const std::vector<EmitterInfo>& emitters) {
    return describe_list("emitting materials", emitters, [](const EmitterInfo& emitter) {
        return emitter.name + ": " + text_of_colour(emitter.emission) + " W/m2, " +
               watts_of(emitter.power) + (emitter.both_sides ? ", to both sides" : "");
    });
}

std::string describe_points(const std::vector<PointInfo>& points) {
    return describe_list("without extent", points, [](const PointInfo& point) {
        return point.name + ": a " + point.kind + ", " + text_of_colour(point.intensity) +
               " W/sr, " + watts_of(point.power);
    });
}

/// Describes the materials that let light through.
std::string describe_glass(const std::vector<GlassInfo>& all) {
    return describe_list("glass", all, [](const GlassInfo& glass) {
        return glass.name + ": lets " + text_of_colour(glass.transmittance) +
               " of the light through" + (glass.open ? "" : ", but is opaque here");
    });
}

/// Returns the faces, and the triangles and quads that they are made into.
std::string faces_text(const SceneInfo& info) {
    std::string shapes;
    if (info.triangles > 0)
        shapes = counted(info.triangles, "triangle", "triangles");
    if (info.quads > 0)
        shapes += (shapes.empty() ? "" : " and ") + counted(info.quads, "quad", "quads");
    const std::string faces = text_of(info.faces);
    return shapes.empty() ? faces : faces + " (" + shapes + ")";
}

/// Returns the power that all lights emit, or what to do where there are none.
std::string describe_power(const SceneInfo& info) {
    if (info.emitters.empty() && info.points.empty())
        return info_line("light", "none: nothing emits light. `hemilux MODEL` lights it by itself; "
                                  "solve and bake need --sky 1, a --sun, a --light or --emission "
                                  "'MATERIAL=R,G,B'");
    return info_line("emitted power", text_of(info.emitted_power) + " W (red, green, blue)");
}

} // namespace

SceneInfo inspect(const ReadResult& read) {
    const Scene& scene = read.scene;
    SceneInfo info;
    info.faces = scene.faces;
    info.facets = scene.facets.size();
    info.triangles = static_cast<std::size_t>(
        std::count_if(scene.facets.begin(), scene.facets.end(),
                      [](const Facet& facet) { return facet.is_triangle(); }));
    info.quads = info.facets - info.triangles;
    info.vertices = scene.vertices.size();
    info.materials = scene.materials.size();
    info.groups = scene.groups.size();
    info.bounds = bounds_of(scene);
    sum_areas(scene, info);
    for (const PointEmitter& emitter : point_emitters_of(scene)) {
        const Vec3 power = power_per_intensity(emitter) * emitter.intensity;
        info.points.push_back({emitter.name,
                               emitter.table       ? "measured lamp"
                               : emitter.is_spot() ? "spot"
                                                   : "point",
                               relative_intensity(emitter, emitter.axis) * emitter.intensity,
                               power});
        info.emitted_power += power;
    }
    for (const GlassMaterial& glass : read.glass)
        info.glass.push_back(
            {scene.materials[glass.material].name, glass.transmittance, glass.open});
    const EdgeCounts edges = count_edges(scene);
    info.open_edges = edges.open;
    info.nonmanifold_edges = edges.nonmanifold;
    find_covered(scene, info);
    info.degenerate_faces = read.degenerate_faces;
    info.nonplanar_faces = read.nonplanar_faces;
    info.concave_faces = read.concave_faces;
    info.bad_reflectances = find_bad_reflectances(read);
    return info;
}

std::vector<std::string> find_bad_reflectances(const ReadResult& read) {
    const std::vector<bool> used = materials_in_use(read.scene);
    std::vector<std::string> messages;
    for (std::size_t m = 0; m < used.size(); ++m) {
        const Material& material = read.scene.materials[m];
        if (!used[m] || is_reflectance(material.reflectance))
            continue;
        const bool has_source = m < read.material_source.size() && !read.material_source[m].empty();
        messages.push_back((has_source ? read.material_source[m] + ": " : "") + "material \"" +
                           material.name + "\" has reflectance " + text_of(material.reflectance) +
                           "; expected values from 0 to 1");
    }
    return messages;
}

std::string info_line(std::string name, const std::string& value) {
    name.resize(std::max(name.size() + 2, info_value_column), ' ');
    return name + value + '\n';
}

std::string describe(const SceneInfo& info) {
    std::string text;
    text += info_line("faces", faces_text(info));
    text += info_line("vertices", text_of(info.vertices));
    text += info_line("materials", text_of(info.materials));
    text += info_line("groups", text_of(info.groups));
    text += info_line("lowest corner", text_of(info.bounds.low));
    text += info_line("highest corner", text_of(info.bounds.high));
    text += info_line("size", text_of(info.bounds.extent()) + " (taken as metres)");
    text += info_line("total area", text_of(info.total_area));
    text += describe_power(info);
    text += describe_emitters(info.emitters);
    text += describe_points(info.points);
    text += describe_glass(info.glass);
    add_doubt(text, "without area", info.degenerate_faces, "face", "left out");
    add_doubt(text, "not planar", info.nonplanar_faces, "face", "divided into triangles");
    add_doubt(text, "concave", info.concave_faces, "face", "divided into triangles");
    add_doubt(text, "open edges", info.open_edges, "edge",
              "of only one face: the end of a surface, or a gap through which light may leak");
    add_doubt(text, "shared edges", info.nonmanifold_edges, "edge", "of more than two faces");
    add_doubt(text, "covered", info.covered_facets, "face",
              "in the place of another that faces the same way, wholly or in part; one of "
              "them is seen");
    if (!info.all_compared)
        text += info_line("covered",
                          "perhaps more: too many faces lie over each other to compare them all");
    for (const std::string& message : info.bad_reflectances)
        text += info_line("bad reflectance", message);
    return text;
}

std::string describe(std::span<const LeftOut> left_out) {
    std::string text;
    for (const LeftOut& item : left_out)
        text += info_line(text.empty() ? "solve leaves out" : "", item.what + ": " + item.why);
    return text;
}

} // namespace hemilux
