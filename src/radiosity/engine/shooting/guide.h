#pragma once
// What may guide the rays of the method `hemisphere` in place of the densities that it counts. The
// engine has none; a library above it may add some (additions.h), and --guide names them.

#include "radiosity/engine/densities/density.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/own_options.h"

#include <memory>
#include <string_view>

namespace hemilux {

struct Guide {
    std::string_view name; ///< value of --guide
    int place;             ///< place among the values of --guide, after `density`
    /// Makes other densities, by which triangles are divided and get rays as by those counted;
    /// nullptr if it makes a strategy of its own.
    std::unique_ptr<LeafDensities> (*densities)(const SolverInput&, const Hemisphere&,
                                                const Workers&) = nullptr;
    std::string_view unit = {}; ///< unit of these densities
    MakeStrategy strategy = nullptr;
    double (*bytes)(int depth, double patches); ///< memory, as Method::bytes
};

/// The option --guide; nullptr: the densities that are counted.
struct GuideChoice {
    const Guide* guide = nullptr;
};

/// Returns the guide of the options; with `literal` it is the density.
[[nodiscard]] inline const Guide* guide_of(const SolveOptions& options) {
    return options.literal ? nullptr : own_options<GuideChoice>(options).guide;
}

} // namespace hemilux
