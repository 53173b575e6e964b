// Exact visibility in flatland: what the visibility complex gives radiosity in two dimensions.
//
// Shows: a room with two things in it, all of segments. Seen from a point of a wall, the scene is a
// row of sectors between corners. Along the wall the order of these corners changes only where a
// line through two of them meets it. Between two such places each sector is bounded by the same two
// corners, and its factor is a difference of lengths of strings (Hottel 1954, crossed strings): the
// form factors are exact although things are in the way. These lines are the vertices of the
// visibility complex (Pocchiola and Vegter 1996), which finds those that nothing interrupts by one
// sweep; here all are taken, as there are few. Prints: one row of factors beside rays, and the
// light. Draws, where a file is named: the room, its light, and the lines.

#include "geometry/vector.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

using namespace hemilux;

namespace {

/// Its left side, seen from `a` to `b`, is the one that emits and reflects.
struct Segment {
    Vec2 a, b;
    double reflectance, emission = 0;
    [[nodiscard]] double length() const { return glm::distance(a, b); }
    [[nodiscard]] Vec2 tangent() const { return (b - a) / length(); }
    [[nodiscard]] Vec2 normal() const { return {-tangent().y, tangent().x}; }
};

/// Adds the sides of a closed line, each as several segments.
void add_outline(std::vector<Segment>& scene, const std::vector<Vec2>& corners, int pieces,
                 double reflectance) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2 begin = corners[k], side = corners[(k + 1) % corners.size()] - begin;
        for (int p = 0; p < pieces; ++p)
            scene.push_back({begin + side * (double(p) / pieces),
                             begin + side * (double(p + 1) / pieces), reflectance});
    }
}

std::vector<Segment> furnished_room() {
    std::vector<Segment> scene;
    add_outline(scene, {{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 4, .7);
    scene[9].emission = 10; // of the ceiling, whose pieces begin with the eighth
    add_outline(scene, {{1.1, .6}, {.9, 1.3}, {1.7, 1.4}, {1.8, .7}}, 1, .5); // clockwise
    add_outline(scene, {{2.7, .4}, {3.1, 1.9}, {3.4, .5}}, 1, .5);
    return scene;
}

/// The segment that a ray meets first; `from` is the one that it leaves.
std::size_t first_hit(const std::vector<Segment>& scene, const Vec2& origin, const Vec2& direction,
                      std::size_t from) {
    std::size_t found = from;
    double nearest = 1e30;
    for (std::size_t j = 0; j < scene.size(); ++j) {
        const Vec2 side = scene[j].b - scene[j].a, to_a = scene[j].a - origin;
        const double across = cross(direction, side);
        if (j == from || across == 0)
            continue;
        const double t = cross(to_a, side) / across, along = cross(to_a, direction) / across;
        if (t > 1e-12 && t < nearest && along >= 0 && along <= 1) {
            nearest = t;
            found = j;
        }
    }
    return found;
}

std::vector<Vec2> corners_of(const std::vector<Segment>& scene) {
    std::vector<Vec2> corners; // each is the end of one segment and the beginning of another
    for (const Segment& segment : scene)
        corners.push_back(segment.a);
    return corners;
}

/// Where along a segment the order of corners changes [0 to 1], its ends included.
std::vector<double> changes_of_view(const Segment& segment, const std::vector<Vec2>& corners) {
    std::vector<double> at{0, 1};
    for (const Vec2& u : corners)
        for (const Vec2& v : corners) {
            const double across = cross(v - u, segment.b - segment.a);
            const double share = across != 0 ? cross(u - segment.a, v - u) / -across : -1;
            if (share > 0 && share < 1)
                at.push_back(share);
        }
    std::sort(at.begin(), at.end());
    return at;
}

/// The factors from a segment to all others, exactly.
std::vector<double> exact_row(const std::vector<Segment>& scene, std::size_t i) {
    const Segment& from = scene[i];
    const std::vector<Vec2> corners = corners_of(scene);
    const std::vector<double> at = changes_of_view(from, corners);
    std::vector<double> row(scene.size());
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
        const Vec2 begin = glm::mix(from.a, from.b, at[k]),
                   end = glm::mix(from.a, from.b, at[k + 1]);
        const double width = glm::distance(begin, end);
        if (width < 1e-12)
            continue;
        const Vec2 middle = .5 * (begin + end);
        // A corner as it is seen: the sine of its angle from the normal at the middle, and the
        // integral of that sine over the stretch, which is a difference of two strings.
        struct Seen {
            double sine, integral;
        };
        std::vector<Seen> seen{{-1, -width}, {1, width}};
        for (const Vec2& corner : corners)
            if (glm::dot(corner - middle, from.normal()) > 1e-12)
                seen.push_back({glm::dot(glm::normalize(corner - middle), from.tangent()),
                                glm::distance(corner, begin) - glm::distance(corner, end)});
        std::sort(seen.begin(), seen.end(),
                  [](const Seen& a, const Seen& b) { return a.sine < b.sine; });
        for (std::size_t s = 0; s + 1 < seen.size(); ++s) {
            const double sine = .5 * (seen[s].sine + seen[s + 1].sine);
            const Vec2 direction =
                sine * from.tangent() + std::sqrt(1 - sine * sine) * from.normal();
            row[first_hit(scene, middle, direction, i)] +=
                .5 * (seen[s + 1].integral - seen[s].integral) / from.length();
        }
    }
    return row;
}

std::vector<double> row_by_rays(const std::vector<Segment>& scene, std::size_t i, int rays) {
    Rng rng(1);
    std::vector<double> row(scene.size());
    for (int r = 0; r < rays; ++r) {
        const Vec2 origin = glm::mix(scene[i].a, scene[i].b, rng.uniform());
        const double sine = 2 * rng.uniform() - 1; // cosine-distributed, in two dimensions
        const Vec2 direction =
            sine * scene[i].tangent() + std::sqrt(1 - sine * sine) * scene[i].normal();
        row[first_hit(scene, origin, direction, i)] += 1.0 / rays;
    }
    return row;
}

/// B = E + rho F B, by Gauss and Seidel.
std::vector<double> radiosity(const std::vector<Segment>& scene,
                              const std::vector<std::vector<double>>& factors) {
    std::vector<double> B(scene.size());
    for (int iteration = 0; iteration < 100; ++iteration)
        for (std::size_t i = 0; i < scene.size(); ++i) {
            double incident = 0;
            for (std::size_t j = 0; j < scene.size(); ++j)
                incident += factors[i][j] * B[j];
            B[i] = scene[i].emission + scene[i].reflectance * incident;
        }
    return B;
}

void draw(const char* path, const std::vector<Segment>& scene, const std::vector<double>& B) {
    std::ofstream file(path);
    file << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-.1 -3.1 4.2 3.2' width='840'>\n"
            "<rect x='-.1' y='-3.1' width='4.2' height='3.2' fill='#222'/>\n";
    const auto line = [&](const Vec2& a, const Vec2& b, const char* colour, double width) {
        file << "<line x1='" << a.x << "' y1='" << -a.y << "' x2='" << b.x << "' y2='" << -b.y
             << "' stroke='" << colour << "' stroke-width='" << width << "'/>\n";
    };
    const std::vector<Vec2> corners = corners_of(scene);
    for (std::size_t u = 0; u < corners.size(); ++u)
        for (std::size_t v = u + 1; v < corners.size(); ++v)
            line(corners[u], corners[v], "#456", .003);
    for (std::size_t i = 0; i < scene.size(); ++i) {
        const int level = static_cast<int>(255 * std::min(1.0, std::sqrt(B[i] / 6)));
        char colour[16];
        std::snprintf(colour, sizeof colour, "#%02x%02x%02x", level, level, level * 4 / 5);
        line(scene[i].a, scene[i].b, colour, .05);
    }
    file << "</svg>\n";
}

} // namespace

