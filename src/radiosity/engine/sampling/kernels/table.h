// Gathers all kernels of one instruction set for the choice at run time. The file that includes
// this names the set in HEMILUX_KERNELS.

#include "radiosity/engine/sampling/sampling_kernels.h"

#include "radiosity/engine/sampling/kernels/cosine.h"

#include "radiosity/engine/sampling/kernels/emitters.h"

#include "radiosity/engine/sampling/kernels/matrix.h"

#include "radiosity/engine/sampling/kernels/places.h"

#include "radiosity/engine/sampling/kernels/random.h"

#include "radiosity/engine/sampling/kernels/sobol.h"

namespace hemilux::HEMILUX_KERNELS {

extern const SamplingKernels table;
const SamplingKernels table{sobol,     cosine, weigh_emitters, weigh_clusters, find_places,
                            last_rays, random, in_cells,       row_times};

} // namespace hemilux::HEMILUX_KERNELS
