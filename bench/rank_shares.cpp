// How evenly ranks share the work of stored transport, counted without any rank: the rays of a
// first step and the entries of its matrix belong to blocks of patches, and blocks to ranks.
//
//     rank_shares SCENE.obj MAX_EDGE [RAYS]
//
// Faces are divided until no edge is longer than MAX_EDGE. RAYS: of a patch, on average. Prints for
// 1 to 64 ranks the mean over the largest share of rays and of entries, which is the efficiency if
// nothing else took time, and the largest number of bytes that a rank gets of hits of others.
#include "io/scene_files/obj.h"
#include "parallel/ranks.h"
#include "radiosity/engine/emitters/small_emitters.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/stored_transport/ray_plan.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

constexpr unsigned batches = 4;
constexpr std::size_t bytes_of_hit = 4;

class SomeRanks final : public Ranks {
  public:
    explicit SomeRanks(unsigned count) : count_(count) {}
    [[nodiscard]] unsigned count() const override { return count_; }
    [[nodiscard]] unsigned index() const override { return 0; }
    void wait_for_all() const override {}

  private:
    void do_gather(std::span<const std::size_t>, std::span<std::byte>) const override {}
    void do_exchange(std::span<const Bytes>, std::span<const std::span<std::byte>>) const override {
    }
    unsigned count_;
};

double mean_over_largest(const std::vector<double>& shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0) /
           (static_cast<double>(shares.size()) * std::ranges::max(shares));
}

void print_shares(unsigned count, const std::vector<RayCounts>& counts,
                  const PlannedRays& planned) {
    const SomeRanks ranks(count);
    const OwnBlocks blocks(ranks, counts[0].patches());
    std::vector<double> rays(count), entries(count), bytes(count);
    for (std::uint32_t i = 0; i < counts[0].patches(); ++i) {
        const unsigned of = blocks.owner(i);
        rays[of] += batches * (planned.random[i] + planned.to_emitters[i]);
        for (const RayCounts& batch : counts)
            for (const std::uint32_t word : batch.row(i)) {
                const unsigned other = blocks.owner(batch.words().column(word));
                ++entries[of];
                ++entries[other];
                bytes[other] += other != of ? bytes_of_hit : 0;
            }
    }
    std::printf("%5u %8.3f %8.3f %12.1f\n", count, mean_over_largest(rays),
                mean_over_largest(entries), std::ranges::max(bytes) / 1e6);
}

void measure(const std::string& path, double max_edge, double rays) {
    const Mesh mesh = layered_mesh(read_obj(path).scene, {.max_edge = max_edge});
    const MadeTracer made = make_tracer(mesh);
    const Needs needs = find_needs(mesh);
    const double each = rays / (2 * batches);
    RayPlan plan(mesh, needs, each, small_emitters(mesh).empty() ? 0 : each, RayGoal{true, 0});
    plan.begin();
    plan.grow({}, 1, std::numeric_limits<double>::infinity(), Workers(0));
    std::vector<RayCounts> counts;
    for (std::uint64_t s = 0; s < batches; ++s)
        counts.emplace_back(mesh, *made.tracer, hash_words({1, s}));
    Monitor monitor;
    RayCounts::trace_up_to(counts, plan.rays().random, Workers(0), monitor, 0);
    std::printf("%zu patches, %.1f million rays at random\n", mesh.patches().size(),
                static_cast<double>(monitor.rays) / 1e6);
    std::printf("ranks     rays  entries  MB of hits\n");
    for (unsigned count = 1; count <= 64; count *= 2)
        print_shares(count, counts, plan.rays());
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "rank_shares SCENE.obj MAX_EDGE [RAYS]\n");
        return 1;
    }
    try {
        measure(argv[1], std::atof(argv[2]), argc > 3 ? std::atof(argv[3]) : 64);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rank_shares: %s\n", error.what());
        return 1;
    }
    return 0;
}
