// Writes a city of any number of facets as OBJ: boxes of different heights along streets, walls and
// roofs and ground divided into quads. Where a facet is missing to the number, the largest are
// halved.
//
//     hemilux_make_city FACETS FILE [SEED]

#include "geometry/vector.h"
#include "io/files/atomic_file.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <queue>
#include <string>
#include <vector>

namespace {

using hemilux::Vec3;

struct Quad {
    std::array<Vec3, 4> corner; ///< [m]
    int group;                  ///< a building from 1 on, or 0 for the ground

    [[nodiscard]] double area() const {
        return glm::length(glm::cross(corner[1] - corner[0], corner[3] - corner[0]));
    }
    bool operator<(const Quad& other) const { return area() < other.area(); }
};

/// Adds columns times rows equal quads of a parallelogram.
void add_divided(std::priority_queue<Quad>& quads, const Vec3& origin, const Vec3& along,
                 const Vec3& up, int columns, int rows, int group) {
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const Vec3 a = along / double(columns), b = up / double(rows);
            const Vec3 p = origin + double(c) * a + double(r) * b;
            quads.push({{p, p + a, p + a + b, p + b}, group});
        }
}

std::array<Quad, 2> halves(const Quad& quad) {
    const auto& [a, b, c, d] = quad.corner;
    if (glm::distance(a, b) >= glm::distance(b, c)) {
        const Vec3 m = (a + b) / 2.0, n = (c + d) / 2.0;
        return {{{{a, m, n, d}, quad.group}, {{m, b, c, n}, quad.group}}};
    }
    const Vec3 m = (b + c) / 2.0, n = (d + a) / 2.0;
    return {{{{a, b, m, n}, quad.group}, {{n, m, c, d}, quad.group}}};
}

/// Streets are 12 m wide and buildings 18 m by 14 m, from 6 to 30 m high.
std::priority_queue<Quad> make_city(int along, std::uint64_t seed) {
    constexpr double street = 12, width = 18, depth = 14, storey = 6;
    hemilux::Rng random(seed);
    std::priority_queue<Quad> quads;
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    int group = 0;
    for (int i = 0; i <= along; ++i)
        for (int k = 0; k <= along; ++k) {
            const Vec3 p(i * (street + width), k * (street + depth), 0);
            add_divided(quads, p, street * x, street * y, 2, 2, 0);
            if (i < along)
                add_divided(quads, p + street * x, width * x, street * y, 2, 2, 0);
            if (k < along)
                add_divided(quads, p + street * y, street * x, depth * y, 2, 2, 0);
            if (i == along || k == along)
                continue;
            ++group;
            const int storeys = 1 + static_cast<int>(5 * random.uniform());
            const Vec3 a = p + street * x + street * y, b = a + width * x, c = b + depth * y,
                       d = a + depth * y, up = storeys * storey * z;
            add_divided(quads, a, b - a, up, 2, storeys, group);
            add_divided(quads, b, c - b, up, 2, storeys, group);
            add_divided(quads, c, d - c, up, 2, storeys, group);
            add_divided(quads, d, a - d, up, 2, storeys, group);
            add_divided(quads, a + up, b - a, d - a, 2, 2, group);
        }
    return quads;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: hemilux_make_city FACETS FILE [SEED]\n");
        return 1;
    }
    const auto facets = static_cast<std::size_t>(std::max(1l, std::atol(argv[1])));
    const auto seed = static_cast<std::uint64_t>(argc > 3 ? std::atol(argv[3]) : 1);
    int along = 1;
    std::priority_queue<Quad> quads = make_city(along, seed);
    for (auto more = quads; (more = make_city(along + 1, seed)).size() <= facets; ++along)
        quads = std::move(more);
    while (quads.size() < facets) {
        const Quad largest = quads.top();
        quads.pop();
        for (const Quad& half : halves(largest))
            quads.push(half);
    }
    hemilux::AtomicFile file(argv[2]);
    std::size_t vertex = 1;
    int group = -1;
    std::vector<Quad> sorted;
    for (; !quads.empty(); quads.pop())
        sorted.push_back(quads.top());
    std::ranges::stable_sort(sorted, {}, &Quad::group);
    std::array<char, 128> line;
    for (const Quad& quad : sorted) {
        std::string text;
        if (quad.group != group)
            text =
                (quad.group == 0 ? "g ground" : "g building" + std::to_string(quad.group)) + "\n";
        group = quad.group;
        for (const Vec3& p : quad.corner) {
            std::snprintf(line.data(), line.size(), "v %.9g %.9g %.9g\n", p.x, p.y, p.z);
            text += line.data();
        }
        text += "f";
        for (int k = 0; k < 4; ++k)
            text += " " + std::to_string(vertex++);
        file.write(text + "\n");
    }
    file.commit();
}
