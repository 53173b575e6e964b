#include "radiosity/ray_counts.h"

#include "radiosity/mesh.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"
#include "radiosity/sobol.h"
#include "radiosity/solver.h"

#include <algorithm>
#include <atomic>

namespace hemilux {
namespace {

constexpr std::size_t rows_per_chunk = 16;

} // namespace

RayCounts::RayCounts(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed)
    : mesh_(mesh), tracer_(tracer), seed_(seed), rows_(mesh.patches().size()) {}

std::uint64_t RayCounts::trace_up_to(std::span<const std::uint32_t> rays, const Workers& workers,
                                     Monitor& monitor) {
    std::atomic<std::uint64_t> traced{0};
    workers.for_chunks(rows_.size(), rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        Scratch scratch;
        std::uint64_t count = 0;
        for (std::size_t i = begin; i < end && !monitor.interrupted; ++i) {
            if (rays[i] <= rows_[i].rays)
                continue;
            count += rays[i] - rows_[i].rays;
            trace_row(static_cast<std::uint32_t>(i), rays[i], scratch);
        }
        traced += count;
        monitor.rays += count;
    });
    return traced;
}

void RayCounts::trace_row(std::uint32_t patch, std::uint32_t end, Scratch& scratch) {
    const Patch& from = mesh_.patches()[patch];
    const Frame frame = mesh_.hemisphere_frame(patch);
    const std::uint64_t seed = hash_words({seed_, patch});
    Row& row = rows_[patch];
    auto& [rays, struck] = scratch;
    rays.clear();
    struck.clear();
    for (std::uint32_t k = row.rays; k < end; ++k) {
        // Of the four dimensions the first two are the best distributed.
        const auto u = sobol4(k, seed);
        Ray ray{from.shape.sample({u[2], u[3]}), frame.to_world(cosine_direction({u[0], u[1]}))};
        ray.from = from.facet;
        rays.push_back(ray);
    }
    find_receivers(rays, mesh_, tracer_, struck);
    row.escaped += static_cast<std::uint32_t>(std::ranges::count(struck, hemilux::escaped));
    row.absorbed += static_cast<std::uint32_t>(std::ranges::count(struck, hemilux::absorbed));
    std::erase_if(struck, [](std::uint32_t patch_struck) {
        return patch_struck == hemilux::escaped || patch_struck == hemilux::absorbed;
    });
    row.add(struck);
    row.rays = end;
}

void RayCounts::Row::add(std::vector<std::uint32_t>& struck) {
    std::ranges::sort(struck);
    std::vector<Count> merged;
    merged.reserve(counts.size() + struck.size());
    auto old = counts.begin();
    for (auto next = struck.begin(); next != struck.end();) {
        const std::uint32_t patch = *next;
        const auto end = std::find_if(next, struck.end(), [&](auto p) { return p != patch; });
        auto hits = static_cast<std::uint32_t>(end - next);
        next = end;
        for (; old != counts.end() && old->patch < patch; ++old)
            merged.push_back(*old);
        if (old != counts.end() && old->patch == patch)
            hits += (old++)->hits;
        merged.push_back({patch, hits});
    }
    merged.insert(merged.end(), old, counts.end());
    merged.shrink_to_fit();
    counts = std::move(merged);
}

std::uint64_t RayCounts::bytes() const {
    std::uint64_t bytes = rows_.size() * sizeof(Row);
    for (const Row& row : rows_)
        bytes += row.counts.capacity() * sizeof(Count);
    return bytes;
}

} // namespace hemilux
