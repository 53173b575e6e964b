#pragma once
// All bounces of one step. Power is shot from all patches that hold some; what arrives is reflected
// and shot in turn, until nothing is left (paper section 5b).
//
// Late bounces have few rays: they cost what is shot, not a look at all patches.

#include "geometry/compensated_sum.h"
#include "parallel/workers.h"
#include "radiosity/engine/densities/cell_directions.h"
#include "radiosity/engine/shooting/grouped_rays.h"
#include "radiosity/engine/shooting/separate_rays.h"
#include "radiosity/engine/shooting/shooting_rules.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/engine/shooting/stepwise.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/paper/hemisphere/hemisphere.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hemilux {

/// The rules, the tables and the strategy that all steps share.
struct ShootingTools {
    SolverInput input;
    ShootingRules rules;
    Hemisphere hemisphere;
    CellDirections directions;
    std::vector<Vec2> turns; ///< turns by patch, Mesh::hemisphere_turn
    std::unique_ptr<Strategy> strategy;

    /// `depth` is the depth of the hemisphere.
    ShootingTools(const SolverInput& input, const ShootingRules& rules, int depth,
                  std::unique_ptr<Strategy> strategy = nullptr);
};

class Bounces {
  public:
    /// It may be used for one step after another.
    explicit Bounces(const ShootingTools& tools)
        : tools_(tools), input_(tools.input), hook_(tools.strategy->step_hook()) {}

    /// Shoots the light that `result` has as radiosity, and all its bounces. Returns false when
    /// interrupted.
    bool shoot(const StepTask& task, StepResult& result);

  private:
    /// The rays that one thread shoots at a time: those of the line (see plan()) in (from, to].
    /// They belong to the senders from `first` to before `last`.
    struct WorkItem {
        std::uint32_t first, last;
        double from, to;
    };
    /// The place where the next item begins: behind this many rays of the line, or of the sender if
    /// all have the same number.
    struct Place {
        std::uint32_t sender;
        double ray;
    };
    /// The rays of a work item, and where each arrived.
    struct RayBatch {
        std::vector<RayGroup> groups;
        std::vector<std::uint32_t> receivers; ///< a patch, `escaped` or `absorbed`, ray by ray
        std::vector<std::uint16_t> arrivals;  ///< cells that rays came from, if the hook learns
    };

    /// The power that a patch received in a bounce. It fills one cache line, as rays hit patches in
    /// no particular order.
    struct alignas(64) Arrived {
        CompensatedSum<Vec3> power;
        std::uint32_t rays = 0;
    };

    /// Returns whether rays are allocated by power; otherwise each patch shoots the same number.
    [[nodiscard]] bool rays_by_power() const { return tools_.rules.rays == RaysPerPatch::by_power; }
    [[nodiscard]] bool learns() const { return hook_ && hook_->learns(); }
    void begin(const StepResult& result);
    /// Shoots all unshot power once; adds what arrives. Returns the number of rays.
    std::uint64_t bounce(std::uint64_t stream, StepResult& result);

    // These decide which rays are shot (bounces_plan.cpp).
    void plan(std::uint64_t stream);
    /// Lists some work items from `next` on, and moves it behind them. Returns false if none are
    /// left.
    bool cut(Place& next);
    void cut_line(Place& next);
    void cut_same_number(Place& next);
    // These add the rays to be drawn to `groups`.
    void schedule(const WorkItem& item, std::vector<RayGroup>& groups) const;
    void schedule(std::size_t sender, const WorkItem& item, const Allocation& allocation,
                  std::vector<RayGroup>& groups) const;
    void schedule_same_number(std::uint32_t patch, const WorkItem& item,
                              const Allocation& allocation, std::vector<RayGroup>& groups) const;

    // These shoot the rays.
    void shoot_items(const Workers& workers, std::uint64_t stream, StepResult& result);
    void shoot_item(const WorkItem& item, std::uint64_t stream, RayBatch& batch) const;
    void trace(std::uint64_t stream, RayBatch& batch) const;

    void collect(const RayBatch& batch, StepResult& result);
    void collect(const SeparateShots& shots, StepResult& result);
    /// The numbers of rays of one power that reached no patch.
    struct Lost {
        std::uint32_t escaped = 0, absorbed = 0, separate = 0;
    };
    /// Adds to `lost` how many rays reached no patch. Returning it by value would stall each call.
    void receive(const Vec3& power, std::span<const std::uint32_t> receivers, Lost& lost);
    void teach(const RayBatch& batch) const;
    void reflect(StepResult& result);
    void add_sender(std::uint32_t patch, const Vec3& power);

    const ShootingTools& tools_;
    SolverInput input_;
    StepHook* hook_; ///< the strategy's; nullptr: all steps are alike
    const StepTask* task_ = nullptr;

    // These belong to the current bounce.
    std::vector<std::uint32_t> senders_; ///< patches that hold power, ascending
    double left_ = 0;                    ///< their power, mean of channels
    std::vector<Vec3> unshot_;           ///< power by patch, of senders
    /// The expected number of rays of the senders before sender k, counted from the bounce's random
    /// offset.
    std::vector<double> rays_before_;
    std::vector<Arrived> received_;  ///< power by patch
    std::vector<std::uint64_t> hit_; ///< a bit for each patch that received any
    std::vector<WorkItem> items_;
    std::vector<RayBatch> batches_; ///< kept for their memory
};

} // namespace hemilux
