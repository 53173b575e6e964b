// The aliasing of a hemicube (Cohen and Greenberg 1985).
//
// Shows: a small patch looks up at thirteen strips of the ceiling, narrow ones and wide ones. A
// pixel of its hemicube belongs to one strip as a whole; a strip that is narrower than a pixel may
// be missed, or get all of one.
// Prints: the factor of each strip by hemicubes of 16 to 256 pixels along the edge, beside the
// closed form of its centre and the exact factor, and the rms error of each column. More pixels
// come to the closed form of the centre, not quite to the exact factor of the whole patch.

#include "bvh/wide/wide_bvh.h"
#include "geometry/projected_polygon.h"
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace hemilux;

namespace {

constexpr std::array<std::uint32_t, 3> edges{16, 64, 256};

/// A patch of 0.2 x 0.2 under a ceiling 2 wide at height 1, cut into strips by turns narrow and
/// wide.
Scene strips_over_a_patch() {
    Scene scene;
    scene.materials.push_back({});
    scene.groups.push_back("scene");
    const auto add = [&scene](const Vec3& corner, const Vec3& u, const Vec3& v) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v})
            scene.vertices.push_back(p);
        scene.facets.push_back({{first, first + 1, first + 2, first + 3}, scene.faces++, 0, 0});
    };
    add({-.1, -.1, 0}, {.2, 0, 0}, {0, .2, 0});
    constexpr double narrow = .01, wide = (2 - 7 * narrow) / 6;
    double x = -1;
    for (int k = 0; k < 13; ++k) {
        const double width = k % 2 == 0 ? narrow : wide;
        add({x, -1, 1}, {0, 2, 0}, {width, 0, 0}); // facing down
        x += width;
    }
    return scene;
}

/// Of patch 0, by patch.
std::vector<double> factors_by_pixels(const Mesh& mesh, const Tracer& tracer, std::uint32_t edge) {
    const Monitor monitor;
    const HemicubeRow row =
        hemicube_row(Hemicube(edge), mesh, tracer, 0, Workers(1), monitor.interrupted);
    std::vector<double> factors(mesh.patches().size());
    for (const HemicubeRow::Entry& entry : row.entries)
        factors[entry.patch] = entry.factor;
    return factors;
}

} // namespace

int main() {
    const Mesh mesh(strips_over_a_patch());
    const WideBvh bvh(mesh.soup());
    std::array<std::vector<double>, edges.size()> by_pixels;
    for (std::size_t e = 0; e < edges.size(); ++e)
        by_pixels[e] = factors_by_pixels(mesh, bvh, edges[e]);

    const Patch& from = mesh.patches()[0];
    const Frame frame = Frame::from_normal(from.normal);
    std::array<double, edges.size()> squares{};
    std::printf("strip   N = 16   N = 64  N = 256   centre    exact\n");
    for (std::size_t j = 1; j < mesh.patches().size(); ++j) {
        const Polygon& strip = mesh.patches()[j].shape;
        const double exact = exchange_area(from.shape, strip) / from.area;
        std::printf("%5zu", j);
        for (std::size_t e = 0; e < edges.size(); ++e) {
            std::printf("  %.5f", by_pixels[e][j]);
            squares[e] += (by_pixels[e][j] - exact) * (by_pixels[e][j] - exact);
        }
        std::printf("  %.5f  %.5f\n", ProjectedPolygon(from.centre, frame, strip).factor(), exact);
    }
    std::printf("rms  ");
    for (double& error : squares) {
        error = std::sqrt(error / double(mesh.patches().size() - 1));
        std::printf("  %.5f", error);
    }
    std::printf("\n");
    return squares[1] < squares[0] && squares[2] < squares[1] ? 0 : 1;
}
