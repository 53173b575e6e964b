#pragma once
// The density rays of several patches, level by level.

#include "bvh/tracer.h"
#include "geometry/frame.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/paper/hemisphere/hemisphere.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

/// Counts the surfaces at the vertices of the triangles that exist. All triangles of a level are
/// counted together, those of several patches too, so that the tracer gets many rays at once.
class LevelCounts {
  public:
    using Counts = std::vector<std::uint8_t>; ///< of one patch, by vertex of the hemisphere

    /// `directions`: those of the rays in the frame of a patch, by vertex.
    LevelCounts(const Hemisphere& hemisphere, std::span<const Vec3> directions, double threshold,
                const Tracer& tracer)
        : hemisphere_(hemisphere), directions_(directions), threshold_(threshold), tracer_(tracer) {
    }

    /// Adds the rays from `origin`, a point of `facet`. `counts` must last until find() returns.
    void add(const Vec3& origin, const Frame& frame, std::uint32_t facet, Counts& counts) {
        const std::size_t vertices = hemisphere_.vertices().size();
        counts.assign(vertices, 0);
        Sender sender{origin, frame, facet, &counts, {}, std::vector<bool>(vertices)};
        for (std::size_t root = 0; root < Hemisphere::cells_up_to(0); ++root)
            sender.cells.push_back(root);
        senders_.push_back(std::move(sender));
    }

    /// Fills in the counts, saturated at 255, of all that was added.
    void find() {
        for (int level = 0; level <= hemisphere_.depth(); ++level) {
            trace();
            for (Sender& sender : senders_)
                divide(sender);
        }
        senders_.clear();
    }

  private:
    struct Sender {
        Vec3 origin;
        Frame frame;
        std::uint32_t facet;
        Counts* counts;
        std::vector<std::size_t> cells; ///< triangles of the level
        std::vector<bool> asked;        ///< vertices that have their ray
    };

    void trace() {
        std::vector<Ray> rays;
        std::vector<std::uint8_t*> places;
        for (Sender& sender : senders_)
            for (const std::size_t cell : sender.cells)
                for (const std::uint16_t v : hemisphere_.cells()[cell].vertex)
                    if (!sender.asked[v]) {
                        sender.asked[v] = true;
                        rays.push_back({.origin = sender.origin,
                                        .direction = sender.frame.to_world(directions_[v]),
                                        .from = sender.facet});
                        places.push_back(&(*sender.counts)[v]);
                    }
        std::vector<std::uint32_t> pierced(rays.size());
        tracer_.count_stream(rays, pierced);
        for (std::size_t k = 0; k < rays.size(); ++k)
            *places[k] = static_cast<std::uint8_t>(std::min(pierced[k], 255u));
    }

    /// Replaces the triangles of a level by the children of those that are divided.
    void divide(Sender& sender) const {
        std::vector<std::size_t> children;
        for (const std::size_t index : sender.cells) {
            const Hemisphere::Cell& cell = hemisphere_.cells()[index];
            int sum = 0;
            for (const std::uint16_t v : cell.vertex)
                sum += (*sender.counts)[v];
            if (cell.level < hemisphere_.depth() && is_divided(sum / 3.0, threshold_))
                for (std::size_t child = 0; child < 4; ++child)
                    children.push_back(cell.first_child + child);
        }
        sender.cells = std::move(children);
    }

    const Hemisphere& hemisphere_;
    std::span<const Vec3> directions_;
    double threshold_;
    const Tracer& tracer_;
    std::vector<Sender> senders_;
};

} // namespace hemilux
