#pragma once
// The settings of `hemilux viewfactors`, once the command line has been read.

#include "app/settings/settings.h"
#include "geometry/vector.h"
#include "io/files/provenance.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// The surfaces that rows of view factors stand for.
enum class FactorRows { face, group, material, patch };

/// The factors whose error is meant by --error.
struct FactorAim {
    enum class Of { above, rows, largest, pair, sky };
    Of of = Of::above;
    double least = 1e-3;  ///< of `above`: the smallest factor that counts [-]
    std::string from, to; ///< of `pair`: names of surfaces
};

/// How the sky is divided into columns.
struct SkyDivision {
    unsigned steps = 0; ///< of altitude; 0: the patches of Tregenza
};

/// What `exchange` computes of view factors.
struct HeatSettings {
    std::string surfaces, output; ///< paths; empty: no heat is computed
    std::optional<double> sky_temperature, ground_temperature; ///< [K]
};

struct ViewFactorSettings {
    SceneSettings scene;
    SolveOptions options; ///< seed, threads
    FactorRows by = FactorRows::face;
    double error = .01;               ///< relative, or of a row's sum with FactorAim::Of::rows [-]
    FactorAim aim;                    ///< what it is of
    std::uint32_t rays = 1024;        ///< from each patch, to find who sees whom; a power of two
    bool sky = false, ground = false; ///< they are columns
    std::optional<double> seconds;    ///< after which factors are as exact as they are then
    CheckpointSettings checkpoint;
    std::optional<SkyDivision> sky_bands;
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

    static constexpr double max_dense_bytes = 1e9;
};

} // namespace hemilux
