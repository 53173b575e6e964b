// --guide visible: rays follow rho^2 / A of the patches that a few rays of each patch see before
// the first step (visibility_guide.h). A wall does not mislead it.

#include "radiosity/engine/shooting/guide.h"
#include "radiosity/research/guiding/visibility_guide.h"

namespace hemilux {
namespace {

std::unique_ptr<Strategy> make_visible(const SolverInput& input, const Hemisphere& hemisphere,
                                       const Workers& workers) {
    return make_visibility_guide(input, hemisphere, workers, false);
}

} // namespace

extern const Guide visible_guide{
    .name = "visible",
    .place = 2,
    .strategy = make_visible,
    .bytes = bytes_of_visibility_guide,
};

} // namespace hemilux
