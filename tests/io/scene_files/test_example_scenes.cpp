// The example scenes keep what their README promises: numbers of patches, closed surfaces that face
// the air, nothing that overlaps, groups of small detail.

#include "geometry/box.h"
#include "io/scene_files/obj.h"
#include "support/catch.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

using namespace hemilux;

namespace {

struct Promise {
    const char* name;
    std::size_t patches;
    std::size_t shells;      ///< closed surfaces with air inside
    std::size_t open_sheets; ///< surfaces with a border
    bool detail;
};

const std::vector<Promise> promises{
    {"cornell_box", 1005, 0, 1, true},    {"room_1002", 1002, 1, 0, true},
    {"office_3576", 3576, 1, 0, true},    {"wall_before_crowd", 1462, 1, 0, true},
    {"open_scene", 856, 0, 1, true},      {"furnace_box", 150, 1, 0, false},
    {"furnace_lshape", 150, 1, 0, false}, {"cube_96", 96, 1, 0, false},
    {"cube_6", 6, 1, 0, false},           {"building_6", 6068, 1, 0, false},
};

ReadResult read(const std::string& name) {
    return read_obj(std::string(HEMILUX_SOURCE_DIR) + "/examples/scenes/" + name + ".obj");
}

std::vector<Vec3> corners(const Scene& scene, const Facet& facet) {
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < (facet.is_triangle() ? 3u : 4u); ++i)
        result.push_back(scene.vertices[facet.vertex[i]]);
    return result;
}

Vec3 area_vector(const std::vector<Vec3>& c) {
    return 0.5 * glm::cross(c[2] - c[0], c.back() - c[1]);
}

/// Facets that hang together by shared vertices.
struct Part {
    std::vector<std::uint32_t> facets;
    std::vector<Vec3> points, axes; ///< axes: distinct normals and edge directions, normals first
    std::size_t normals = 0;
    Box bounds;
    bool closed = true; ///< each edge once in each direction
    double volume = 0;  ///< > 0: the air is outside
};

void add_axis(std::vector<Vec3>& axes, std::size_t from, const Vec3& axis) {
    const Vec3 unit = glm::normalize(axis);
    for (std::size_t i = from; i < axes.size(); ++i)
        if (std::abs(glm::dot(axes[i], unit)) > 1 - 1e-9)
            return;
    axes.push_back(unit);
}

void measure(const Scene& scene, Part& part) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const std::uint32_t f : part.facets) {
        const Facet& facet = scene.facets[f];
        const std::vector<Vec3> c = corners(scene, facet);
        for (std::size_t i = 0; i < c.size(); ++i) {
            ++edges[{facet.vertex[i], facet.vertex[(i + 1) % c.size()]}];
            part.bounds.include(c[i]);
            part.points.push_back(c[i]);
        }
        part.volume += glm::dot(c[0], area_vector(c)) / 3;
        add_axis(part.axes, 0, area_vector(c));
    }
    part.normals = part.axes.size();
    for (const std::uint32_t f : part.facets) {
        const std::vector<Vec3> c = corners(scene, scene.facets[f]);
        for (std::size_t i = 0; i < c.size(); ++i)
            add_axis(part.axes, part.normals, c[(i + 1) % c.size()] - c[i]);
    }
    for (const auto& [edge, count] : edges) {
        const auto reverse = edges.find({edge.second, edge.first});
        part.closed = part.closed && count == 1 && reverse != edges.end() && reverse->second == 1;
    }
}

std::vector<Part> find_parts(const Scene& scene) {
    std::vector<std::uint32_t> parent(scene.vertices.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const Facet& facet : scene.facets)
        for (const std::uint32_t v : facet.vertex)
            parent[root(v)] = root(facet.vertex[0]);
    std::map<std::uint32_t, Part> by_root;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        by_root[root(scene.facets[f].vertex[0])].facets.push_back(f);
    std::vector<Part> parts;
    for (auto& [vertex, part] : by_root) {
        measure(scene, part);
        parts.push_back(std::move(part));
    }
    return parts;
}

/// The distance by which the axis separates the two sets; negative where they overlap.
double separation(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Vec3& axis) {
    const auto along = [&](const Vec3& p, const Vec3& q) {
        return glm::dot(p, axis) < glm::dot(q, axis);
    };
    const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end(), along);
    const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end(), along);
    return std::max(glm::dot(*b_low - *a_high, axis), glm::dot(*a_low - *b_high, axis));
}

/// The gap between two convex parts: separating axes are normals and products of edges.
double gap_between(const Part& a, const Part& b) {
    double gap = -1;
    for (const Part* part : {&a, &b})
        for (std::size_t i = 0; i < part->normals; ++i)
            gap = std::max(gap, separation(a.points, b.points, part->axes[i]));
    for (std::size_t i = a.normals; i < a.axes.size() && gap <= 0; ++i)
        for (std::size_t j = b.normals; j < b.axes.size(); ++j) {
            const Vec3 axis = glm::cross(a.axes[i], b.axes[j]);
            if (glm::length(axis) > 1e-6)
                gap = std::max(gap, separation(a.points, b.points, glm::normalize(axis)));
        }
    return gap;
}

