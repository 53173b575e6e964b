#pragma once
// Makes the tracer that suits a scene.

#include "bvh/quality.h"
#include "bvh/tracer.h"

#include <memory>

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
    BvhQuality tree;
    Crowd crowd; ///< crowd in the tree
};

/// Makes a tracer, which the mesh must outlive. It lets light through the panes of the scene.
/// So many `threads` build its tree; 0 means one per core.
[[nodiscard]] MadeTracer make_tracer(const Mesh& mesh, unsigned threads = 0);

} // namespace hemilux
