#include "radiosity/burst_rays.h"

#include "radiosity/mesh.h"
#include "radiosity/rng.h"

#include <algorithm>

namespace hemilux {

BurstRays::BurstRays(const RaySource& source, std::span<Burst> bursts, std::uint64_t stream,
                     std::vector<Ray>& memory)
    : source_(source), bursts_(bursts), stream_(stream), rays_(memory) {
    rays_.resize(DirectionBatch::room);
}

std::span<const Ray> BurstRays::next() {
    list();
    source_.directions.draw(batch_);
    std::size_t first = 0;
    for (const Run& run : runs_) {
        fill(run, first);
        first += run.rays;
    }
    return std::span(rays_).first(first);
}

/// As many as there is room for.
void BurstRays::list() {
    runs_.clear();
    own_.clear();
    batch_.size = 0;
    while (!batch_.full() && !bursts_.empty()) {
        Burst& burst = bursts_.front();
        const auto rays = static_cast<std::uint32_t>(
            std::min<std::size_t>(burst.rays - drawn_, DirectionBatch::room - batch_.size));
        list(burst, rays);
        drawn_ += rays;
        if (drawn_ < burst.rays)
            break;
        bursts_ = bursts_.subspan(1);
        drawn_ = 0;
    }
}

void BurstRays::list(Burst& burst, std::uint32_t rays) {
    if (listed_ != burst.patch) {
        listed_ = burst.patch;
        key_ = hash_words({stream_, burst.patch});
    }
    auto own = source_.strategy.private_cell(burst.patch, burst.cell);
    if (drawn_ == 0)
        burst.ray_power *= own ? own->power : source_.directions.power_share(burst.cell);
    for (std::uint32_t k = 0; k < rays; ++k)
        batch_.add(key_, burst.first + drawn_ + k, own ? whole_hemisphere : burst.cell);
    runs_.push_back({burst.patch, rays, burst.cell, none});
    if (own) {
        runs_.back().own = static_cast<std::uint32_t>(own_.size());
        own_.push_back(std::move(*own));
    }
}

/// As printed, rays into triangles leave from the centre; those of plain Monte Carlo do not.
void BurstRays::fill(const Run& run, std::size_t first) {
    const PatchStart& start = source_.starts.of(run.patch, start_);
    const std::span<Ray> rays = std::span(rays_).subspan(first, run.rays);
    if (run.own != none)
        return fill_private(own_[run.own], start, first, rays);
    const bool from_centre = source_.literal && run.cell != whole_hemisphere;
    for (std::size_t k = first; Ray & ray : rays) {
        ray.from = start.facet;
        ray.origin = from_centre ? source_.mesh.patches()[run.patch].centre
                                 : start.points.sample({batch_.u[k], batch_.v[k]});
        ray.direction = start.frame.to_world({batch_.x[k], batch_.y[k], batch_.z[k]});
        ++k;
    }
}

void BurstRays::fill_private(const PrivateCell& cell, const PatchStart& start, std::size_t first,
                             std::span<Ray> rays) {
    const PolygonSampler part(cell.origins);
    for (std::size_t k = first; Ray & ray : rays) {
        Rng rng(hash_words({batch_.key_low[k], batch_.key_high[k], batch_.number[k]}));
        ray.from = start.facet;
        ray.origin =
            source_.literal ? cell.origins.centre() : part.sample({batch_.u[k], batch_.v[k]});
        ray.direction =
            start.frame.to_world(cell.shape.sample_rejection([&] { return rng.uniform(); }));
        ++k;
    }
}

} // namespace hemilux
