// --guide pyramid: the densities are the numbers of patches in the pyramids of triangles, whether
// they are hidden or not (pyramids.h). Nothing between three corners is missed; a wall hides
// nothing from it.

#include "radiosity/engine/shooting/guide.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/solving/solver.h"
#include "radiosity/research/guiding/patch_boxes.h"
#include "radiosity/research/guiding/pyramids.h"

namespace hemilux {
namespace {

std::unique_ptr<LeafDensities>
count_in_pyramids(const SolverInput& input, const Hemisphere& hemisphere, const Workers& workers) {
    return std::make_unique<PyramidMap>(input.mesh, hemisphere, input.options.threshold, workers,
                                        input.monitor, input.needs);
}

double bytes(int depth, double patches) {
    return patches * (double(Hemisphere::cells_up_to(depth)) + 2 * sizeof(PatchBoxes::Node));
}

} // namespace

extern const Guide pyramid_guide{
    .name = "pyramid",
    .place = 1,
    .densities = count_in_pyramids,
    .unit = "root of patches per mean triangle",
    .bytes = bytes,
};

} // namespace hemilux
