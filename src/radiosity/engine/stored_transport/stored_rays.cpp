#include "radiosity/engine/stored_transport/stored_rays.h"

#include "radiosity/engine/emitters/small_emitters.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/engine/stored_transport/linked_parts.h"
#include "radiosity/engine/stored_transport/transport_system.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <utility>

namespace hemilux {

StoredRays::StoredRays(const SolverInput& input)
    : input_(input), emitters_(small_emitters(input.mesh)) {
    renew(0);
}

void StoredRays::renew(std::uint64_t generation) {
    counts_.clear();
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t s = 0; s < batches; ++s) {
        const std::uint64_t seed = hash_words({input_.options.seed, s, generation});
        counts_.emplace_back(input_.mesh, input_.tracer, hash_words({seed, 0}),
                             ranks_of(input_.monitor.interrupted));
        seeds.push_back(hash_words({seed, 1}));
    }
    direct_.emplace(input_.mesh, input_.tracer, input_.needs, emitters_, std::move(seeds),
                    ranks_of(input_.monitor.interrupted));
}

std::uint64_t StoredRays::trace_up_to(const PlannedRays& rays, double share,
                                      const Workers& workers) {
    const std::uint64_t at_random =
        RayCounts::trace_up_to(counts_, rays.random, workers, input_.monitor, share);
    return at_random + direct_->sample_up_to(rays.to_emitters, workers, input_.monitor);
}

ExchangeMatrix StoredRays::factors(std::span<const double> area, const Workers& workers) const {
    std::vector<ExchangeMatrix> parts(batches);
    for_batches(batches, ranks_of(input_.monitor.interrupted), workers,
                [&](std::size_t batch, const Workers& own) {
                    parts[batch] = ExchangeMatrix(area, counts_[batch], own);
                });
    return {std::move(parts), workers};
}

std::vector<bool> StoredRays::lit_patches(std::span<const Vec3> emission) const {
    const LinkedParts parts = find_linked_parts(counts_);
    std::vector<bool> lit_part(parts.count), lit;
    for (std::uint32_t i = 0; i < parts.of.size(); ++i)
        if (emission[i] != Vec3(0.0) || direct_->hits(i) > 0)
            lit_part[parts.of[i]] = true;
    for (const std::uint32_t part : parts.of)
        lit.push_back(lit_part[part]);
    return lit;
}

std::uint64_t StoredRays::bytes_of_counts() const {
    std::uint64_t sum = 0;
    for (const RayCounts& batch : counts_)
        sum += batch.bytes();
    return sum;
}

std::uint64_t StoredRays::bytes_of_hits() const {
    std::uint64_t sum = 0;
    for (const RayCounts& batch : counts_)
        sum += batch.bytes_of_hits();
    return sum;
}

void StoredRays::save(StateWriter& state) const {
    for (const RayCounts& batch : counts_)
        batch.save(state);
    direct_->save(state);
}

void StoredRays::load(StateReader& state) {
    for (RayCounts& batch : counts_)
        batch.load(state);
    direct_->load(state);
}

} // namespace hemilux
