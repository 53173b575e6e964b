// --guide learned: rays follow the same as with --guide visible, which here is learned from the
// rays of the steps too (visibility_guide.h).

#include "radiosity/engine/shooting/guide.h"
#include "radiosity/research/guiding/visibility_guide.h"

namespace hemilux {
namespace {

std::unique_ptr<Strategy> make_learned(const SolverInput& input, const Hemisphere& hemisphere,
                                       const Workers& workers) {
    return make_visibility_guide(input, hemisphere, workers, true);
}

} // namespace

extern const Guide learned_guide{
    .name = "learned",
    .place = 3,
    .strategy = make_learned,
    .bytes = bytes_of_visibility_guide,
};

} // namespace hemilux
