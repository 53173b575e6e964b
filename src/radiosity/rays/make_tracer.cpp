#include "radiosity/rays/make_tracer.h"

#include "bvh/wide/wide_bvh.h"
#include "radiosity/scene/mesh.h"

namespace hemilux {

MadeTracer make_tracer(const Mesh& mesh, bool tree, unsigned threads) {
    auto tracer = std::make_unique<WideBvh>(mesh.soup_to_trace(),
                                            WideBvhOptions{.threads = threads, .hierarchy = tree});
    const auto quality = tree ? std::optional(tracer->quality()) : std::nullopt;
    return {std::move(tracer), quality};
}

} // namespace hemilux
