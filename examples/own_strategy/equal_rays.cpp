// A strategy of one's own in one file, its option included: every triangle of the last level gets
// the same number of rays, whatever power it has, so that rays near the horizon, where triangles
// have little projected area, are many and weak. With --coarser N the triangles are those N levels
// above.
//
// Build hemilux with it:
//
//     cmake --preset release -DHEMILUX_EXTRA_METHODS=$PWD/examples/own_strategy/equal_rays.cpp
//
// and --method equal-rays is there, in `hemilux compare` too, and all property tests hold for it:
// shares that sum to 1, Lambert's law, the furnace, agreement with `matrix`. Its option is in
// --help, in files of --config, in what shells complete and in checkpoints. A file in
// src/radiosity/engine/methods/ is found without being named.

#include "radiosity/engine/shooting/shooting.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/own_options.h"

#include <array>
#include <stdexcept>

namespace hemilux {
namespace {

struct EqualRaysOptions {
    std::uint32_t coarser = 0; ///< levels above the last one
};

class EqualRays final : public Strategy {
  public:
    EqualRays(const Hemisphere& hemisphere, const EqualRaysOptions& options) {
        const int level = hemisphere.depth() - static_cast<int>(options.coarser);
        const std::size_t begin = Hemisphere::cells_up_to(level - 1);
        const std::size_t end = Hemisphere::cells_up_to(level);
        for (std::size_t c = begin; c < end; ++c)
            allocated_.add(static_cast<std::uint16_t>(c), 1 / double(end - begin));
    }
    Allocation allocate(std::uint32_t, AllocatedCells&) const override { return allocated_.view(); }

  private:
    AllocatedCells allocated_;
};

std::unique_ptr<Strategy> make_equal_rays(const SolverInput& input, const Hemisphere& hemisphere,
                                          const Workers&) {
    return std::make_unique<EqualRays>(hemisphere, own_options<EqualRaysOptions>(input.options));
}

constexpr std::array<std::uint32_t, 3> choices{0, 1, 2};

std::vector<MethodOption> options() {
    return {number_option("--coarser", "its triangles are so many levels above the last one [0]",
                          &EqualRaysOptions::coarser, choices)};
}

void check(const SolveOptions& options, std::size_t) {
    if (static_cast<int>(own_options<EqualRaysOptions>(options).coarser) > options.depth)
        throw std::invalid_argument("--coarser may not be more than --depth");
}

} // namespace

extern const Method equal_rays_method{
    .name = "equal-rays",
    .summary = "the same number of rays for every triangle (an example)",
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_equal_rays>,
    .strategy = make_equal_rays,
    .options = options,
    .check = check,
};

} // namespace hemilux