bool boxes_apart(const Box& a, const Box& b, double margin) {
    return glm::any(glm::greaterThan(a.low, b.high + margin)) ||
           glm::any(glm::greaterThan(b.low, a.high + margin));
}

/// Whether two polygons lie in one plane and share area.
bool overlap_in_plane(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    const double tolerance = 1e-6;
    const Vec3 n = glm::normalize(area_vector(a));
    if (std::abs(glm::dot(n, glm::normalize(area_vector(b)))) < 1 - tolerance ||
        std::abs(glm::dot(n, b[0] - a[0])) > tolerance)
        return false;
    for (const auto* polygon : {&a, &b})
        for (std::size_t i = 0; i < polygon->size(); ++i) {
            const Vec3 edge = (*polygon)[(i + 1) % polygon->size()] - (*polygon)[i];
            if (separation(a, b, glm::normalize(glm::cross(n, edge))) > -tolerance)
                return false;
        }
    return true;
}

bool is_detail(const std::string& group) { return group.rfind("detail", 0) == 0; }

} // namespace

TEST_CASE("an example scene has its patches, one per face, and sound materials") {
    for (const Promise& promise : promises) {
        INFO(promise.name);
        const ReadResult result = read(promise.name);
        CHECK(result.warnings.empty());
        CHECK(result.scene.faces == promise.patches);
        CHECK(result.scene.facets.size() == promise.patches);
        CHECK(result.nonplanar_faces + result.concave_faces + result.degenerate_faces == 0);
        bool emits = false;
        for (const Material& material : result.scene.materials)
            for (int k = 0; k < 3; ++k) {
                CHECK((material.reflectance[k] >= 0.05 && material.reflectance[k] <= 0.8));
                emits = emits || material.emission[k] > 0;
            }
        CHECK(emits);
        const auto& groups = result.scene.groups;
        CHECK(std::any_of(groups.begin(), groups.end(), is_detail) == promise.detail);
    }
}

TEST_CASE("the surfaces of an example scene are closed and face the air") {
    for (const Promise& promise : promises) {
        INFO(promise.name);
        std::size_t shells = 0, open_sheets = 0;
        for (const Part& part : find_parts(read(promise.name).scene)) {
            open_sheets += part.closed ? 0 : 1;
            shells += part.closed && part.volume < 0 ? 1 : 0;
        }
        CHECK(shells == promise.shells);
        CHECK(open_sheets == promise.open_sheets);
    }
}

TEST_CASE("the objects of an example scene do not touch, and lie within the room") {
    for (const Promise& promise : promises) {
        INFO(promise.name);
        const Scene scene = read(promise.name).scene;
        std::vector<Part> solids;
        std::vector<Box> rooms;
        for (Part& part : find_parts(scene)) {
            if (part.closed && part.volume > 0)
                solids.push_back(std::move(part));
            else
                rooms.push_back(part.bounds);
        }
        for (std::size_t i = 0; i < solids.size(); ++i) {
            const Box& box = solids[i].bounds;
            INFO("solid at " << box.centre().x << ' ' << box.centre().y << ' ' << box.centre().z
                             << " in " << scene.groups[scene.facets[solids[i].facets[0]].group]);
            if (promise.name != std::string("open_scene"))
                CHECK((glm::all(glm::greaterThan(box.low, rooms[0].low)) &&
                       glm::all(glm::lessThan(box.high, rooms[0].high))));
            for (std::size_t j = 0; j < i; ++j)
                if (!boxes_apart(box, solids[j].bounds, 0)) {
                    const Vec3 other = solids[j].bounds.centre();
                    INFO("and solid at " << other.x << ' ' << other.y << ' ' << other.z);
                    CHECK(gap_between(solids[i], solids[j]) > 1e-4);
                }
        }
    }
}

TEST_CASE("no two patches of an example scene overlap in one plane") {
    for (const Promise& promise : promises) {
        const Scene scene = read(promise.name).scene;
        std::vector<std::vector<Vec3>> polygons;
        std::vector<Box> bounds;
        for (const Facet& facet : scene.facets) {
            polygons.push_back(corners(scene, facet));
            bounds.push_back(box_of(polygons.back()));
        }
        for (std::size_t i = 0; i < polygons.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!boxes_apart(bounds[i], bounds[j], 1e-9) &&
                    overlap_in_plane(polygons[i], polygons[j]))
                    FAIL_CHECK(promise.name << ": faces " << j << " and " << i << " overlap");
    }
}

TEST_CASE("the detail of the two rooms is a thousand times smaller than their walls") {
    for (const char* name : {"room_1002", "office_3576"}) {
        INFO(name);
        const Scene scene = read(name).scene;
        std::vector<double> detail, wall;
        for (const Facet& facet : scene.facets) {
            const double area = glm::length(area_vector(corners(scene, facet)));
            if (is_detail(scene.groups[facet.group]))
                detail.push_back(area);
            else if (scene.groups[facet.group] == "room")
                wall.push_back(area);
        }
        const auto median = [](std::vector<double>& values) {
            std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
            return values[values.size() / 2];
        };
        CAPTURE(median(detail), median(wall));
        CHECK(median(detail) > 1e-4 * median(wall));
        CHECK(median(detail) < 1e-3 * median(wall));
    }
}
