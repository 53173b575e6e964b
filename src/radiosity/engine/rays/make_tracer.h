#pragma once
// Makes the tracer that suits a scene.

#include "bvh/quality.h"
#include "bvh/tracer.h"

#include <memory>
#include <optional>

namespace hemilux {

class Mesh;

/// The number of triangles that lie so near to each other that no tree can separate them: a ray
/// tests all.
struct Crowd {
    std::size_t triangles = 0; ///< number around the centre of a facet, in the mean over facets
    std::uint32_t facet = 0;   ///< facet with most around it
};

struct MadeTracer {
    std::unique_ptr<Tracer> tracer;
    std::optional<BvhQuality> tree; ///< empty where rays test all facets
    Crowd crowd;                    ///< crowd in the tree
};

/// Makes a tracer, which the mesh must outlive. It lets light through the panes of the scene.
/// `tree` is that of Needs. So many `threads` build it; 0 means one per core.
[[nodiscard]] MadeTracer make_tracer(const Mesh& mesh, bool tree, unsigned threads = 0);

} // namespace hemilux
