#include "radiosity/engine/form_factors/ray_counts.h"

#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <string_view>
#include <utility>

namespace hemilux {
namespace {

/// The largest number of rays of a row that are traced at once; longer rows are traced in parts.
constexpr std::uint32_t rays_in_batch = 1u << 14;

/// The bytes of a patch that was hit and its hits, as they are saved.
constexpr std::size_t saved_bytes = 2 * sizeof(std::uint32_t);

/// Draws some of a block's rays. Of the four dimensions the first two are the best distributed.
void draw(const PatchStart& start, const SobolBlocks<4>& points, std::size_t first,
          std::size_t count, std::vector<Ray>& rays) {
    std::array<double, samples_per_block> x, y, z;
    sampling_kernels().cosine(samples_per_block, points.coordinate(0), points.coordinate(1),
                              x.data(), y.data(), z.data());
    for (std::size_t k = first; k < first + count; ++k)
        rays.push_back(
            start.ray({points.coordinate(2)[k], points.coordinate(3)[k]}, {x[k], y[k], z[k]}));
}

} // namespace

RayCounts::RayCounts(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed, const Ranks& ranks)
    : mesh_(mesh), tracer_(tracer), seed_(seed), own_(ranks, mesh.patches().size()),
      words_(mesh.patches().size()), rows_(mesh.patches().size()),
      blocks_((rows_.size() + rows_per_block - 1) / rows_per_block) {}

/// A block of rows that is built anew from its counts and what was hit since.
class RayCounts::Tally {
  public:
    explicit Tally(std::size_t patches) : words_(patches), place_(patches) {}

    /// Begins another row, which has these counts already.
    void begin_row(std::span<const std::uint32_t> counted) {
        end_row();
        for (const std::uint32_t word : counted) {
            counts_.push_back(word);
            place_[words_.column(word)] = size();
        }
        ends_.push_back(size());
    }
    /// Adds a hit to the last row.
    void add(std::uint32_t patch) {
        std::uint32_t& place = place_[patch];
        if (place == 0 || words_.is_full(counts_[place - 1])) {
            counts_.push_back(words_.pack(patch, 0));
            place = size();
        }
        counts_[place - 1] += words_.pack(0, 1);
    }
    void end_row() {
        if (ends_.empty())
            return;
        for (std::size_t k = ends_.size() > 1 ? ends_[ends_.size() - 2] : 0; k < size(); ++k)
            place_[words_.column(counts_[k])] = 0;
        ends_.back() = size();
    }
    void clear() {
        counts_.clear();
        ends_.clear();
    }
    [[nodiscard]] std::span<const std::uint32_t> counts() const { return counts_; }
    /// Returns, by row, the end of its counts.
    [[nodiscard]] std::span<const std::uint32_t> ends() const { return ends_; }

  private:
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(counts_.size()); }

    CountWords words_;
    std::vector<std::uint32_t> counts_;
    std::vector<std::uint32_t> ends_;
    std::vector<std::uint32_t> place_; ///< one more than the index by patch in the last row, or 0
};

/// The rays of some rows of a block that are not traced yet, and the hits of those before.
struct RayCounts::RayBatch {
    explicit RayBatch(std::size_t patches) : tally(patches) {}

    struct RayGroup {
        std::uint32_t patch, rays;
    };
    std::vector<RayGroup> groups;
    std::vector<Ray> rays;
    std::vector<std::uint32_t> receivers;
    std::uint32_t first_row = 0; ///< first row of the block
    Tally tally;
    std::uint64_t traced = 0;
};

std::uint64_t RayCounts::trace_up_to(std::span<RayCounts> batches,
                                     std::span<const std::uint32_t> rays, const Workers& workers,
                                     Monitor& monitor, double share) {
    std::atomic<std::uint64_t> traced{0};
    std::atomic<std::size_t> done{0};
    const OwnBlocks& own = batches[0].own_;
    const std::size_t blocks = (own.count() + rows_per_block - 1) / rows_per_block,
                      all = batches.size() * blocks;
    std::optional<OnThisRank> on_this_rank(monitor.interrupted);
    workers.for_chunks_with(
        all, 1, [&] { return RayBatch(rays.size()); },
        [&](RayBatch& batch, std::size_t k, std::size_t) {
            const std::size_t block = own.item(k % blocks * rows_per_block) / rows_per_block;
            batches[k / blocks].trace_block(block, rays, batch, monitor);
            traced += batch.traced;
            monitor.rays += std::exchange(batch.traced, 0);
            if (share > 0)
                monitor.step_share = share * static_cast<double>(++done) / static_cast<double>(all);
        });
    on_this_rank.reset();
    agree(monitor.interrupted);
    own.ranks().add_work(traced, 0);
    for (RayCounts& batch : batches)
        batch.gather_rows();
    return own.ranks().sum(traced);
}

