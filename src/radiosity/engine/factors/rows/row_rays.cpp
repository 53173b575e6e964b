#include "radiosity/engine/factors/rows/row_rays.h"

#include "radiosity/engine/factors/rows/rows_done.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

void RowRays::trace(std::uint32_t patch, std::uint32_t rays, RowView& view) {
    const auto start = PatchStart::in_any_axes(scene_.mesh, patch);
    const std::uint32_t of_batch = rays / batches;
    std::array<std::array<std::uint32_t, batches>, opens> counts{};
    hit_.clear();
    band_counts_.assign(scene_.bands ? scene_.bands->size() : 0, 0);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        SobolBlocks<4> points(hash_words({scene_.seed, patch, batch}));
        rays_.clear();
        for (std::uint32_t k = 0; k < of_batch; ++k) {
            const std::array<double, 4> u = points.at(k);
            rays_.push_back(start.ray({u[2], u[3]}, cosine_direction({u[0], u[1]})));
        }
        receivers_.clear();
        find_receivers(rays_, scene_.mesh, scene_.tracer, receivers_);
        for (std::size_t k = 0; k < receivers_.size(); ++k) {
            const auto count = [&](Open open) { ++counts[static_cast<std::size_t>(open)][batch]; };
            if (receivers_[k] == escaped) {
                const bool is_up = rays_[k].direction[scene_.up] > 0;
                count(is_up ? Open::sky : Open::ground);
                if (is_up && scene_.bands)
                    ++band_counts_[scene_.bands->of(rays_[k].direction)];
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
    const double rise = start.frame.z[scene_.up];
    if (std::abs(rise) >= level)
        view.open[static_cast<std::size_t>(rise > 0 ? Open::ground : Open::sky)] = {};
    OpenShare& back = view.open[static_cast<std::size_t>(Open::back)];
    if (!(back.factor > 0) && !scene_.backs.face(scene_.mesh.patches()[patch], last_))
        back = {};
    view.bands = shares_of(band_counts_, rays);
}

bool trace_all_rows(const RowScene& scene, std::uint32_t rays, const char* phase,
                    const Workers& workers, Monitor& monitor,
                    const std::function<void(std::uint32_t patch, const RowView& view)>& keep) {
    const std::size_t patches = scene.mesh.patches().size();
    RowsDone done(monitor, phase, patches);
    workers.for_chunks_with(
        patches, 16, [&] { return RowRays(scene); },
        [&](RowRays& row, std::size_t begin, std::size_t end) {
            RowView view;
            for (std::size_t i = begin; i < end && !monitor.interrupted.is_wished(); ++i) {
                row.trace(static_cast<std::uint32_t>(i), rays, view);
                keep(static_cast<std::uint32_t>(i), view);
            }
            monitor.rays += (end - begin) * rays;
            done.add(end - begin);
        });
    return !monitor.interrupted.is_wished();
}

} // namespace hemilux
