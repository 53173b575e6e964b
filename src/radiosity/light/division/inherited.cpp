#include "radiosity/light/division/inherited.h"

namespace hemilux {

void inherit(Solution& solution, std::span<const std::uint32_t> parents) {
    solution.radiosity = inherited(solution.radiosity, parents);
    solution.standard_error = inherited(solution.standard_error, parents);
    solution.slope.clear(); // of the whole patch
    if (!solution.weight.empty())
        solution.weight = inherited(solution.weight, parents);
    solution.hits = inherited(solution.hits, parents);
}

} // namespace hemilux
