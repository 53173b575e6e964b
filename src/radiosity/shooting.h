#pragma once
// Compute Radiosity, the loops of paper section 5b, for any strategy.
//
// Each step is a complete, unbiased solution of all bounces (stepwise.h): power is shot from all
// patches that hold some, what arrives is reflected and shot in turn, until nothing is left. Rays
// are dealt in proportion to the power to be shot (docs/decisions.md, D10), so that each carries
// about the same, unless the strategy gives some patches more and weaker ones; numbers of rays are
// made whole by systematic sampling over all patches and cells at once, which is unbiased and ends
// the series of bounces by itself.

#include "radiosity/burst_rays.h"
#include "radiosity/hemisphere.h"
#include "radiosity/stepwise.h"
#include "radiosity/strategy.h"
#include "radiosity/workers.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace hemilux {

class ShootingSolver final : public StepwiseSolver {
  public:
    ShootingSolver(const SolverInput& input, MakeStrategy make_strategy);

  private:
    /// What one thread shoots at a time: of the rays on the line (plan) those in (from, to], which
    /// are of senders from `first` to before `last`.
    struct Piece {
        std::uint32_t first, last;
        double from, to;
    };
    /// What a piece shot and where each ray arrived.
    struct Volley {
        std::vector<Burst> bursts;
        std::vector<std::uint32_t> receivers; ///< a patch, `escaped` or `absorbed`, ray by ray
        std::vector<std::uint16_t> arrivals;  ///< from which of its cells, if the strategy learns
    };

    /// What a patch received in a bounce.
    struct Arrived {
        CompensatedSum<Vec3> power;
        std::uint32_t rays = 0;
    };

    bool solve_once(std::uint64_t stream, StepResult& result) override;
    void save_more(StateWriter& state) const override { strategy_->save(state); }
    void load_more(StateReader& state) override { strategy_->load(state); }
    bool shoot_all_bounces(std::uint64_t stream, StepResult& result);
    void begin(const StepResult& result);
    /// Shoots all unshot power once; adds what arrives. Returns the number of rays.
    std::uint64_t bounce(std::uint64_t stream, StepResult& result);
    void plan(std::uint64_t stream);
    [[nodiscard]] double cut();
    void fire(const Piece& piece, std::uint64_t stream, Volley& volley) const;
    // What is to be drawn of a patch is added to `bursts`.
    void order(std::size_t sender, const Piece& piece, const Dealing& dealing,
               std::vector<Burst>& bursts) const;
    void order_as_printed(std::uint32_t patch, const Dealing& dealing,
                          std::vector<Burst>& bursts) const;
    void trace(std::uint64_t seed, Volley& volley) const;

    void collect(const Volley& volley, StepResult& result);
    void reflect(StepResult& result);
    void add_sender(std::uint32_t patch, const Vec3& power);

    Workers workers_;
    Hemisphere hemisphere_;
    CellDirections directions_;
    PatchStarts starts_;
    std::unique_ptr<Strategy> strategy_;

    // Of the present bounce. Late ones are of few rays: they cost what is shot, not a look at all
    // patches.
    std::vector<std::uint32_t> senders_; ///< patches that hold power, ascending
    double left_ = 0;                    ///< their power, mean of channels
    std::vector<Vec3> unshot_;           ///< by patch, of senders
    /// Expected rays of the senders before sender k, counted from the bounce's random offset.
    std::vector<double> rays_before_;
    std::vector<Arrived> received_;     ///< by patch
    std::vector<std::uint64_t> struck_; ///< a bit for each patch that received any
    std::vector<Piece> pieces_;
    std::vector<Volley> volleys_; ///< kept for their memory
};

/// Method::make of a strategy.
template <MakeStrategy make_strategy>
[[nodiscard]] std::unique_ptr<Solver> shoot_with(const SolverInput& input) {
    return std::make_unique<ShootingSolver>(input, make_strategy);
}

} // namespace hemilux
