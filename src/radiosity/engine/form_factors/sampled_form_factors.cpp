#include "radiosity/engine/form_factors/sampled_form_factors.h"

#include "radiosity/engine/factors/pairs/point_to_patch.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

constexpr std::size_t rows_per_chunk = 16;

} // namespace

SampledFormFactors::SampledFormFactors(const Mesh& mesh, const Tracer& tracer,
                                       std::vector<std::uint32_t> emitters, std::uint64_t seed,
                                       const Needs& needs)
    : mesh_(mesh), tracer_(tracer), emitters_(std::move(emitters)),
      is_emitter_(mesh.patches().size()), seed_(seed), needs_(needs), counts_(mesh, tracer, seed),
      lost_(mesh.patches().size()), emitter_sum_(mesh.patches().size() * emitters_.size()) {
    for (const std::uint32_t e : emitters_)
        is_emitter_[e] = true;
}

/// Returns the number of rays to each emitter. Together the emitters get as many rays as the
/// hemisphere, each at least one.
std::uint32_t SampledFormFactors::emitter_samples(std::uint32_t rays) const {
    if (emitters_.empty() || rays == 0)
        return 0;
    return std::max(1u, rays / static_cast<std::uint32_t>(emitters_.size()));
}

std::uint64_t SampledFormFactors::trace_up_to(std::uint32_t rays, const Workers& workers,
                                              Monitor& monitor) {
    const std::size_t patches = mesh_.patches().size();
    std::vector<std::uint32_t> wanted(patches);
    for (std::uint32_t i = 0; i < patches; ++i)
        wanted[i] = needs_.power(i) ? rays : 0;
    std::atomic<std::uint64_t> traced = counts_.trace_up_to(wanted, workers, monitor);
    workers.for_chunks(patches, rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t i = begin; i < end && !monitor.interrupted; ++i)
            if (wanted[i] > 0)
                count += trace_emitters(static_cast<std::uint32_t>(i), emitter_samples(rays_),
                                        emitter_samples(rays));
        traced += count;
        monitor.rays += count;
    });
    rays_ = rays;
    for (std::uint32_t i = 0; i < patches; ++i)
        lost_[i] = {counts_.escaped(i) / double(rays), counts_.absorbed(i) / double(rays)};
    return traced;
}

std::uint64_t SampledFormFactors::trace_emitters(std::uint32_t patch, std::uint32_t begin,
                                                 std::uint32_t end) {
    std::uint64_t rays = 0;
    for (std::size_t e = 0; e < emitters_.size(); ++e) {
        SobolBlocks<4> points(hash_words({seed_, patch, emitters_[e], 1}));
        const PairLook look(mesh_, tracer_, patch, emitters_[e], everywhere, needs_.visibility);
        double& sum = emitter_sum_[patch * emitters_.size() + e];
        for (std::uint32_t k = begin; k < end; ++k)
            sum += look.factor(points.at(k), rays);
    }
    return rays;
}

double SampledFormFactors::arriving_from(std::size_t emitter) const {
    const auto patches = mesh_.patches();
    double sum = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        sum += patches[i].area * emitter_sum_[i * emitters_.size() + emitter];
    return sum / emitter_samples(rays_) / patches[emitters_[emitter]].area;
}

bool SampledFormFactors::all_receive() const {
    for (std::uint32_t i = 0; i < mesh_.patches().size(); ++i)
        if (mesh_.material(i).reflectance + mesh_.material(i).emission == Vec3(0.0))
            return false;
    return true;
}

/// Returns c_ij + c_ji, by row and patch.
std::vector<std::vector<SampledFormFactors::PatchHits>> SampledFormFactors::merged_counts() const {
    const auto patches = static_cast<std::uint32_t>(mesh_.patches().size());
    const CountWords& words = counts_.words();
    std::vector<std::vector<PatchHits>> merged(patches);
    for (std::uint32_t i = 0; i < patches; ++i)
        for (const std::uint32_t word : counts_.row(i)) {
            const std::uint32_t j = words.column(word), hits = words.count(word);
            merged[i].push_back({j, hits});
            merged[j].push_back({i, hits});
        }
    for (auto& row : merged) {
        std::ranges::sort(row, {}, &PatchHits::patch);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (kept > 0 && row[kept - 1].patch == row[k].patch)
                row[kept - 1].hits += row[k].hits;
            else
                row[kept++] = row[k];
        }
        row.resize(kept);
    }
    return merged;
}

/// Returns F_ij for each hit by the rays of both, or of the one that shoots.
double SampledFormFactors::factor_per_hit(std::uint32_t i, std::uint32_t j) const {
    const double a_i = mesh_.patches()[i].area, a_j = mesh_.patches()[j].area, n = rays_;
    if (!needs_.power(j))
        return 1 / n;
    return needs_.power(i) ? a_j / (n * (a_i + a_j)) : a_j / (n * a_i);
}

SparseMatrix SampledFormFactors::matrix() const {
    SparseMatrix f;
    f.row_begin.push_back(0);
    const double samples = emitter_samples(rays_);
    const auto merged = merged_counts();
    std::size_t entries = emitters_.size() * merged.size();
    for (const auto& row : merged)
        entries += row.size();
    f.column.reserve(entries); // lists that grow would be there twice
    f.value.reserve(entries);
    for (std::uint32_t i = 0; i < merged.size(); ++i) {
        double rest = 1 - lost_[i].escaped - lost_[i].absorbed; // of the row, for all but emitters
        for (std::size_t e = 0; e < emitters_.size(); ++e) {
            const double factor = emitter_sum_[i * emitters_.size() + e] / samples;
            if (factor > 0) {
                f.column.push_back(emitters_[e]);
                f.value.push_back(factor);
                rest -= factor;
            }
        }
        const std::size_t first = f.value.size();
        double sum = 0;
        const bool shoots = needs_.power(i);
        for (const PatchHits& c : merged[i])
            if (!shoots || !is_emitter_[c.patch]) {
                f.column.push_back(c.patch);
                f.value.push_back(factor_per_hit(i, c.patch) * c.hits);
                sum += f.value.back();
            }
        const double normalisation = !shoots ? 1 : sum > 0 ? std::max(rest, 0.0) / sum : 0;
        for (std::size_t k = first; k < f.value.size(); ++k)
            f.value[k] *= normalisation;
        f.row_begin.push_back(f.value.size());
    }
    return f;
}

} // namespace hemilux
