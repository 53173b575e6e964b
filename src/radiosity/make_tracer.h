#pragma once
// The tracer that suits a scene.

#include "bvh/bvh.h"
#include "radiosity/needs.h"

#include <memory>
#include <optional>

namespace hemilux {

struct MadeTracer {
    std::unique_ptr<Tracer> tracer;
    std::optional<BvhQuality> tree; ///< empty where rays test all facets
};

/// The mesh must outlive it.
[[nodiscard]] MadeTracer make_tracer(const Mesh& mesh, const Needs& needs);

} // namespace hemilux
