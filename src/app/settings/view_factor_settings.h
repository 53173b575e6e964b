#pragma once
// The settings of `hemilux viewfactors`, once the command line has been read.

#include "app/settings/settings.h"
#include "geometry/vector.h"
#include "io/files/provenance.h"
#include "radiosity/answers/surfaces/factors_asked.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// What `exchange` computes of view factors.
struct HeatSettings {
    std::string surfaces, output; ///< paths; empty: no heat is computed
    std::optional<double> sky_temperature, ground_temperature; ///< [K]
};

/// What is asked of factors, and where it goes; seed and threads are those of the options.
struct ViewFactorSettings : FactorsAsked {
    SceneSettings scene;
    SolveOptions options; ///< seed, threads
    bool sky = false;     ///< it is a column, as the ground is with `ground`
    CheckpointSettings checkpoint;
    std::optional<int> up;   ///< axis; empty: 1 for glTF, else 2
    std::string points;      ///< file of further rows; empty: none
    std::optional<Vec3> sun; ///< unit vector in which its light goes
    std::string suns;        ///< file of more of them; empty: none
    std::string sunlit;      ///< path of the table of sunlit fractions; empty: none
    HeatSettings heat;
    std::vector<std::string> outputs;
    std::string legend; ///< path; empty: none
    Provenance from;    ///< provenance of the files
    std::vector<GivenOption> given;
    Verbosity verbosity = Verbosity::normal;

    /// Returns what is asked of factors, with seed and threads.
    [[nodiscard]] FactorsAsked asked() const {
        FactorsAsked asked = *this;
        asked.seed = options.seed;
        asked.threads = options.threads;
        return asked;
    }

    static constexpr double max_dense_bytes = 1e9;
};

} // namespace hemilux
