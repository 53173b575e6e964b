// Progressive ray refinement for Monte Carlo radiosity (paper section 3.3; Feda and Purgathofer
// 1993).
//
// The hemisphere is one cell: all rays of a patch follow the cosine law. Steps of few rays each are
// combined by their numbers of rays; with equal steps the rule "divide by k what was received" is
// the running mean. The method needs no preprocessing and no memory. It is the yardstick for all
// others.

#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/shooting/shooting.h"
#include "radiosity/paper/pages/pages.h"

namespace hemilux {
namespace {

class Cosine final : public Strategy {
  public:
    Allocation allocate(std::uint32_t, AllocatedCells&) const override {
        static constexpr std::uint16_t cell = whole_hemisphere;
        static constexpr double all_rays = 1;
        return {{&cell, 1}, {&all_rays, 1}};
    }
};

std::unique_ptr<Strategy> make_cosine(const SolverInput&, const Hemisphere&, const Workers&) {
    return std::make_unique<Cosine>();
}

} // namespace

extern const Method cosine_method{
    .name = "progressive-monte-carlo",
    .summary = "steps of random cosine-distributed rays (Feda and Purgathofer 1993; paper 3.3)",
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_cosine>,
    .strategy = make_cosine,
    .work = {.passes = true},
    .plain = plain::progressive_monte_carlo,
    .role = Role::baseline,
    .aims = has_aimer,
};

} // namespace hemilux
