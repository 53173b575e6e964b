#pragma once
// The settings of `hemilux dim`.

#include "app/settings/overrides.h"
#include "app/settings/settings.h"
#include "io/files/provenance.h"

#include <string>
#include <vector>

namespace hemilux {

struct DimSettings {
    std::string input;            ///< a table or picture of `solve --layers`
    std::vector<Override> powers; ///< factors by layer, in the order given; others stay as solved
    std::string wishes;           ///< path of --wish; empty: none
    std::vector<Output> outputs;
    ViewSettings view; ///< exposure and tone of .png pictures
    Provenance from;
    Verbosity verbosity = Verbosity::normal;
};

} // namespace hemilux
