#include "support/blender_room.h"

#include "geometry/vector.h"
#include "radiosity/rng.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace hemilux::test {
namespace {

using Face = std::vector<std::size_t>; ///< corners, counted from 0 within its object

struct Object {
    std::string name, material;
    std::vector<Vec3> vertices;
    std::vector<Face> faces; ///< as modelled
    bool right;              ///< as modelled it faces the light
};

/// Blender's default cube, two units wide.
Object cube() {
    Object cube{"Cube", "Wall", {}, {}, false};
    for (const double x : {1.0, -1.0})
        for (const double z : {-1.0, 1.0})
            for (const double y : {1.0, -1.0})
                cube.vertices.emplace_back(x, y, z);
    cube.faces = {{0, 4, 6, 2}, {3, 2, 6, 7}, {7, 6, 4, 5},
                  {5, 1, 3, 7}, {1, 0, 2, 3}, {5, 4, 0, 1}};
    return cube;
}

/// Just below the ceiling, y being up as the exporter turns it.
Object lamp() {
    constexpr double h = 0.3, y = 0.98;
    return {
        "Plane", "Lamp", {{-h, y, h}, {h, y, h}, {-h, y, -h}, {h, y, -h}}, {{0, 1, 3, 2}}, false};
}

/// Rings of quads between two fans of triangles.
Object sphere() {
    constexpr std::size_t rings = 6, segments = 10;
    constexpr double radius = 0.4, pi = std::numbers::pi;
    const Vec3 centre(-0.3, -0.55, 0.2);
    Object ball{
        "Sphere", "Clay", {centre + Vec3(0, radius, 0), centre - Vec3(0, radius, 0)}, {}, true};
    const auto at = [](std::size_t ring, std::size_t k) {
        return 2 + (ring - 1) * segments + k % segments;
    };
    for (std::size_t ring = 1; ring < rings; ++ring)
        for (std::size_t k = 0; k < segments; ++k) {
            const double polar = pi * double(ring) / rings, angle = 2 * pi * double(k) / segments;
            ball.vertices.push_back(centre + radius * Vec3(std::sin(polar) * std::cos(angle),
                                                           std::cos(polar),
                                                           -std::sin(polar) * std::sin(angle)));
        }
    for (std::size_t k = 0; k < segments; ++k) {
        ball.faces.push_back({0, at(1, k), at(1, k + 1)});
        for (std::size_t ring = 1; ring + 1 < rings; ++ring)
            ball.faces.push_back(
                {at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)});
        ball.faces.push_back({1, at(rings - 1, k + 1), at(rings - 1, k)});
    }
    return ball;
}

std::string text_of(const char* format, const Vec3& v) {
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, format, v.x, v.y, v.z);
    return buffer;
}

class Writer {
  public:
    Writer(Facing facing, std::uint64_t seed) : facing_(facing), rng_(seed) {}

    std::string write(const std::vector<Object>& objects) {
        text_ = "# Blender 4.2.0\n# www.blender.org\nmtllib room.mtl\n";
        for (const Object& object : objects)
            add(object);
        return std::move(text_);
    }

  private:
    void add(const Object& object) {
        text_ += "o " + object.name + "\n";
        for (const Vec3& v : object.vertices)
            text_ += text_of("v %.6f %.6f %.6f\n", v);
        std::vector<Face> faces = object.faces;
        for (Face& face : faces)
            if (is_turned(object))
                std::ranges::reverse(face);
        for (const Face& face : faces)
            text_ += text_of("vn %.4f %.4f %.4f\n", normal_of(object, face));
        text_ +=
            "vt 0.000000 0.000000\nvt 1.000000 1.000000\ns 0\nusemtl " + object.material + "\n";
        for (const Face& face : faces) {
            ++normals_;
            text_ += "f";
            for (const std::size_t v : face)
                text_ += " " + std::to_string(vertices_ + v + 1) + "/" +
                         std::to_string(texture_points_ + 1 + v % 2) + "/" +
                         std::to_string(normals_);
            text_ += "\n";
        }
        vertices_ += object.vertices.size();
        texture_points_ += 2;
    }

    bool is_turned(const Object& object) {
        switch (facing_) {
        case Facing::as_modelled:
            return false;
        case Facing::right:
            return !object.right;
        case Facing::all_turned:
            return true;
        case Facing::half_turned:
            return rng_.uniform() < 0.5;
        }
        return false;
    }

    static Vec3 normal_of(const Object& object, const Face& face) {
        const auto& v = object.vertices;
        return glm::normalize(glm::cross(v[face[1]] - v[face[0]], v[face[2]] - v[face[0]]));
    }

    Facing facing_;
    Rng rng_;
    std::string text_;
    std::size_t vertices_ = 0, texture_points_ = 0, normals_ = 0;
};

} // namespace

std::string blender_room(Facing facing, std::uint64_t seed) {
    return Writer(facing, seed).write({cube(), lamp(), sphere()});
}

std::string blender_materials() {
    return "# Blender 4.2.0 MTL File: 'room.blend'\n# www.blender.org\n\n"
           "newmtl Wall\nNs 250.000000\nKa 1.000000 1.000000 1.000000\nKd 0.700000 0.700000 "
           "0.700000\nKs 0.500000 0.500000 0.500000\nKe 0.000000 0.000000 0.000000\nillum 2\n\n"
           "newmtl Lamp\nKd 0.000000 0.000000 0.000000\nKe 10.000000 9.000000 8.000000\nillum 2\n\n"
           "newmtl Clay\nKd 0.800000 0.400000 0.200000\nKe 0.000000 0.000000 0.000000\nillum 2\n";
}

} // namespace hemilux::test
