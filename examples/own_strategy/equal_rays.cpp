// A strategy of one's own in one file: every triangle of the last level gets the same number of
// rays, whatever power it has, so that rays near the horizon, where triangles have little projected
// area, are many and weak.
//
// Build hemilux with it:
//
//     cmake --preset release -DHEMILUX_EXTRA_METHODS=$PWD/examples/own_strategy/equal_rays.cpp
//
// and --method equal-rays is there, in `hemilux compare` too, and all property tests hold for it:
// shares that sum to 1, Lambert's law, the furnace, agreement with `matrix`. A file in
// src/radiosity/strategies/ is found without being named.

#include "radiosity/shooting/shooting.h"

namespace hemilux {
namespace {

class EqualRays final : public Strategy {
  public:
    explicit EqualRays(const Hemisphere& hemisphere) {
        const auto& cells = hemisphere.cells();
        const std::size_t first = Hemisphere::cells_up_to(hemisphere.depth() - 1);
        const double rays = 1.0 / static_cast<double>(cells.size() - first);
        for (std::size_t c = first; c < cells.size(); ++c)
            allocated_.add(static_cast<std::uint16_t>(c), rays);
    }
    Allocation allocate(std::uint32_t, AllocatedCells&) const override { return allocated_.view(); }

  private:
    AllocatedCells allocated_;
};

std::unique_ptr<Strategy> make_equal_rays(const SolverInput&, const Hemisphere& hemisphere,
                                          const Workers&) {
    return std::make_unique<EqualRays>(hemisphere);
}

} // namespace

extern const Method equal_rays_method;
const Method equal_rays_method{
    .name = "equal-rays",
    .summary = "the same number of rays for every triangle (an example)",
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_equal_rays>,
    .strategy = make_equal_rays,
};

} // namespace hemilux
