#include "radiosity/engine/emitters/lit_by_points.h"

#include "geometry/compensated_sum.h"
#include "geometry/numeric.h"
#include "radiosity/engine/emitters/light_of_points.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/missed_light.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// The independent estimates of D, whose spread is its error.
constexpr std::size_t estimates = 4;

/// The colours of patches that also emit what they reflect of the light of points.
class FirstReflection final : public VaryingColours {
  public:
    explicit FirstReflection(std::vector<Colours> of_patches)
        : of_patches_(std::move(of_patches)) {}

    [[nodiscard]] bool on(std::uint32_t) const override { return true; }
    [[nodiscard]] bool emission_on(std::uint32_t) const override { return true; }
    [[nodiscard]] std::vector<Colours> means(const Mesh&, std::span<const std::uint32_t> patches,
                                             unsigned) const override {
        std::vector<Colours> means;
        for (const std::uint32_t patch : patches)
            means.push_back(of_patches_[patch]);
        return means;
    }
    [[nodiscard]] Colours at(const Mesh& mesh, const Patch& patch, const Vec3&) const override {
        const Material& mean = mesh.material(patch);
        return {mean.reflectance, mean.emission};
    }

  private:
    std::vector<Colours> of_patches_;
};

LightOfPoints sampled(const SolverInput& input, std::uint64_t& traced) {
    constexpr std::size_t max_samples = 1u << 24, most = 256, least = 16;
    const std::size_t patches = input.mesh.patches().size();
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t s = 0; s < estimates; ++s)
        seeds.push_back(hash_words({input.options.seed, s, 0x706f696e74}));
    LightOfPoints points(input.mesh, input.tracer, std::move(seeds),
                         ranks_of(input.monitor.interrupted));
    const auto each = static_cast<std::uint32_t>(std::clamp(max_samples / patches, least, most));
    traced = points.sample_up_to(std::vector<std::uint32_t>(patches, each),
                                 Workers(input.options.threads), input.monitor);
    return points;
}

Mesh lit_mesh(const Mesh& mesh, const LightOfPoints& points) {
    std::vector<Colours> colours;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Material& material = mesh.material(i);
        colours.push_back({material.reflectance,
                           material.emission + material.reflectance * points.irradiance(i)});
    }
    Mesh lit = mesh;
    lit.vary_colours(std::make_shared<FirstReflection>(std::move(colours)));
    return lit;
}

class LitByPoints final : public EngineSolver {
  public:
    /// make(input) makes the method's solver.
    template <class Make>
    LitByPoints(Make make, const SolverInput& input)
        : input_(input), points_(sampled(input, traced_)),
          power_(power_of_points(input.mesh, input.tracer)), lit_(lit_mesh(input.mesh, points_)),
          solver_(
              make({lit_, input.tracer, input.options, input.monitor, input.needs, input.target})),
          planned_(dynamic_cast<EngineSolver*>(solver_.get())) {
        find_errors();
        take_solution();
    }

    bool step() override {
        const bool done = solver_->step();
        take_solution();
        return done;
    }
    void aim_at(double error) override {
        if (planned_)
            planned_->aim_at(error);
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }
    [[nodiscard]] std::uint32_t steps_ready() const override {
        return planned_ ? planned_->steps_ready() : 0;
    }
    [[nodiscard]] bool finished() const override { return solver_->finished(); }
    void save(StateWriter& state) const override {
        planned_ ? planned_->save(state) : EngineSolver::save(state);
    }
    void load(StateReader& state) override {
        planned_ ? planned_->load(state) : EngineSolver::load(state);
        take_solution();
    }

  private:
    /// Finds the variance of the first reflection by patch, and of all of it relative to itself.
    void find_errors() {
        Vec3 sum(0.0), variance_of_sum(0.0);
        for (std::uint32_t i = 0; i < lit_.patches().size(); ++i) {
            const double area = lit_.patches()[i].area;
            const Vec3 rho = lit_.material(i).reflectance, mean = points_.irradiance(i);
            Vec3 squares(0.0);
            for (std::size_t s = 0; s < estimates; ++s) {
                const Vec3 off = points_.irradiance(i, s) - mean;
                squares += off * off;
            }
            variance_.push_back(rho * rho * squares / double(estimates * (estimates - 1)));
            sum += area * rho * mean;
            variance_of_sum += area * area * variance_.back();
        }
        relative_ = ratio_or_zero(glm::sqrt(variance_of_sum), sum);
    }

    void take_solution() {
        solution_ = solver_->solution();
        solution_.rays_energy += traced_;
        const double share = 1 / double(variance_.size()); // of a patch, of all shadow rays
        double variance = 0;
        for (std::uint32_t i = 0; i < variance_.size(); ++i) {
            // What follows from the first reflection errs with all of it.
            const Vec3 level =
                relative_ * (solution_.radiosity[i] - input_.mesh.material(i).emission);
            const Vec3 more = variance_[i] + level * level;
            const double counts = solution_.weight_of(i) * lit_.patches()[i].area;
            Vec3& sigma = solution_.standard_error[i];
            sigma = glm::sqrt(sigma * sigma + more);
            solution_.hits[i] += points_.hits(i);
            variance += counts * glm::dot(more, Vec3(1.0));
            const double samples = double(points_.samples(i)) * double(estimates);
            const Vec3 one =
                lit_.material(i).reflectance * (samples > 0 ? points_.unblocked(i) / samples : 0.0);
            solution_.missed += rule_of_three * share * counts * glm::dot(one, one);
        }
        if (solution_.variance)
            *solution_.variance += variance;
        add_energy();
    }

    /// The method has taken the first reflection for emission.
    void add_energy() {
        CompensatedSum<Vec3> absorbed, reflected, arriving;
        for (std::uint32_t i = 0; i < lit_.patches().size(); ++i) {
            const Vec3 power = lit_.patches()[i].area * points_.irradiance(i);
            const Vec3 rho = lit_.material(i).reflectance;
            absorbed += (1.0 - rho) * power;
            reflected += rho * power;
            arriving += power;
        }
        const Vec3 lost = power_.sent - arriving.value();
        const Vec3 out = ratio_or_zero(power_.escaped, power_.escaped + power_.left_behind) * lost;
        const double to_world = lit_.frame().area_to_world(1.0);
        solution_.energy.emitted += to_world * (power_.sent - reflected.value());
        solution_.energy.escaped += to_world * out;
        solution_.energy.absorbed += to_world * (absorbed.value() + lost - out);
    }

    SolverInput input_;
    std::uint64_t traced_ = 0;
    LightOfPoints points_;
    PowerOfPoints power_;
    Mesh lit_;
    std::unique_ptr<Solver> solver_;
    EngineSolver* planned_;      ///< the same; null if it is a page
    std::vector<Vec3> variance_; ///< by patch [(W/m2)^2]
    Vec3 relative_{0.0};         ///< standard error of the first reflection of all patches
    Solution solution_;
};

} // namespace

std::unique_ptr<Solver> make_solver(const Method& method, const SolverInput& input, bool plain) {
    const auto make = [&](const SolverInput& of) -> std::unique_ptr<Solver> {
        return plain ? method.plain(of) : method.make(of);
    };
    if (point_emitters_of(input.mesh.scene()).empty() || (method.takes_points && !plain))
        return make(input);
    return std::make_unique<LitByPoints>(make, input);
}

} // namespace hemilux
