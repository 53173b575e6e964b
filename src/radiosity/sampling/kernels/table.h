// Gathers all kernels of one instruction set for the choice at run time. The file that includes
// this names the set in HEMILUX_KERNELS.

#include "radiosity/sampling/sampling_kernels.h"

#include "radiosity/sampling/kernels/cosine.h"

#include "radiosity/sampling/kernels/emitters.h"

#include "radiosity/sampling/kernels/matrix.h"

#include "radiosity/sampling/kernels/places.h"

#include "radiosity/sampling/kernels/random.h"

#include "radiosity/sampling/kernels/sobol.h"

namespace hemilux::HEMILUX_KERNELS {

extern const SamplingKernels table;
const SamplingKernels table{sobol,     cosine, weigh_emitters, weigh_clusters, find_places,
                            last_rays, random, in_cells,       row_times};

} // namespace hemilux::HEMILUX_KERNELS
