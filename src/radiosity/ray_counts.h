#pragma once
// Which patches the cosine-distributed rays of each patch struck, and how often: what gathering
// keeps of them. One set of well-distributed points per patch (sobol.h), which can be prolonged.

#include "bvh/tracer.h"
#include "radiosity/workers.h"

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
    /// A patch that was struck, and how often.
    struct Count {
        std::uint32_t patch, hits;
    };

    /// Different seeds: independent sets. What is referred to outlives this.
    RayCounts(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed);

    /// Goes on until each patch has so many rays. Returns the number traced now. Where the monitor
    /// was interrupted meanwhile some patches have fewer, and another call takes up the rest.
    std::uint64_t trace_up_to(std::span<const std::uint32_t> rays, const Workers& workers,
                              Monitor& monitor);

    /// Of this patch.
    [[nodiscard]] std::uint32_t rays(std::uint32_t patch) const { return rows_[patch].rays; }
    /// By patch struck.
    [[nodiscard]] std::span<const Count> row(std::uint32_t patch) const {
        return rows_[patch].counts;
    }
    /// Rays that met no patch: that left the scene, that fell on the back of a face.
    [[nodiscard]] std::uint32_t escaped(std::uint32_t patch) const { return rows_[patch].escaped; }
    [[nodiscard]] std::uint32_t absorbed(std::uint32_t patch) const {
        return rows_[patch].absorbed;
    }
    [[nodiscard]] std::uint64_t bytes() const;

    void save(StateWriter& state) const;
    /// Throws StateError for what save() cannot have written of this mesh.
    void load(StateReader& state);

  private:
    struct Row {
        std::vector<Count> counts;
        std::uint32_t rays = 0, escaped = 0, absorbed = 0;
        void add(std::vector<std::uint32_t>& struck);
        [[nodiscard]] bool adds_up(std::size_t patches) const;
    };
    struct Volley;
    void draw_row(std::uint32_t patch, std::uint32_t end, Volley& volley);
    void trace(Volley& volley);

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::uint64_t seed_;
    std::vector<Row> rows_;
};

} // namespace hemilux