/// Tells all ranks how many rays there are, but not what those of others have hit.
void RayCounts::gather_rows() {
    own_.gather(rows_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (!own_.owns(i))
            rows_[i].end = 0;
}

void RayCounts::trace_block(std::size_t block, std::span<const std::uint32_t> rays, RayBatch& batch,
                            const Monitor& monitor) {
    const auto begin = static_cast<std::uint32_t>(block * rows_per_block);
    const auto end =
        static_cast<std::uint32_t>(std::min(rows_.size(), (block + 1) * rows_per_block));
    batch.first_row = begin;
    for (std::uint32_t i = begin; i < end && !monitor.interrupted; ++i)
        if (rays[i] > rows_[i].rays)
            draw_row(i, rays[i], batch);
    trace(batch);
    if (batch.traced > 0)
        store(begin, end, batch.tally);
}

void RayCounts::draw_row(std::uint32_t patch, std::uint32_t end, RayBatch& batch) {
    const auto start = PatchStart::in_any_axes(mesh_, patch);
    SobolBlocks<4> points(hash_words({seed_, patch}));
    while (rows_[patch].rays < end) {
        const std::uint32_t first = rows_[patch].rays;
        const std::uint32_t last = first + std::min(end - first, rays_in_batch);
        for (std::uint32_t k = first; k < last;) {
            const std::size_t in_block = k % samples_per_block;
            const auto count = std::min<std::size_t>(samples_per_block - in_block, last - k);
            points.move_to(k);
            draw(start, points, in_block, count, batch.rays);
            k += static_cast<std::uint32_t>(count);
        }
        batch.groups.push_back({patch, last - first});
        rows_[patch].rays = last;
        if (batch.rays.size() >= rays_at_a_time)
            trace(batch);
    }
}

void RayCounts::trace(RayBatch& batch) {
    batch.receivers.clear();
    find_receivers(batch.rays, mesh_, tracer_, batch.receivers);
    auto next = batch.receivers.cbegin();
    Tally& tally = batch.tally;
    for (const auto& [patch, rays] : batch.groups) {
        while (batch.first_row + tally.ends().size() <= patch)
            tally.begin_row(row(batch.first_row + static_cast<std::uint32_t>(tally.ends().size())));
        for (const auto end = next + rays; next != end; ++next) {
            if (*next == hemilux::escaped)
                ++rows_[patch].escaped;
            else if (*next == hemilux::absorbed)
                ++rows_[patch].absorbed;
            else
                tally.add(*next);
        }
    }
    batch.traced += batch.rays.size();
    batch.rays.clear();
    batch.groups.clear();
}

void RayCounts::store(std::uint32_t begin, std::uint32_t end, Tally& tally) {
    for (std::uint32_t i = begin + static_cast<std::uint32_t>(tally.ends().size()); i < end; ++i)
        tally.begin_row(row(i));
    tally.end_row();
    for (std::uint32_t i = begin; i < end; ++i)
        rows_[i].end = tally.ends()[i - begin];
    blocks_[begin / rows_per_block].assign(tally.counts().begin(), tally.counts().end());
    tally.clear();
}

void RayCounts::save_row(std::uint32_t patch, StateWriter& state) const {
    const Row& of = rows_[patch];
    for (const std::uint32_t rays : {of.rays, of.escaped, of.absorbed})
        state.add(rays);
    state.add(std::uint64_t{row(patch).size()});
    for (const std::uint32_t word : row(patch)) {
        state.add(words_.column(word));
        state.add(words_.count(word));
    }
}

void RayCounts::save(StateWriter& state) const {
    const Ranks& ranks = own_.ranks();
    std::vector<std::vector<char>> sent(ranks.count());
    if (!ranks.is_first()) {
        StateWriter own;
        for (std::size_t k = 0; k < own_.count(); ++k)
            save_row(static_cast<std::uint32_t>(own_.item(k)), own);
        sent[0].assign(own.bytes().begin(), own.bytes().end());
    }
    const std::vector<std::vector<char>> of_ranks = ranks.exchange(sent);
    std::vector<std::string_view> left;
    for (const std::vector<char>& of_rank : of_ranks)
        left.emplace_back(of_rank.data(), of_rank.size());
    for (std::uint32_t i = 0; ranks.is_first() && i < rows_.size(); ++i) {
        if (own_.owns(i)) {
            save_row(i, state);
            continue;
        }
        std::string_view& rows = left[own_.owner(i)];
        constexpr std::size_t before_size = 3 * sizeof(std::uint32_t);
        const std::uint64_t hit = StateReader(rows.substr(before_size)).whole();
        const std::size_t size = before_size + sizeof(hit) + hit * saved_bytes;
        state.append(rows.substr(0, size));
        rows.remove_prefix(size);
    }
}

void RayCounts::load(StateReader& state) {
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
        for (std::uint32_t* rays : {&rows_[i].rays, &rows_[i].escaped, &rows_[i].absorbed})
            state.get(*rays);
        std::uint64_t sum = std::uint64_t{rows_[i].escaped} + rows_[i].absorbed;
        std::vector<std::uint32_t>& block = blocks_[i / rows_per_block];
        for (std::size_t left = state.count(saved_bytes); left > 0; --left) {
            std::uint32_t patch = 0, hits = 0;
            state.get(patch);
            state.get(hits);
            if (patch >= rows_.size() || hits == 0)
                throw StateError("a patch is no patch, or was not hit");
            sum += hits;
            for (std::uint32_t part = 0; own_.owns(i) && hits > 0; hits -= part) {
                part = std::min(hits, words_.max_count());
                block.push_back(words_.pack(patch, part));
            }
        }
        // Every ray has hit something, once.
        if (sum != rows_[i].rays)
            throw StateError("rays of a patch do not add up");
        rows_[i].end = static_cast<std::uint32_t>(block.size());
        if (i + 1 == rows_.size() || (i + 1) % rows_per_block == 0)
            block.shrink_to_fit();
    }
}

std::size_t RayCounts::own_words() const {
    std::size_t words = 0;
    for (const std::vector<std::uint32_t>& block : blocks_)
        words += block.size();
    return words;
}

std::uint64_t RayCounts::bytes() const {
    return rows_.size() * sizeof(Row) + blocks_.size() * sizeof(blocks_[0]) + bytes_of_hits();
}

std::uint64_t RayCounts::bytes_of_hits() const {
    return own_.ranks().sum(std::uint64_t{own_words()}) * sizeof(std::uint32_t);
}

} // namespace hemilux
