#include "radiosity/make_tracer.h"

#include "bvh/brute_force.h"
#include "bvh/wide_bvh.h"
#include "radiosity/mesh.h"

namespace hemilux {

MadeTracer make_tracer(const Mesh& mesh, const Needs& needs, unsigned threads) {
    if (!needs.tree)
        return {std::make_unique<BruteForce>(mesh.soup()), std::nullopt};
    auto bvh = std::make_unique<WideBvh>(mesh.soup(), WideBvhOptions{.threads = threads});
    const BvhQuality quality = bvh->quality();
    return {std::move(bvh), quality};
}

} // namespace hemilux
