#include "radiosity/make_tracer.h"

#include "bvh/wide_bvh.h"
#include "radiosity/mesh.h"

namespace hemilux {

MadeTracer make_tracer(const Mesh& mesh, const Needs& needs, unsigned threads) {
    auto tracer = std::make_unique<WideBvh>(
        mesh.soup(), WideBvhOptions{.threads = threads, .hierarchy = needs.tree});
    const auto quality = needs.tree ? std::optional(tracer->quality()) : std::nullopt;
    return {std::move(tracer), quality};
}

} // namespace hemilux
