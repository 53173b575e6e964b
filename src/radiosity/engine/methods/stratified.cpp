// The control: the triangles of the hemisphere subdivision without any density.
//
// All triangles of the last level get rays in proportion to power. This is what the technique gains
// by merely dividing the hemisphere, before it has looked at the scene. It needs no density rays
// and no memory.

#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/shooting/shooting.h"

namespace hemilux {
namespace {

class Stratified final : public Strategy {
  public:
    explicit Stratified(const Hemisphere& hemisphere) {
        const auto& cells = hemisphere.cells();
        for (std::size_t c = Hemisphere::cells_up_to(hemisphere.depth() - 1); c < cells.size();
             ++c) {
            const auto cell = static_cast<std::uint16_t>(c);
            allocated_.add(cell, power_share(hemisphere, cell, CellArea::projected_solid_angle));
        }
    }
    Allocation allocate(std::uint32_t, AllocatedCells&) const override { return allocated_.view(); }

  private:
    AllocatedCells allocated_;
};

std::unique_ptr<Strategy> make_stratified(const SolverInput&, const Hemisphere& hemisphere,
                                          const Workers&) {
    return std::make_unique<Stratified>(hemisphere);
}

} // namespace

extern const Method stratified_method{
    .name = "stratified",
    .summary = "the same spherical triangles without densities (the control)",
    .has_depth = true,
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_stratified>,
    .strategy = make_stratified,
    .work = {.passes = true},
    .aims = has_aimer,
};

} // namespace hemilux
