#pragma once
// The tracer that suits a scene.

#include "bvh/quality.h"
#include "bvh/tracer.h"
#include "radiosity/needs.h"

#include <memory>
#include <optional>

namespace hemilux {

struct MadeTracer {
    std::unique_ptr<Tracer> tracer;
    std::optional<BvhQuality> tree; ///< empty where rays test all facets
};

/// The mesh must outlive it. `threads`: that build the tree, 0 for one per core.
[[nodiscard]] MadeTracer make_tracer(const Mesh& mesh, const Needs& needs, unsigned threads = 0);

} // namespace hemilux