int main(int count, char** arguments) {
    const std::vector<Segment> scene = furnished_room();
    std::vector<std::vector<double>> factors;
    double worst_sum = 0, worst_pair = 0;
    for (std::size_t i = 0; i < scene.size(); ++i)
        factors.push_back(exact_row(scene, i));
    for (std::size_t i = 0; i < scene.size(); ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < scene.size(); ++j) {
            sum += factors[i][j];
            worst_pair = std::max(worst_pair, std::abs(scene[i].length() * factors[i][j] -
                                                       scene[j].length() * factors[j][i]));
        }
        worst_sum = std::max(worst_sum, std::abs(sum - 1));
    }
    std::printf("%zu segments; rows add up to 1 but for %.0e, both directions of a pair agree but "
                "for %.0e\n",
                scene.size(), worst_sum, worst_pair);

    constexpr int rays = 100'000;
    const std::vector<double> by_rays = row_by_rays(scene, 0, rays);
    const std::vector<double> B = radiosity(scene, factors);
    double chi_squared = 0;
    std::printf("segment  factor from the first  by %d rays  radiosity\n", rays);
    int met = 0;
    for (std::size_t j = 0; j < scene.size(); ++j) {
        std::printf("%7zu  %21.6f  %14.6f  %9.4f\n", j, factors[0][j], by_rays[j], B[j]);
        if (factors[0][j] > 0) {
            const double off = by_rays[j] - factors[0][j];
            chi_squared += rays * off * off / factors[0][j];
            ++met;
        }
    }
    std::printf("chi squared of the rays: %.1f with %d degrees of freedom\n", chi_squared, met - 1);
    if (count > 1)
        draw(arguments[1], scene, B);
    const double usual = met - 1, spread = std::sqrt(2.0 * usual);
    const bool right =
        worst_sum < 1e-10 && worst_pair < 1e-10 && std::abs(chi_squared - usual) < 5 * spread;
    return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
