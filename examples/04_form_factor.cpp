// A form factor estimated against its closed form.
//
// Shows: two unit squares that face each other, the floor and the ceiling of a cube. Three ways to
// the same number, each with its standard error: pairs of random points and the kernel between
// them; random points of the floor and directions by the cosine, counting those that meet the
// ceiling; points of the floor and the ceiling's closed form as seen from each. Prints: estimate,
// standard error, and by how many standard errors it misses.

#include "geometry/polygon.h"
#include "geometry/projected_polygon.h"
#include "radiosity/paper/sampling/rng.h"

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace hemilux;
using std::numbers::pi;

namespace {

const Polygon floor_square{{Vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
const Polygon ceiling{{Vec3(0, 0, 1), {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}};
const Vec3 up(0, 0, 1);

Vec3 random_point(const Polygon& polygon, Rng& rng) {
    const double u = rng.uniform();
    return polygon.sample({u, rng.uniform()});
}

/// cos cos' A' / (pi r^2) for a random pair of points.
double pair_of_points(Rng& rng) {
    const Vec3 d = random_point(ceiling, rng) - random_point(floor_square, rng);
    const double r_squared = glm::dot(d, d);
    return d.z * d.z * ceiling.area() / (pi * r_squared * r_squared);
}

/// 1 where a cosine-weighted ray meets the ceiling, else 0.
double ray(Rng& rng) {
    const Vec3 origin = random_point(floor_square, rng);
    const double r = std::sqrt(rng.uniform()), phi = 2 * pi * rng.uniform();
    const Vec3 direction(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r));
    const Vec3 at = origin + direction / direction.z;
    return at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1 ? 1.0 : 0.0;
}

/// The ceiling as seen from a random point, exactly (Lambert).
double closed_kernel(Rng& rng) {
    return ProjectedPolygon(random_point(floor_square, rng), Frame::from_normal(up), ceiling)
        .factor();
}

void report(const char* name, double (*draw)(Rng&), double exact) {
    constexpr int samples = 100000;
    Rng rng(1);
    double sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
        const double x = draw(rng);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / samples;
    const double error = std::sqrt((squares / samples - mean * mean) / (samples - 1));
    std::printf("%-28s %.6f +- %.6f  (%+.2f standard errors off)\n", name, mean, error,
                (mean - exact) / error);
}

} // namespace

int main() {
    constexpr double exact = 0.19982490; // of Howell's catalogue of configuration factors
    std::printf("%-28s %.6f\n", "closed form (C-11)", exact);
    report("pairs of points", pair_of_points, exact);
    report("rays by the cosine", ray, exact);
    report("point to polygon", closed_kernel, exact);
}
