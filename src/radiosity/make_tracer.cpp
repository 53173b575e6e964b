#include "radiosity/make_tracer.h"

#include "bvh/brute_force.h"
#include "radiosity/mesh.h"

namespace hemilux {

MadeTracer make_tracer(const Mesh& mesh, const Needs& needs) {
    if (!needs.tree)
        return {std::make_unique<BruteForce>(mesh.soup()), std::nullopt};
    auto bvh = std::make_unique<Bvh>(mesh.soup(), BvhOptions{.quads = needs.quads});
    const BvhQuality quality = bvh->quality();
    return {std::move(bvh), quality};
}

} // namespace hemilux
