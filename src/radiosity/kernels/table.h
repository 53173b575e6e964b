// All kernels of one instruction set, gathered for the choice at run time. The file that
// includes this names the set in HEMILUX_KERNELS.

#include "radiosity/kernel_table.h"

#include "radiosity/kernels/cosine.h"

#include "radiosity/kernels/emitters.h"

#include "radiosity/kernels/matrix.h"

#include "radiosity/kernels/places.h"

#include "radiosity/kernels/random.h"

#include "radiosity/kernels/sobol.h"

namespace hemilux::HEMILUX_KERNELS {

extern const KernelTable table;
const KernelTable table{
    {sobol, cosine, weigh_emitters, weigh_clusters, find_places, count_below, random, in_cells},
    {row_times}};

} // namespace hemilux::HEMILUX_KERNELS
