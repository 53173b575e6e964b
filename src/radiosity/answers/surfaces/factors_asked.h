#pragma once
// What may be asked of view factors between surfaces.

#include <cstdint>
#include <optional>
#include <string>

namespace hemilux {

/// The surfaces that rows of view factors stand for.
enum class FactorRows { face, group, material, patch };

/// The factors whose error is asked for.
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

struct FactorsAsked {
    FactorRows by = FactorRows::face;
    double error = .01;            ///< relative, or of a row's sum with FactorAim::Of::rows [-]
    FactorAim aim;                 ///< what it is of
    std::uint32_t rays = 1024;     ///< from each patch, to find who sees whom; a power of two
    bool ground = false;           ///< with FactorAim::Of::sky the ground is asked for, too
    std::optional<double> seconds; ///< after which factors are as exact as they are then
    std::optional<SkyDivision> sky_bands;
    std::uint64_t seed = 1;
    unsigned threads = 0; ///< 0: one per core
};

} // namespace hemilux
