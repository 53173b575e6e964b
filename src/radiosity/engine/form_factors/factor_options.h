#pragma once
// Defines --factors and --exact: how the methods that solve by form factors find them.

#include "radiosity/engine/solving/method.h"

#include <cstdint>

namespace hemilux {

enum class FactorKind {
    rays,    ///< samples by chance
    exact,   ///< integrals, without chance where patches see each other fully
    hemicube ///< pixels of a hemicube over each patch (Cohen and Greenberg 1985)
};

struct FactorOptions {
    FactorKind kind = FactorKind::rays;
    /// Pixels along an edge of the hemicube's top, even, 2 to 1024. Twice as many take fourfold
    /// rays and time. What is smaller than a pixel is missed or counts too much.
    std::uint32_t hemicube_edge = 64;
};

/// Returns --factors, for a method with exact factors or without.
[[nodiscard]] MethodOption factors_option(bool with_exact);
/// Returns --exact, which is `--factors exact`.
[[nodiscard]] MethodOption exact_option();
/// Adapts the work of a method to hemicubes. They look once from all patches, whatever the scene
/// needs, and what lies between their pixels is not random.
void adapt_to_factors(MethodWork& work, const SolveOptions& options);

} // namespace hemilux
