#include "radiosity/engine/factors/pairs/free_pairs.h"

#include "radiosity/engine/factors/pairs/hidden_exchange.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <span>

namespace hemilux {
namespace {

/// The search of one thread.
class FreeSearch {
  public:
    FreeSearch(const Mesh& mesh, const WideBvh& tree, std::span<const Polygon> panes,
               std::span<const FacePlane> faces)
        : mesh_(mesh), tree_(tree), faces_(faces), hidden_(mesh, tree, panes) {}

    /// Returns the pairs of a patch.
    std::vector<FreePair> row(std::uint32_t i) {
        find_facing(i);
        std::vector<FreePair> pairs;
        for (std::size_t k = 0; k < facing_.size(); ++k) {
            const auto [j, facing] = facing_[k];
            const double exchange = free_exchange(faces_[i], faces_[j], facing, FreeAccuracy::exact,
                                                  HiddenExchange::plane_rounding);
            if (!(exchange > 0))
                continue;
            // Where the ray between the centres is blocked the hull need not be looked at.
            const bool may_be_clear = facing != Facing::wholly || blocked_[k] == 0;
            pairs.push_back({j,
                             may_be_clear && hidden_.is_clear(i, faces_[i], j, faces_[j], facing),
                             exchange});
        }
        return pairs;
    }

  private:
    struct Candidate {
        std::uint32_t to;
        Facing facing;
    };

    void find_facing(std::uint32_t i) {
        facing_.clear();
        rays_.clear();
        targets_.clear();
        const auto patches = mesh_.patches();
        for (std::uint32_t j = i + 1; j < patches.size(); ++j) {
            const Facing facing =
                hemilux::facing(faces_[i], faces_[j], HiddenExchange::plane_rounding);
            if (facing == Facing::never)
                continue;
            facing_.push_back({j, facing});
            rays_.push_back({.origin = faces_[i].centre,
                             .direction = faces_[j].centre - faces_[i].centre,
                             .t_max = 1 - 1e-12,
                             .from = patches[i].facet});
            targets_.push_back(patches[j].facet);
        }
        blocked_.resize(rays_.size());
        tree_.occluded_stream(rays_, targets_, blocked_);
    }

    const Mesh& mesh_;
    const WideBvh& tree_;
    std::span<const FacePlane> faces_;
    HiddenExchange hidden_;
    std::vector<Candidate> facing_;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> targets_;
    std::vector<std::uint8_t> blocked_;
};

} // namespace

FreePairs find_free_pairs(const Mesh& mesh, const WideBvh& tree, const Workers& workers,
                          Monitor& monitor) {
    const std::vector<FacePlane> faces = face_planes(mesh);
    const std::vector<Polygon> panes = local_panes(mesh);
    FreePairs found;
    found.rows.resize(faces.size());
    workers.for_chunks_with(
        faces.size(), 4, [&] { return FreeSearch(mesh, tree, panes, faces); },
        [&](FreeSearch& search, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !monitor.interrupted; ++i)
                found.rows[i] = search.row(static_cast<std::uint32_t>(i));
        });
    for (const std::vector<FreePair>& row : found.rows) {
        found.count += row.size();
        found.clear_count +=
            static_cast<std::uint64_t>(std::ranges::count_if(row, &FreePair::is_clear));
    }
    return found;
}

} // namespace hemilux
