#pragma once
// The loop in which shadow rays are sampled for many patches, whatever the lights are.

#include "parallel/ranks.h"
#include "parallel/workers.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/solving/solver.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace hemilux {

/// Calls sample(patch, batch) for each own patch until a signal, in several threads with a batch
/// each, and send(batch) after a few patches. Rays are those in `batch.traced`; returns those of
/// all ranks. What the ranks found is not gathered.
template <class Batch, class Sample, class Send>
std::uint64_t sample_patches(const OwnBlocks& own, const Workers& workers, Monitor& monitor,
                             const Sample& sample, const Send& send) {
    constexpr std::size_t patches_per_chunk = 8;
    std::atomic<std::uint64_t> traced{0};
    std::optional<OnThisRank> on_this_rank(monitor.interrupted);
    workers.for_chunks_with(
        own.count(), patches_per_chunk, [] { return Batch(); },
        [&](Batch& batch, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end && !monitor.interrupted; ++k)
                sample(static_cast<std::uint32_t>(own.item(k)), batch);
            send(batch);
            traced += batch.traced;
            monitor.rays += std::exchange(batch.traced, 0);
        });
    on_this_rank.reset();
    agree(monitor.interrupted);
    own.ranks().add_work(traced, 0);
    return own.ranks().sum(traced);
}

} // namespace hemilux
