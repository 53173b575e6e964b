#include "radiosity/answers/views/up_axis.h"

#include "geometry/box.h"
#include "geometry/elementary.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace hemilux {
namespace {

/// What speaks for z (above 0) or for y (below 0), in units in which 1 is a fair hint.
struct Evidence {
    double for_z;
    const char* reason; ///< words that follow "as"
};

double brightness_of(const Vec3& colour) { return colour.r + colour.g + colour.b; }

/// Returns the logarithm of a ratio, at most `limit` either way.
double hint(double of_z, double of_y, double limit) {
    if (!(of_z > 0 && of_y > 0))
        return 0;
    return std::clamp(elementary::log(of_z / of_y), -limit, limit);
}

/// Returns whether a name says that the surface lies flat, by a word or its beginning.
bool is_name_of_floor(std::string name) {
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array<std::string_view, 6> words = {"floor", "ceiling", "ground",
                                                       "roof",  "carpet",  "terrain"};
    return std::ranges::any_of(words, [&](std::string_view word) {
        const std::size_t at = name.find(word);
        return at == 0 ||
               (at != std::string::npos && !std::isalpha(static_cast<unsigned char>(name[at - 1])));
    });
}

std::vector<bool> are_names_of_floors(std::span<const std::string> names) {
    std::vector<bool> are;
    for (const std::string& name : names)
        are.push_back(is_name_of_floor(name));
    return are;
}

/// Sums over the patches of a scene, by axis.
struct Sums {
    Box box;
    Vec3 facing{1e-9};     ///< area that faces along the axis
    Vec3 net{0};           ///< area times normal: 0 of closed surfaces
    Vec3 floors{1e-9};     ///< the same of what is named as a floor
    Vec3 down{0};          ///< power that is emitted downwards
    Vec3 emitter_place{0}; ///< power times place
    Vec3 sun{0};           ///< power of far emitters times the direction to them
    Vec3 centroid{0};      ///< area times place
    double emitted = 0, far = 0;
    double area = 0;
};

void add_near(Sums& sums, const Patch& patch, const Vec3& emission, bool is_floor) {
    const Vec3 faces = patch.area * glm::abs(patch.normal);
    const double power = patch.area * brightness_of(emission);
    sums.area += patch.area;
    sums.centroid += patch.area * patch.centre;
    sums.net += patch.area * patch.normal;
    sums.facing += faces;
    if (is_floor)
        sums.floors += faces;
    sums.down += power * glm::max(-patch.normal, Vec3(0.0));
    sums.emitter_place += power * patch.centre;
    sums.emitted += power;
}

void add_far(Sums& sums, const Patch& patch, const Vec3& emission) {
    const double distance = glm::length(patch.centre);
    const double light = patch.area * brightness_of(emission) / (distance * distance);
    sums.sun += light * patch.centre / distance;
    sums.far += light;
}

/// Returns the share of a scene's breadth [-], in the narrower direction across an axis, that a box
/// of its lowest parts spans. It is 0 where the middle of the scene is not above them.
double spanned(const Sums& sums, const Box& lowest, int axis) {
    const Vec3 centre = sums.centroid / sums.area;
    const Vec3 extent = glm::max(sums.box.extent(), Vec3(1e-9));
    double share = 1;
    for (const int across : {(axis + 1) % 3, (axis + 2) % 3}) {
        if (!(lowest.low[across] <= centre[across] && centre[across] <= lowest.high[across]))
            return 0;
        share = std::min(share, lowest.extent()[across] / extent[across]);
    }
    return share;
}

/// Returns how well a scene stands on the lowest faces along an axis [-]. Corners of faces that do
/// not lie there as a whole count less: a sheet seldom stands on its edge.
double standing(const Mesh& mesh, const Sums& sums, int axis) {
    constexpr double thin = 0.003, of_corners = 0.7;
    const double end = sums.box.low[axis] + thin * sums.box.extent()[axis];
    Box faces, corners;
    for (const Patch& patch : mesh.patches()) {
        if (mesh.material(patch).is_far)
            continue;
        const Box box = box_of(patch.shape.corner);
        if (box.high[axis] <= end)
            faces.include(box);
        for (const Vec3& corner : patch.shape.corner)
            if (corner[axis] <= end)
                corners.include(corner);
    }
    return std::max(spanned(sums, faces, axis), of_corners * spanned(sums, corners, axis));
}

void add_points(Sums& sums, const Mesh& mesh) {
    for (const PointEmitter& emitter : point_emitters_of(mesh.scene())) {
        const double power = power_per_intensity(emitter) * brightness_of(emitter.intensity);
        const double local = power * mesh.frame().scale * mesh.frame().scale;
        sums.emitter_place += local * mesh.frame().to_local(emitter.position);
        sums.emitted += local;
        if (emitter.is_spot())
            sums.down += local * glm::max(-emitter.axis, Vec3(0.0));
    }
}

Sums sums_of(const Mesh& mesh) {
    Sums sums;
    const Scene& scene = mesh.scene();
    std::vector<std::string> materials;
    for (const Material& material : scene.materials)
        materials.push_back(material.name);
    const std::vector<bool> floor_material = are_names_of_floors(materials);
    const std::vector<bool> floor_group = are_names_of_floors(scene.groups);
    for (const Patch& patch : mesh.patches()) {
        const Material& material = mesh.material(patch);
        if (material.is_far) {
            add_far(sums, patch, material.emission);
            continue;
        }
        sums.box.include(box_of(patch.shape.corner));
        add_near(sums, patch, material.emission,
                 floor_material[patch.material] || floor_group[scene.facets[patch.facet].group]);
    }
    add_points(sums, mesh);
    return sums;
}

/// Returns whether the scene begins at 0 of an axis, and not to both sides of it.
bool begins_at_zero(const Mesh& mesh, const Box& box, int axis) {
    constexpr double near = 0.002;
    const double low = mesh.frame().to_world(box.low)[axis];
    return std::abs(low) < near * box.extent()[axis] / mesh.frame().scale;
}

/// Returns what speaks for z where one of three axes has by far the most of something: 0 where that
/// is x, or where two have about as much.
double hint_of_most(const Vec3& of) {
    return std::max(0.0, hint(of.z, std::max(of.x, of.y), 1)) -
           std::max(0.0, hint(of.y, std::max(of.x, of.z), 1));
}

/// Returns how much the shape of a box says: a plate may lie, or hang on a wall.
double weight_of_shape(Vec3 extent) {
    constexpr double thin = 0.25, of_plate = 0.4;
    std::sort(&extent.x, &extent.x + 3);
    return extent.x < thin * extent.y ? of_plate : 1;
}

std::array<Evidence, 9> evidence_of(const Mesh& mesh) {
    const Sums s = sums_of(mesh);
    const Vec3 extent = glm::max(s.box.extent(), Vec3(1e-9));
    const Vec3 above =
        s.emitted > 0 ? 2.0 * (s.emitter_place / s.emitted - s.box.centre()) / extent : Vec3(0.0);
    const Vec3 sun = s.far > 0 ? s.sun / s.far : Vec3(0.0);
    const double shape = weight_of_shape(extent);
    constexpr double little = 0.1; // of a breadth
    const double stands = hint(standing(mesh, s, 2) + little, standing(mesh, s, 1) + little, 1.6);
    const Vec3 net = s.net / std::max(s.area, 1e-9);
    const Vec3 down = s.down + 1e-9 * s.emitted;
    const bool zero_y = begins_at_zero(mesh, s.box, 1), zero_z = begins_at_zero(mesh, s.box, 2);
    return {{{2 * hint(s.floors.z, s.floors.y, 1), "what is named a floor faces"},
             {hint(down.z, down.y, 1), "lamps shine along"},
             {shape * hint_of_most(s.facing), "most of the area faces"},
             {1.5 * (std::max(net.z, 0.0) - std::max(net.y, 0.0)), "its open surfaces look along"},
             {0.5 * shape * hint_of_most(1.0 / extent), "the scene is least high along"},
             {1.5 * shape * stands, "the scene stands firmly along"},
             {0.7 * (double(zero_z) - double(zero_y)), "the scene begins at 0 of"},
             {0.5 * std::clamp(above.z - above.y, -1.0, 1.0), "lamps are at the high end of"},
             {sun.z - sun.y, "the sun is high along"}}};
}

/// Returns what a customary axis counts for: y is written into the standard of glTF.
double prior_of(std::optional<int> usual) {
    constexpr double rule = -2, custom = 1.5;
    return !usual ? 0 : *usual == 1 ? rule : custom;
}

} // namespace

UpGuess guess_up_axis(const Mesh& mesh, std::optional<int> usual) {
    constexpr double enough = 1;
    const auto evidence = evidence_of(mesh);
    double sum = prior_of(usual);
    for (const Evidence& one : evidence)
        sum += one.for_z;
    const bool is_z = sum > enough;
    const auto strongest = std::ranges::max_element(
        evidence, {}, [&](const Evidence& one) { return is_z ? one.for_z : -one.for_z; });
    const bool by_custom =
        usual == (is_z ? 2 : 1) && std::abs(strongest->for_z) < std::abs(prior_of(usual));
    return {is_z ? 2 : 1,
            by_custom ? "the kind of file or its camera has it so"
                      : std::string(strongest->reason) + " it",
            sum};
}

int guess_up(const Mesh& mesh, std::optional<int> usual) { return guess_up_axis(mesh, usual).axis; }

} // namespace hemilux
