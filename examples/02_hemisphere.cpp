// One hemisphere divided, level by level (paper section 5a).
//
// Shows: the four octants and their divisions at the edge midpoints; that the "equal" triangles are
// not equal, in solid angle and still less in projected solid angle, by which a diffuse patch
// radiates.
// Prints: a row per level with the number of triangles and of distinct vertices up to that level,
// and the smallest and largest solid angle and projected solid angle of the level's triangles.

#include "radiosity/paper/hemisphere/hemisphere.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = 0, sum = 0;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
        sum += x;
    }
};

} // namespace

int main() {
    using hemilux::Hemisphere;
    std::printf("level  triangles  vertices      solid angle [sr]          projected [sr]\n");
    std::printf("       up to it   up to it    min     max     sum       min     max     sum\n");
    for (int level = 0; level <= 3; ++level) {
        const Hemisphere hemisphere(level);
        Range solid, projected;
        for (const Hemisphere::Cell& cell : hemisphere.cells())
            if (cell.level == level) {
                solid.add(cell.solid_angle);
                projected.add(cell.projected_solid_angle);
            }
        std::printf("%5d  %9zu  %8zu  %.5f %.5f %.5f   %.5f %.5f %.5f\n", level,
                    hemisphere.cells().size(), hemisphere.vertices().size(), solid.low, solid.high,
                    solid.sum, projected.low, projected.high, projected.sum);
    }
}
