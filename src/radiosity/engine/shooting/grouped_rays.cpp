#include "radiosity/engine/shooting/grouped_rays.h"

#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {

GroupedRays::GroupedRays(const RaySource& source, std::span<RayGroup> groups, std::uint64_t stream,
                         std::vector<Ray>& memory)
    : source_(source), groups_(groups), stream_(stream), rays_(memory),
      private_(source.strategy.private_cells()) {
    rays_.resize(DirectionBatch::room);
    runs_.reserve(DirectionBatch::room);
}

std::span<const Ray> GroupedRays::next() {
    list();
    source_.directions.draw(batch_);
    std::size_t first = 0;
    for (const Run& run : runs_) {
        fill(run, first);
        first += run.rays;
    }
    return std::span(rays_).first(first);
}

/// Lists as many rays as there is room for.
void GroupedRays::list() {
    runs_.clear();
    own_.clear();
    batch_.size = 0;
    while (!batch_.full() && !groups_.empty()) {
        RayGroup& group = groups_.front();
        const auto rays = static_cast<std::uint32_t>(
            std::min<std::size_t>(group.rays - drawn_, DirectionBatch::room - batch_.size));
        list_group(group, rays);
        drawn_ += rays;
        if (drawn_ < group.rays)
            break;
        groups_ = groups_.subspan(1);
        drawn_ = 0;
    }
}

void GroupedRays::list_group(RayGroup& group, std::uint32_t rays) {
    if (listed_ != group.patch) {
        listed_ = group.patch;
        key_ = hash_words({stream_, group.patch});
    }
    if (private_)
        if (auto own = private_->private_cell(group.patch, group.cell))
            return list_private(group, rays, *own);
    add_to_batch(group, rays, group.cell, source_.directions.power_share(group.cell));
    if (!runs_.empty() && runs_.back().patch == group.patch && runs_.back().own == none)
        runs_.back().rays += rays;
    else
        runs_.push_back({group.patch, rays, none});
}

/// The directions of a private cell are drawn elsewhere (fill_private).
void GroupedRays::list_private(RayGroup& group, std::uint32_t rays, const PrivateCell& own) {
    add_to_batch(group, rays, whole_hemisphere, own.power);
    runs_.push_back({group.patch, rays, static_cast<std::uint32_t>(own_.size())});
    own_.push_back({own, group.cell_first});
}

void GroupedRays::add_to_batch(RayGroup& group, std::uint32_t rays, std::uint16_t cell,
                               double power) {
    if (drawn_ == 0)
        group.ray_power *= power;
    for (std::uint32_t k = 0; k < rays; ++k)
        batch_.add(key_, group.first + drawn_ + k, cell);
}

const PatchStart& GroupedRays::start_of(std::uint32_t patch) {
    if (!start_ || start_->patch != patch)
        start_.emplace(source_.mesh, patch,
                       source_.mesh.hemisphere_frame(patch, source_.turns[patch]));
    return *start_;
}

void GroupedRays::fill(const Run& run, std::size_t first) {
    const PatchStart& start = start_of(run.patch);
    const std::span<Ray> rays = std::span(rays_).subspan(first, run.rays);
    if (run.own != none)
        return fill_private(own_[run.own], start, first, rays);
    const PolygonSampler points = start.points; // copies, as rays might be written to theirs
    const Frame frame = start.frame;
    for (std::size_t k = first; Ray & ray : rays) {
        ray.from = start.facet;
        ray.origin = points.sample({batch_.u[k], batch_.v[k]});
        ray.direction = frame.to_world({batch_.x[k], batch_.y[k], batch_.z[k]});
        ++k;
    }
    if (source_.origins == RayOrigins::centre)
        for (std::size_t k = first; Ray & ray : rays)
            if (batch_.cell[k++] != whole_hemisphere)
                ray.origin = source_.mesh.patches()[run.patch].centre;
}

void GroupedRays::fill_private(const OwnCell& own, const PatchStart& start, std::size_t first,
                               std::span<Ray> rays) {
    const PrivateCell& cell = own.cell;
    const PolygonSampler part(cell.origins);
    for (std::size_t k = first; Ray & ray : rays) {
        Rng rng(hash_words({batch_.key_low[k], batch_.key_high[k], batch_.number[k]}));
        ray.from = start.facet;
        ray.origin = source_.origins == RayOrigins::centre
                         ? cell.origins.centre()
                         : part.sample({batch_.u[k], batch_.v[k]});
        const std::uint32_t of_cell = batch_.number[k] - own.first;
        ray.direction = start.frame.to_world(
            of_cell < cell.given ? cell.direction[of_cell]
                                 : cell.shape.sample_rejection([&] { return rng.uniform(); }));
        ++k;
    }
}

} // namespace hemilux
