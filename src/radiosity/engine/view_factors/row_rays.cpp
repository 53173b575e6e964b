#include "radiosity/engine/view_factors/row_rays.h"

#include "radiosity/engine/pair_factors/convex_part.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/view_factors/sky_bands.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// A height over a plane that counts as in it, in the unit of a scene in [-1,1]^3.
constexpr double height_of_backs = 1e-9;

/// Returns whether the back of a facet faces a patch, seen or hidden.
bool shows_its_back(const Polygon& shape, const Patch& to) {
    if (std::ranges::none_of(shape.corner, [&to](const Vec3& corner) {
            return glm::dot(to.normal, corner - to.shape.corner[0]) > height_of_backs;
        }))
        return false;
    const Vec3 front = shape.area_vector();
    const double level = -height_of_backs * glm::length(front);
    return std::ranges::any_of(to.shape.corner, [&](const Vec3& corner) {
        return glm::dot(front, corner - shape.corner[0]) < level;
    });
}

} // namespace

RowRays::RowRays(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed, int up,
                 const SkyBands* bands)
    : mesh_(mesh), tracer_(tracer), seed_(seed), up_(up), bands_(bands) {
    for (const Patch& patch : mesh.patches())
        room_.include(box_of(patch.shape.corner));
}

/// Returns whether the back of a one-sided facet faces a patch. Most patches are faced by the one
/// that faced the last, and nothing rises above the highest roofs, so few look at all facets.
bool RowRays::may_see_backs(const Patch& patch) {
    const Vec3 half = .5 * room_.extent();
    const Plane plane{patch.shape.corner[0], patch.normal};
    if (plane.height(room_.centre()) + glm::dot(half, glm::abs(patch.normal)) <= height_of_backs)
        return false;
    const auto facets = static_cast<std::uint32_t>(mesh_.scene().facets.size());
    for (std::uint32_t k = 0; k < facets; ++k) {
        const std::uint32_t facet = (last_back_ + k) % facets;
        if (!mesh_.has_back(facet) && shows_its_back(mesh_.shape_of(facet), patch)) {
            last_back_ = facet;
            return true;
        }
    }
    return false;
}

void RowRays::trace(std::uint32_t patch, std::uint32_t rays, RowView& view) {
    const auto start = PatchStart::in_any_axes(mesh_, patch);
    const std::uint32_t of_batch = rays / batches;
    std::array<std::array<std::uint32_t, batches>, opens> counts{};
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
    for (std::size_t open = 0; open < opens; ++open)
        view.open[open] = share_of_blocks(counts[open], of_batch);
    constexpr double level = 1 - 1e-12;
    const double rise = start.frame.z[up_];
    if (std::abs(rise) >= level)
        view.open[static_cast<std::size_t>(rise > 0 ? Open::ground : Open::sky)] = {};
    OpenShare& back = view.open[static_cast<std::size_t>(Open::back)];
    if (!(back.factor > 0) && !may_see_backs(mesh_.patches()[patch]))
        back = {};
    view.bands = shares_of(band_counts_, rays);
}

} // namespace hemilux
