#pragma once
// The tracer that suits a scene.

#include "bvh/quality.h"
#include "bvh/tracer.h"

#include <memory>
#include <optional>

namespace hemilux {

class Mesh;

struct MadeTracer {
    std::unique_ptr<Tracer> tracer;
    std::optional<BvhQuality> tree; ///< empty where rays test all facets
};

/// Makes a tracer, which the mesh must outlive. `tree` is that of Needs; so many `threads` build
/// it, 0 being one per core.
[[nodiscard]] MadeTracer make_tracer(const Mesh& mesh, bool tree, unsigned threads = 0);

} // namespace hemilux
