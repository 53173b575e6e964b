#pragma once
// Estimates how much of the light of an emitter leaves the scene or falls on backs.
//
// There are two estimates where the factors to an emitter are computed in closed form. One is the
// share of its own rays that were lost. The other is the power that the receivers miss of all that
// it sent. Few rays of an emitter go through a small window; if none did, the window would be taken
// for a wall.

#include "radiosity/engine/form_factors/sampled_form_factors.h"

#include <span>
#include <vector>

namespace hemilux {

struct EmitterLoss {
    EscapeFraction lost;
    double rays = 0; ///< so many would estimate it as exactly
};

/// Returns the losses, by batch, of the emitters whose factors are known in closed form, in the
/// order of the batch. Each loss is the mean of both estimates, weighted by the inverse of their
/// variances. The variances are those of the rays of all batches together, and of the spread of the
/// batches. So no weight depends on what a batch itself has met. The rays alone count if no emitter
/// lost any, and for black patches, which trace none. `rays` is the number of rays of a patch in
/// each batch.
[[nodiscard]] std::vector<std::vector<EmitterLoss>>
emitter_losses(std::span<const SampledFormFactors> batches, double rays);

} // namespace hemilux
