#pragma once
// Counts which patches the cosine-distributed rays of each patch hit, and how often: what stored
// transport keeps of them. Each patch has one sequence of well-distributed points (sobol.h), which
// can be prolonged.

#include "bvh/tracer.h"
#include "parallel/ranks.h"
#include "parallel/workers.h"
#include "radiosity/engine/sparse/count_words.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StateReader;
class StateWriter;
struct Monitor;

class RayCounts {
  public:
    /// Makes counts without rays. Different seeds give independent batches. Each of the ranks
    /// traces the rays of its patches and keeps what they hit.
    RayCounts(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed,
              const Ranks& ranks = one_rank());

    /// Traces until each patch has so many rays. Returns the number of rays that this call traced.
    /// Where the monitor was interrupted meanwhile some patches have fewer, and another call takes
    /// up the rest.
    std::uint64_t trace_up_to(std::span<const std::uint32_t> rays, const Workers& workers,
                              Monitor& monitor) {
        return trace_up_to({this, 1}, rays, workers, monitor, 0);
    }
    /// Does the same in several batches of one mesh, so that no thread waits at the end of each.
    /// `share` is the part of a step that this is. All ranks call it; the rays are those of all.
    static std::uint64_t trace_up_to(std::span<RayCounts> batches,
                                     std::span<const std::uint32_t> rays, const Workers& workers,
                                     Monitor& monitor, double share);

    [[nodiscard]] std::uint32_t patches() const { return static_cast<std::uint32_t>(rows_.size()); }
    /// Returns the number of rays of this patch.
    [[nodiscard]] std::uint32_t rays(std::uint32_t patch) const { return rows_[patch].rays; }
    /// Returns the patches whose row() this rank has.
    [[nodiscard]] const OwnBlocks& own_rows() const { return own_; }
    /// Returns the patches that were hit and how often, in the order of first hits. A patch is
    /// listed again only where its hits do not fit into a word. The row is empty where it is
    /// another rank's.
    [[nodiscard]] std::span<const std::uint32_t> row(std::uint32_t patch) const {
        const std::uint32_t begin = patch % rows_per_block > 0 ? rows_[patch - 1].end : 0;
        return std::span(blocks_[patch / rows_per_block]).subspan(begin, rows_[patch].end - begin);
    }
    /// Returns how the words of rows hold patches and hits.
    [[nodiscard]] const CountWords& words() const { return words_; }
    /// Returns the number of rays that left the scene and so met no patch. Those of absorbed() fell
    /// on the back of a face.
    [[nodiscard]] std::uint32_t escaped(std::uint32_t patch) const { return rows_[patch].escaped; }
    [[nodiscard]] std::uint32_t absorbed(std::uint32_t patch) const {
        return rows_[patch].absorbed;
    }
    /// Returns the number of words of this rank's rows.
    [[nodiscard]] std::size_t own_words() const;
    /// Returns the memory of all ranks, which all call this and the following functions.
    [[nodiscard]] std::uint64_t bytes() const;
    /// Returns that of the words, which grows with the rays.
    [[nodiscard]] std::uint64_t bytes_of_hits() const;

    /// Saves the state, which is whole on the first rank.
    void save(StateWriter& state) const;
    /// Loads the state; throws StateError for what save() cannot have written of this mesh.
    void load(StateReader& state);

  private:
    static constexpr std::uint32_t rows_per_block = 16;
    struct Row {
        std::uint32_t rays = 0, escaped = 0, absorbed = 0;
        std::uint32_t end = 0; ///< end of its counts in its block; 0 where that is another rank's
    };
    class Tally;
    struct RayBatch;
    void trace_block(std::size_t block, std::span<const std::uint32_t> rays, RayBatch& batch,
                     const Monitor& monitor);
    void draw_row(std::uint32_t patch, std::uint32_t end, RayBatch& batch);
    void trace(RayBatch& batch);
    void store(std::uint32_t begin, std::uint32_t end, Tally& tally);
    void gather_rows();
    void save_row(std::uint32_t patch, StateWriter& state) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::uint64_t seed_;
    OwnBlocks own_;
    CountWords words_;
    std::vector<Row> rows_;
    std::vector<std::vector<std::uint32_t>> blocks_; ///< the words of some rows each
};

} // namespace hemilux
