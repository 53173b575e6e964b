#pragma once
// Compute Radiosity, the loops of paper section 5b, for any strategy.
//
// Each step is a complete, unbiased solution of all bounces (stepwise.h): power is shot from all
// patches that hold some, what arrives is reflected and shot in turn, until nothing is left. Rays
// are dealt in proportion to the power to be shot (docs/decisions.md, D10), so that each carries
// about the same, unless the strategy gives some patches more and weaker ones; numbers of rays are
// made whole by systematic sampling over all patches and cells at once, which is unbiased and ends
// the series of bounces by itself.

#include "geometry/frame.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/hemisphere.h"
#include "radiosity/rng.h"
#include "radiosity/stepwise.h"
#include "radiosity/strategy.h"
#include "radiosity/workers.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace hemilux {

struct Patch;

class ShootingSolver final : public StepwiseSolver {
  public:
    ShootingSolver(const SolverInput& input, MakeStrategy make_strategy);

  private:
    /// Rays of one cell: N_tr of them, each carrying ray_power of the patch's power.
    struct Burst {
        std::uint32_t patch;
        std::uint16_t cell;
        std::uint32_t rays;
        double ray_power; ///< Phi_ray / Phi_patch
    };
    /// Where the rays of a burst start and where they go.
    struct Aim {
        const PolygonSampler* origins; ///< nullptr: all from the centre
        Vec3 centre;
        const SphericalTriangle* triangle; ///< nullptr: the whole hemisphere
    };
    /// What one thread shoots at a time: of the rays on the line (plan) those in (from, to], which
    /// are of patches from `first` to before `last`.
    struct Piece {
        std::uint32_t first, last;
        double from, to;
    };
    /// What a piece shot and where each ray arrived.
    struct Volley {
        std::vector<Burst> bursts;
        std::vector<std::uint32_t> receivers; ///< a patch, `escaped` or `absorbed`, ray by ray
        std::vector<std::uint16_t> arrivals;  ///< from which of its cells, if the strategy learns
        std::vector<Ray> waiting;             ///< rays that are not traced yet
    };

    using Received = std::vector<CompensatedSum<Vec3>>; ///< power by patch

    bool solve_once(std::uint64_t stream, StepResult& result) override;
    void save_more(StateWriter& state) const override { strategy_->save(state); }
    void load_more(StateReader& state) override { strategy_->load(state); }
    bool shoot_all_bounces(std::uint64_t stream, StepResult& result);
    /// Shoots all unshot power once; adds what arrives. Returns the number of rays.
    std::uint64_t bounce(std::uint64_t stream, const std::vector<Vec3>& unshot, Received& received,
                         StepResult& result);
    void plan(std::uint64_t stream, const std::vector<Vec3>& unshot);
    [[nodiscard]] double cut();
    void fire(const Piece& piece, std::uint64_t stream, const std::vector<Vec3>& unshot,
              Volley& volley) const;
    void shoot(std::uint32_t patch, const Piece& piece, std::uint64_t stream,
               std::vector<CellShare>& shares, Volley& volley) const;
    [[nodiscard]] Aim aim(std::uint32_t patch, std::uint16_t cell,
                          const std::optional<PrivateCell>& own,
                          const PolygonSampler& origins) const;
    [[nodiscard]] static Ray draw(const Patch& from, const Frame& frame, const Aim& aim, Rng& rng);
    void trace(Volley& volley) const;

    void collect(const Volley& volley, const std::vector<Vec3>& unshot, Received& received,
                 StepResult& result);

    Workers workers_;
    Hemisphere hemisphere_;
    std::unique_ptr<Strategy> strategy_;
    /// Expected rays of the patches before patch i, counted from the bounce's random offset.
    std::vector<double> rays_before_;
    std::vector<Piece> pieces_;   ///< of the present bounce
    std::vector<Volley> volleys_; ///< kept for their memory
};

/// Method::make of a strategy.
template <MakeStrategy make_strategy>
[[nodiscard]] std::unique_ptr<Solver> shoot_with(const SolverInput& input) {
    return std::make_unique<ShootingSolver>(input, make_strategy);
}

} // namespace hemilux
