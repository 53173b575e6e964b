#include "radiosity/engine/view_factors/row_rays.h"

#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/view_factors/sky_bands.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Returns whether the back of a one-sided facet faces a patch, seen or hidden.
bool may_see_backs(const Mesh& mesh, std::uint32_t patch) {
    constexpr double rounding = 1e-9;
    const Patch& from = mesh.patches()[patch];
    for (std::uint32_t facet = 0; facet < mesh.scene().facets.size(); ++facet) {
        if (mesh.has_back(facet))
            continue;
        const Polygon shape = mesh.shape_of(facet);
        const Vec3 front = shape.area_vector();
        const double level = -rounding * glm::length(front);
        const bool is_behind = std::ranges::any_of(from.shape.corner, [&](const Vec3& corner) {
            return glm::dot(front, corner - shape.corner[0]) < level;
        });
        if (is_behind && std::ranges::any_of(shape.corner, [&from](const Vec3& corner) {
                return glm::dot(from.normal, corner - from.shape.corner[0]) > rounding;
            }))
            return true;
    }
    return false;
}

} // namespace

void RowRays::trace(std::uint32_t patch, std::uint32_t rays, RowView& view) {
    const auto start = PatchStart::in_any_axes(mesh_, patch);
    const std::uint32_t of_batch = rays / batches;
    std::array<std::array<double, batches>, opens> counts{};
    hit_.clear();
    band_counts_.assign(bands_ ? bands_->size() : 0, 0);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        SobolBlocks<4> points(hash_words({seed_, patch, batch}));
        rays_.clear();
        for (std::uint32_t k = 0; k < of_batch; ++k) {
            const std::array<double, 4> u = points.at(k);
            rays_.push_back(start.ray({u[2], u[3]}, cosine_direction({u[0], u[1]})));
        }
        receivers_.clear();
        find_receivers(rays_, mesh_, tracer_, receivers_);
        for (std::size_t k = 0; k < receivers_.size(); ++k) {
            const auto count = [&](Open open) { ++counts[static_cast<std::size_t>(open)][batch]; };
            if (receivers_[k] == escaped) {
                const bool is_up = rays_[k].direction[up_] > 0;
                count(is_up ? Open::sky : Open::ground);
                if (is_up && bands_)
                    ++band_counts_[bands_->of(rays_[k].direction)];
            } else if (receivers_[k] == absorbed)
                count(Open::back);
            else if (receivers_[k] != patch)
                hit_.push_back(receivers_[k]);
        }
    }
    std::ranges::sort(hit_);
    view.seen.clear();
    for (const std::uint32_t hit : hit_)
        if (view.seen.empty() || view.seen.back().patch != hit)
            view.seen.push_back({hit, 1});
        else
            ++view.seen.back().rays;
    for (std::size_t open = 0; open < opens; ++open) {
        double sum = 0, squares = 0;
        for (const double count : counts[open])
            sum += count;
        for (const double count : counts[open])
            squares += (count - sum / batches) * (count - sum / batches);
        // The variance of Student's distribution with so many degrees of freedom.
        constexpr double freedom = batches - 1, spread = freedom / (freedom - 2);
        const double variance = spread * squares / (batches * freedom * of_batch * of_batch);
        const double share = sum / rays;
        // Where all batches agree, half a ray may be elsewhere.
        const double least = (sum > 0 && sum < rays ? .5 : 1.5) / rays;
        view.open[open] = {share, std::max(std::sqrt(variance), least)};
    }
    constexpr double level = 1 - 1e-12;
    const double rise = start.frame.z[up_];
    if (std::abs(rise) >= level)
        view.open[static_cast<std::size_t>(rise > 0 ? Open::ground : Open::sky)] = {};
    OpenShare& back = view.open[static_cast<std::size_t>(Open::back)];
    if (!(back.factor > 0) && !may_see_backs(mesh_, patch))
        back = {};
    view.bands = shares_of(band_counts_, rays);
}

} // namespace hemilux
