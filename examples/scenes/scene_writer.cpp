#include "scene_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace hemilux {

namespace {

/// To a picometre: coordinates of one point that differ in the last bit become one vertex.
double rounded(double metres) {
    constexpr double steps_per_metre = 1e12;
    return std::round(metres * steps_per_metre) / steps_per_metre + 0.0; // + 0.0: no minus zero
}

void append(std::string& text, double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    text += ' ';
    text.append(buffer.data(), end.ptr);
}

void append(std::string& text, std::string_view keyword, const Vec3& v) {
    text += keyword;
    append(text, v.x);
    append(text, v.y);
    append(text, v.z);
    text += '\n';
}

/// The rotation by 360/n degrees as (cosine, sine).
Vec2 unit_root(int n) {
    switch (n) {
    case 4:
        return {0, 1};
    case 6:
        return {0.5, std::sqrt(0.75)};
    case 8:
        return {std::sqrt(0.5), std::sqrt(0.5)};
    case 12:
        return {std::sqrt(0.75), 0.5};
    default:
        throw std::invalid_argument("a prism has 4, 6, 8 or 12 sides");
    }
}

/// Corners of a regular polygon at a height, counter-clockwise seen from above.
std::vector<Vec3> ring(const Placement& at, int sides, double radius, double height) {
    const Vec2 root = unit_root(sides);
    Vec2 p(1, 0);
    std::vector<Vec3> corners;
    for (int i = 0; i < sides; ++i) {
        corners.push_back(at.to_world({radius * p.x, height, -radius * p.y}));
        p = {p.x * root.x - p.y * root.y, p.x * root.y + p.y * root.x};
    }
    return corners;
}

} // namespace

Placement Placement::facing(double dx, double dz) const {
    const double length = std::sqrt(dx * dx + dz * dz);
    Placement turned = *this;
    turned.cosine_ = dx / length;
    turned.sine_ = -dz / length;
    return turned;
}

Vec3 Placement::to_world(const Vec3& p) const {
    return {origin_.x + cosine_ * p.x + sine_ * p.z, origin_.y + p.y,
            origin_.z - sine_ * p.x + cosine_ * p.z};
}

Placement Placement::operator()(const Placement& inner) const {
    Placement both(to_world(inner.origin_));
    both.cosine_ = cosine_ * inner.cosine_ - sine_ * inner.sine_;
    both.sine_ = sine_ * inner.cosine_ + cosine_ * inner.sine_;
    return both;
}

void SceneWriter::use(std::string_view material) {
    const auto found = std::find_if(materials_.begin(), materials_.end(),
                                    [&](const Material& m) { return m.name == material; });
    if (found == materials_.end())
        throw std::invalid_argument("no material " + std::string(material) + " in " + name_);
    material_ = static_cast<std::size_t>(found - materials_.begin());
}

std::size_t SceneWriter::vertex(const Vec3& position) {
    const Vec3 p(rounded(position.x), rounded(position.y), rounded(position.z));
    const auto [entry, is_new] = vertex_index_.try_emplace({p.x, p.y, p.z}, vertices_.size());
    if (is_new)
        vertices_.push_back(p);
    return entry->second;
}

void SceneWriter::add_face(std::span<const Vec3> corners) {
    Face face{{}, material_, group_};
    for (const Vec3& corner : corners)
        face.vertex.push_back(vertex(corner));
    faces_.push_back(std::move(face));
}

void SceneWriter::add_grid(const Placement& at, const Vec3& corner, const Vec3& u, const Vec3& v,
                           int nu, int nv) {
    const auto point = [&](int i, int j) {
        return at.to_world(corner + u * (double(i) / nu) + v * (double(j) / nv));
    };
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i)
            add_face(
                std::array{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
}

void SceneWriter::add_box(const Placement& at, const BoxShape& shape, unsigned faces, BoxAir air) {
    for (std::size_t side = 0; side < 6; ++side)
        if ((faces >> side & 1u) != 0)
            add_box_side(at, shape, side, air);
}

void SceneWriter::add_box_side(const Placement& at, const BoxShape& shape, std::size_t side,
                               BoxAir air) {
    const std::size_t a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3; // e_b x e_c = e_a
    const bool high = side % 2 == 1;
    // All sides take their points from the same lattice, so that edges agree to the last bit.
    const auto point = [&](int i, int j) {
        std::array<int, 3> index{};
        index[a] = high ? shape.divisions[a] : 0;
        index[b] = i;
        index[c] = j;
        const auto share = [&](std::size_t axis) {
            return static_cast<double>(index[axis]) / shape.divisions[axis];
        };
        return at.to_world(shape.low + shape.size * Vec3(share(0), share(1), share(2)));
    };
    for (int j = 0; j < shape.divisions[c]; ++j)
        for (int i = 0; i < shape.divisions[b]; ++i) {
            std::array face{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
            if (high != (air == BoxAir::outside))
                std::swap(face[1], face[3]);
            add_face(face);
        }
}

void SceneWriter::add_prism(const Placement& at, const PrismShape& shape) {
    const std::size_t n = static_cast<std::size_t>(shape.sides);
    const auto level = [&](int row) {
        const double share = double(row) / shape.rows;
        const double radius = shape.base_radius + (shape.top_radius - shape.base_radius) * share;
        return ring(at, shape.sides, radius, shape.height * share);
    };
    // The caps are ladders of n/2 - 1 quads.
    const auto cap = [&](const std::vector<Vec3>& r, bool up) {
        for (std::size_t k = 0; k + 1 < n / 2; ++k) {
            std::array face{r[k], r[k + 1], r[n - 2 - k], r[n - 1 - k]};
            if (!up)
                std::swap(face[1], face[3]);
            add_face(face);
        }
    };
    std::vector<Vec3> below = level(0);
    cap(below, false);
    for (int row = 1; row <= shape.rows; ++row) {
        const std::vector<Vec3> above = level(row);
        for (std::size_t k = 0; k < n; ++k)
            add_face(std::array{below[k], below[(k + 1) % n], above[(k + 1) % n], above[k]});
        below = above;
    }
    cap(below, true);
}

std::string SceneWriter::obj() const {
    std::string text = "# " + name_ + ": " + std::to_string(patches()) +
                       " patches; metres, y is up. Made by examples/scenes/generate.cpp\n";
    text += "mtllib " + name_ + ".mtl\n";
    for (const Vec3& v : vertices_)
        append(text, "v", v);
    std::string group;
    std::size_t material = materials_.size();
    for (const Face& face : faces_) {
        if (face.group != group)
            text += "g " + (group = face.group) + '\n';
        if (face.material != material)
            text += "usemtl " + materials_[material = face.material].name + '\n';
        text += 'f';
        for (const std::size_t index : face.vertex)
            text += ' ' + std::to_string(index + 1);
        text += '\n';
    }
    return text;
}

std::string SceneWriter::mtl() const {
    std::string text = "# Materials of " + name_ + ".obj: Kd reflectance, Ke emission [W/m2]\n";
    std::vector<bool> used(materials_.size());
    for (const Face& face : faces_)
        used[face.material] = true;
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (!used[i])
            continue;
        const Material& material = materials_[i];
        text += "\nnewmtl " + material.name + '\n';
        append(text, "Kd", material.reflectance);
        if (material.emission != Vec3(0.0))
            append(text, "Ke", material.emission);
    }
    return text;
}

} // namespace hemilux
