#include "radiosity/engine/densities/density.h"

#include "parallel/workers.h"
#include "radiosity/engine/densities/level_counts.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

/// Walks the tree of one patch depth-first. count_at(vertex) is called once for each vertex of the
/// triangles that exist, always in the same order. There the writer keeps a count, and the reader
/// takes the next byte. leaf(cell, mean) is called for each triangle that is not divided.
template <class CountAt, class Leaf>
class TreeWalk {
  public:
    TreeWalk(const Hemisphere& hemisphere, double threshold, const CountAt& count_at,
             const Leaf& leaf)
        : hemisphere_(hemisphere), threshold_(threshold), count_at_(count_at), leaf_(leaf) {
        std::fill_n(count_.begin(), hemisphere.vertices().size(), unknown);
    }

    void run() {
        for (std::size_t root = 0; root < Hemisphere::cells_up_to(0); ++root) {
            for (const std::uint16_t v : hemisphere_.cells()[root].vertex)
                ask(v);
            visit(root);
        }
    }

  private:
    static constexpr std::int16_t unknown = -1;
    static constexpr std::size_t max_vertices = 2113; ///< number at Hemisphere::max_depth

    void ask(std::uint16_t vertex) {
        if (count_[vertex] == unknown)
            count_[vertex] = count_at_(vertex);
    }

    void visit(std::size_t index) {
        const Hemisphere::Cell& cell = hemisphere_.cells()[index];
        const int sum = count_[cell.vertex[0]] + count_[cell.vertex[1]] + count_[cell.vertex[2]];
        const double mean = sum / 3.0;
        if (cell.level == hemisphere_.depth() || !is_divided(mean, threshold_)) {
            leaf_(static_cast<std::uint16_t>(index), mean);
            return;
        }
        for (const std::uint16_t v : cell.midpoint)
            ask(v);
        for (std::size_t child = 0; child < 4; ++child)
            visit(cell.first_child + child);
    }

    const Hemisphere& hemisphere_;
    double threshold_;
    const CountAt& count_at_;
    const Leaf& leaf_;
    std::array<std::int16_t, max_vertices> count_;
};

/// A threshold below any mean: all triangles are divided.
constexpr double divide_all = -1;

} // namespace

DensityMap::DensityMap(const Mesh& mesh, const Tracer& tracer, const Hemisphere& hemisphere,
                       double threshold, const Workers& workers, Monitor& monitor,
                       const Needs& needs, DensityStore kept)
    : hemisphere_(hemisphere), threshold_(threshold), needs_(needs), kept_(kept) {
    const std::size_t patches = mesh.patches().size();
    std::vector<Vec3> directions;
    for (const Vec3& v : hemisphere.vertices())
        directions.push_back(density_direction(v));
    const double counted_above = kept == DensityStore::everything ? divide_all : threshold;
    Blocks blocks((patches + block_size - 1) / block_size);
    workers.for_chunks(patches, block_size, [&](std::size_t begin, std::size_t end) {
        Block& block = blocks[begin / block_size];
        block.lengths.assign(end - begin, 0);
        if (monitor.interrupted)
            return;
        LevelCounts levels(hemisphere, directions, counted_above, tracer);
        std::array<LevelCounts::Counts, block_size> found;
        for (std::size_t i = begin; i < end; ++i)
            if (const auto patch = static_cast<std::uint32_t>(i); needs.power(patch))
                levels.add(mesh.patches()[i].centre, mesh.hemisphere_frame(patch),
                           mesh.patches()[i].facet, found[i - begin]);
        levels.find();
        for (std::size_t i = begin; i < end; ++i) {
            const LevelCounts::Counts& counts = found[i - begin];
            if (counts.empty())
                continue;
            const std::size_t start = block.counts.size();
            const auto keep = [&](std::uint16_t v) {
                block.counts.push_back(counts[v]);
                return std::int16_t{counts[v]};
            };
            TreeWalk(hemisphere, counted_above, keep, [](std::uint16_t, double) {}).run();
            block.lengths[i - begin] = static_cast<std::uint16_t>(block.counts.size() - start);
        }
        monitor.rays += block.counts.size();
    });
    store(blocks, patches);
}

void DensityMap::store(const Blocks& blocks, std::size_t patches) {
    std::size_t longest = 0;
    for (const Block& block : blocks) {
        rays_ += block.counts.size();
        for (const std::uint16_t length : block.lengths) {
            longest = std::max<std::size_t>(longest, length);
            rays_spared_ += length > 0 ? hemisphere_.vertices().size() - length : 0;
        }
    }
    // Patches are stored one after another with an index, or all as long as the longest, whichever
    // is smaller.
    if (longest * patches <= rays_ + blocks.size() * sizeof(block_start_[0])) {
        stride_ = longest;
        counts_.resize(longest * patches);
    } else {
        counts_.reserve(rays_);
    }
    std::size_t patch = 0;
    for (const Block& block : blocks) {
        if (stride_ == 0) {
            block_start_.push_back(counts_.size());
            counts_.insert(counts_.end(), block.counts.begin(), block.counts.end());
            continue;
        }
        const std::uint8_t* from = block.counts.data();
        for (const std::uint16_t length : block.lengths) {
            std::copy_n(from, length, counts_.data() + stride_ * patch++);
            from += length;
        }
    }
}

template <class CountRead, class Leaf>
const std::uint8_t* DensityMap::walk(const std::uint8_t* bytes, CountRead&& count_read,
                                     Leaf&& leaf) const {
    const auto next = [&](std::uint16_t vertex) {
        count_read(vertex, *bytes);
        return std::int16_t{*bytes++};
    };
    if (kept_ == DensityStore::divided_only) {
        TreeWalk(hemisphere_, threshold_, next, leaf).run();
        return bytes;
    }
    std::vector<std::uint8_t> all(hemisphere_.vertices().size());
    const auto keep = [&](std::uint16_t vertex) {
        all[vertex] = *bytes++;
        return std::int16_t{all[vertex]};
    };
    TreeWalk(hemisphere_, divide_all, keep, [](std::uint16_t, double) {}).run();
    const auto kept = [&](std::uint16_t vertex) {
        count_read(vertex, all[vertex]);
        return std::int16_t{all[vertex]};
    };
    TreeWalk(hemisphere_, threshold_, kept, leaf).run();
    return bytes;
}

const std::uint8_t* DensityMap::counts_of(std::uint32_t patch) const {
    if (stride_ > 0)
        return counts_.data() + patch * stride_;
    const std::uint8_t* at = counts_.data() + block_start_[patch / block_size];
    const std::uint32_t first = patch - patch % static_cast<std::uint32_t>(block_size);
    for (std::uint32_t before = first; before < patch; ++before)
        if (needs_.power(before))
            at = walk(
                at, [](std::uint16_t, std::uint8_t) {}, [](std::uint16_t, double) {});
    return at;
}

void DensityMap::leaves(std::uint32_t patch, std::vector<DensityLeaf>& result) const {
    result.clear();
    walk(
        counts_of(patch), [](std::uint16_t, std::uint8_t) {},
        [&](std::uint16_t cell, double mean) {
            result.push_back({cell, mean});
        });
}

void DensityMap::counts(std::uint32_t patch, std::vector<DensityCount>& result) const {
    result.clear();
    walk(
        counts_of(patch),
        [&](std::uint16_t vertex, std::uint8_t count) {
            result.push_back({vertex, count});
        },
        [](std::uint16_t, double) {});
}

} // namespace hemilux
