#include "radiosity/burst_rays.h"

#include "radiosity/mesh.h"
#include "radiosity/receivers.h"
#include "radiosity/shot.h"

#include <algorithm>

namespace hemilux {

BurstRays::BurstRays(const RaySource& source, std::span<Burst> bursts, std::uint64_t seed,
                     std::vector<Ray>& memory)
    : source_(source), bursts_(bursts), seed_(seed), rays_(memory) {
    rays_.resize(rays_at_a_time);
}

std::span<const Ray> BurstRays::next() {
    std::size_t count = 0;
    while (count < rays_at_a_time && !bursts_.empty()) {
        Burst& burst = bursts_.front();
        if (drawn_ == 0)
            begin(burst);
        const auto n = static_cast<std::uint32_t>(
            std::min<std::size_t>(burst.rays - drawn_, rays_at_a_time - count));
        draw(std::span(rays_).subspan(count, n));
        count += n;
        drawn_ += n;
        if (drawn_ < burst.rays)
            break;
        bursts_ = bursts_.subspan(1);
        drawn_ = 0;
    }
    return std::span(rays_).first(count);
}

/// As printed, rays into triangles leave from the centre; those of plain Monte Carlo do not.
void BurstRays::begin(Burst& burst) {
    const Patch& patch = source_.mesh.patches()[burst.patch];
    if (!from_ || from_->patch != burst.patch)
        from_ = {burst.patch, PolygonSampler(patch.shape),
                 source_.mesh.hemisphere_frame(burst.patch), Rng(hash_words({seed_, burst.patch}))};
    aim_ = {};
    if (const auto own = source_.strategy.private_cell(burst.patch, burst.cell)) {
        burst.ray_power *= own->power;
        aim_.part.emplace(own->origins);
        aim_.own = own->shape;
        aim_.triangle = &*aim_.own;
        if (source_.literal)
            aim_.centre = own->origins.centre();
        return;
    }
    burst.ray_power *= power_share(source_.hemisphere, burst.cell, source_.literal);
    if (burst.cell != whole_hemisphere) {
        aim_.triangle = &source_.hemisphere.cells()[burst.cell].shape;
        if (source_.literal)
            aim_.centre = patch.centre;
    }
}

void BurstRays::draw(std::span<Ray> rays) {
    Rng& rng = from_->rng;
    const PolygonSampler& origins = aim_.part ? *aim_.part : from_->shape;
    for (Ray& ray : rays) {
        ray.from = source_.mesh.patches()[from_->patch].facet;
        ray.origin = aim_.centre ? *aim_.centre : sample_uniform(origins, rng);
        ray.direction = from_->frame.to_world(
            aim_.triangle ? aim_.triangle->sample_rejection([&] { return rng.uniform(); })
                          : sample_cosine(rng));
    }
}

} // namespace hemilux
