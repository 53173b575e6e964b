#pragma once
// Compute Radiosity, the loops of paper section 5b, for any strategy.
//
// Each step is a complete, unbiased solution of all bounces (docs/decisions.md, D11): power is shot
// from all patches that hold some, what arrives is reflected and shot in turn, until nothing is
// left. Rays are dealt in proportion to the power to be shot (D10), so that each carries about the
// same; numbers of rays are made whole by systematic sampling over all patches and cells at once,
// which is unbiased and ends the series of bounces by itself. The solution is the mean of the
// steps, its standard error their spread.

#include "geometry/frame.h"
#include "radiosity/hemisphere.h"
#include "radiosity/rng.h"
#include "radiosity/strategy.h"
#include "radiosity/workers.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace hemilux {

class ShootingSolver final : public Solver {
  public:
    ShootingSolver(const SolverInput& input, MakeStrategy make_strategy);

    bool step() override;
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    /// Rays of one cell: N_tr of them, each carrying ray_power of the patch's power.
    struct Burst {
        std::uint32_t patch;
        std::uint32_t rays;
        double ray_power; ///< Phi_ray / Phi_patch
    };
    /// What some consecutive patches shot and where each ray arrived.
    struct Volley {
        std::vector<Burst> bursts;
        std::vector<std::uint32_t> receivers; ///< a patch, `escaped` or `absorbed`, ray by ray
    };
    /// Where the power of one step went, and how much of it there was in all.
    struct StepTally {
        Vec3 absorbed{0.0}, escaped{0.0};
        double shot = 0; ///< sum over bounces of the power to be shot, mean of channels
        std::uint64_t rays = 0;
        std::vector<std::uint32_t> hits; ///< per patch
    };
    static constexpr std::uint32_t escaped = 0xffffffff, absorbed = 0xfffffffe;

    /// One solution of all bounces from emission on. False when interrupted.
    bool solve_once(std::uint64_t stream, std::vector<Vec3>& radiosity, StepTally& tally);
    /// Shoots all unshot power once; adds what arrives. Returns the number of rays.
    std::uint64_t bounce(std::uint64_t stream, const std::vector<Vec3>& unshot,
                         std::vector<Vec3>& received, StepTally& tally);
    void plan(std::uint64_t stream, const std::vector<Vec3>& unshot);
    void shoot(std::uint32_t patch, std::uint64_t stream, std::vector<CellShare>& shares,
               Volley& volley) const;
    [[nodiscard]] std::uint32_t trace(std::uint32_t patch, const Frame& frame, std::uint16_t cell,
                                      Rng& rng) const;
    void receive(const Volley& volley, const std::vector<Vec3>& unshot, std::vector<Vec3>& received,
                 StepTally& tally);
    bool find_ray_power();
    [[nodiscard]] Vec3 one_ray(std::uint32_t patch) const;
    void combine(const std::vector<Vec3>& radiosity, const StepTally& tally);

    SolverInput input_;
    Workers workers_;
    Hemisphere hemisphere_;
    std::unique_ptr<Strategy> strategy_;
    double ray_power_ = 0; ///< power per ray, mean of channels; 0 until the pilot has found it
    /// Expected rays of the patches before patch i, counted from the bounce's random offset.
    std::vector<double> rays_before_;
    std::vector<Vec3> squares_; ///< sum of squared deviations of the steps (Welford 1962)
    Vec3 power_absorbed_{0.0}, power_escaped_{0.0};
    Solution solution_;
};

/// Method::make of a strategy.
template <MakeStrategy make_strategy>
[[nodiscard]] std::unique_ptr<Solver> shoot_with(const SolverInput& input) {
    return std::make_unique<ShootingSolver>(input, make_strategy);
}

} // namespace hemilux
