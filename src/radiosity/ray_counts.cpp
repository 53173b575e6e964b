#include "radiosity/ray_counts.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/mesh.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"
#include "radiosity/sobol.h"
#include "radiosity/solver.h"
#include "radiosity/state.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace hemilux {
namespace {

constexpr std::size_t rows_per_chunk = 16;

/// A row with more of them is traced in parts.
constexpr std::uint32_t rays_in_burst = 1u << 14;

/// Some of a block's rays. Of the four dimensions the first two are the best distributed.
void draw(const Patch& from, const PolygonSampler& origins, const Frame& frame,
          const SobolBlocks<4>& points, std::size_t first, std::size_t count,
          std::vector<Ray>& rays) {
    std::array<double, samples_per_block> x, y, z;
    sampling_kernels().cosine(samples_per_block, points.coordinate(0), points.coordinate(1),
                              x.data(), y.data(), z.data());
    for (std::size_t k = first; k < first + count; ++k) {
        const Vec2 u(points.coordinate(2)[k], points.coordinate(3)[k]);
        rays.push_back({origins.sample(u), frame.to_world({x[k], y[k], z[k]})});
        rays.back().from = from.facet;
    }
}

} // namespace

RayCounts::RayCounts(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed)
    : mesh_(mesh), tracer_(tracer), seed_(seed), rows_(mesh.patches().size()) {}

/// Rays of some rows that are not traced yet.
struct RayCounts::Volley {
    struct Burst {
        std::uint32_t patch, rays;
    };
    std::vector<Burst> bursts;
    std::vector<Ray> rays;
    std::vector<std::uint32_t> receivers, struck;
    std::uint64_t traced = 0;
};

std::uint64_t RayCounts::trace_up_to(std::span<const std::uint32_t> rays, const Workers& workers,
                                     Monitor& monitor) {
    std::atomic<std::uint64_t> traced{0};
    workers.for_chunks(rows_.size(), rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        Volley volley;
        for (std::size_t i = begin; i < end && !monitor.interrupted; ++i)
            if (rays[i] > rows_[i].rays)
                draw_row(static_cast<std::uint32_t>(i), rays[i], volley);
        trace(volley);
        traced += volley.traced;
        monitor.rays += volley.traced;
    });
    return traced;
}

void RayCounts::draw_row(std::uint32_t patch, std::uint32_t end, Volley& volley) {
    const Patch& from = mesh_.patches()[patch];
    const PolygonSampler origins(from.shape);
    const Frame frame = mesh_.hemisphere_frame(patch);
    SobolBlocks<4> points(hash_words({seed_, patch}));
    while (rows_[patch].rays < end) {
        const std::uint32_t first = rows_[patch].rays;
        const std::uint32_t last = first + std::min(end - first, rays_in_burst);
        for (std::uint32_t k = first; k < last;) {
            const std::size_t in_block = k % samples_per_block;
            const auto count = std::min<std::size_t>(samples_per_block - in_block, last - k);
            points.move_to(k);
            draw(from, origins, frame, points, in_block, count, volley.rays);
            k += static_cast<std::uint32_t>(count);
        }
        volley.bursts.push_back({patch, last - first});
        rows_[patch].rays = last;
        if (volley.rays.size() >= rays_at_a_time)
            trace(volley);
    }
}

void RayCounts::trace(Volley& volley) {
    volley.receivers.clear();
    find_receivers(volley.rays, mesh_, tracer_, volley.receivers);
    auto next = volley.receivers.cbegin();
    for (const auto& [patch, rays] : volley.bursts) {
        volley.struck.clear();
        for (const auto end = next + rays; next != end; ++next) {
            if (*next == hemilux::escaped)
                ++rows_[patch].escaped;
            else if (*next == hemilux::absorbed)
                ++rows_[patch].absorbed;
            else
                volley.struck.push_back(*next);
        }
        rows_[patch].add(volley.struck);
    }
    volley.traced += volley.rays.size();
    volley.rays.clear();
    volley.bursts.clear();
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

void RayCounts::save(StateWriter& state) const {
    for (const Row& row : rows_) {
        for (const std::uint32_t rays : {row.rays, row.escaped, row.absorbed})
            state.add(rays);
        state.add(std::uint64_t{row.counts.size()});
        for (const Count& count : row.counts) {
            state.add(count.patch);
            state.add(count.hits);
        }
    }
}

void RayCounts::load(StateReader& state) {
    for (Row& row : rows_) {
        for (std::uint32_t* rays : {&row.rays, &row.escaped, &row.absorbed})
            state.get(*rays);
        row.counts.resize(state.count(sizeof(Count)));
        for (Count& count : row.counts) {
            state.get(count.patch);
            state.get(count.hits);
        }
        if (!row.adds_up(rows_.size()))
            throw StateError("rays of a patch do not add up");
    }
}

/// Every ray was struck by something, once, and receivers stand in their order.
bool RayCounts::Row::adds_up(std::size_t patches) const {
    std::uint64_t sum = std::uint64_t{escaped} + absorbed, next = 0;
    for (const Count& count : counts) {
        if (count.patch < next || count.patch >= patches || count.hits == 0)
            return false;
        next = std::uint64_t{count.patch} + 1;
        sum += count.hits;
    }
    return sum == rays;
}

std::uint64_t RayCounts::bytes() const {
    std::uint64_t bytes = rows_.size() * sizeof(Row);
    for (const Row& row : rows_)
        bytes += row.counts.capacity() * sizeof(Count);
    return bytes;
}

} // namespace hemilux
