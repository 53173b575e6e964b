#include "radiosity/research/guiding/visibility_guide.h"

#include "parallel/workers.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/research/guiding/hemisphere_importance.h"
#include "radiosity/research/guiding/ray_densities.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// The numbers of rays from each patch before the first step. What steps teach costs no rays, but
/// comes late.
constexpr std::size_t rays_of_one_look = 32, rays_of_first_look = 16;

/// The number of first steps all of whose rays teach; then the rays of one step in four do.
constexpr std::uint64_t steps_of_learning = 8, later_training = 4;

/// The radiosity that all patches are assumed to have besides what is known of it, as a share of
/// the mean. The first step knows few rays, and a patch that none of them has hit is not black.
/// With a larger share, patches in the dark would seem to have sent more rays than they did.
constexpr double unknown_share = .05;

/// The largest values that are kept: they stay within what floats hold, whatever the areas.
constexpr double max_value = 1e12, max_rays_per_area = 1e18;

/// Returns true for the first four steps, then each time that the number of steps has grown by a
/// third or a half: 6, 8, 12, 16 ...
bool is_time_to_estimate(std::uint64_t step) {
    const std::uint64_t odd = step >> std::countr_zero(step);
    return step <= 4 || odd == 1 || odd == 3;
}

class VisibilityGuide final : public Strategy, StepHook {
  public:
    VisibilityGuide(const SolverInput& input, const Hemisphere& hemisphere, const Workers& workers,
                    bool learn)
        : mesh_(input.mesh), needs_(input.needs), hemisphere_(hemisphere), workers_(workers),
          first_leaf_(Hemisphere::cells_up_to(hemisphere.depth() - 1)), keeps_learning_(learn),
          known_(hemisphere, input.mesh.patches().size()),
          densities_(input.mesh.patches().size(), known_.shares()) {
        describe_sides();
        look(input);
    }

    [[nodiscard]] StepHook* step_hook() override { return this; }

    void prepare(std::span<const Vec3> radiosity, double ray_power) override {
        prepared_ = true;
        if (steps_ == 0 || (keeps_learning_ && is_time_to_estimate(steps_ + 1)))
            estimate_importance(radiosity);
        if (!keeps_learning_)
            known_.forget();
        const auto step = static_cast<double>(steps_ + 1);
        const double unknown = unknown_share * mean_radiosity(radiosity) / (step * step);
        for (std::size_t i = 0; i < sides_.size(); ++i)
            sides_[i].rays_per_area = static_cast<float>(std::min(
                (mean_of_channels(radiosity[i]) + unknown) / ray_power, max_rays_per_area));
    }

    void begin_step(std::uint64_t) override {
        const std::uint64_t step = steps_ + 1;
        learns_ = keeps_learning_ && prepared_ &&
                  (step <= steps_of_learning || step % later_training == 0);
        if (learns_)
            known_.drop_pending();
    }

    void end_step() override {
        steps_ += prepared_;
        training_steps_ += learns_;
        if (learns_)
            known_.commit(1);
    }

    [[nodiscard]] double rays_for_power(std::uint32_t patch) const override {
        return densities_.for_power(patch);
    }

    Allocation allocate(std::uint32_t patch, AllocatedCells& memory) const override {
        const double scale = 1 / densities_.for_power(patch);
        memory.clear();
        for (std::size_t t = 0; t < known_.leaves(); ++t)
            memory.add(static_cast<std::uint16_t>(first_leaf_ + t),
                       known_.share(t) * scale * densities_.of(patch, t));
        return memory.view();
    }

    [[nodiscard]] bool learns() const override { return learns_; }

    void find_arrivals(std::span<const Ray> rays, std::span<const std::uint32_t> receivers,
                       std::vector<std::uint16_t>& arrivals) const override {
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const bool arrived = receivers[k] < sides_.size();
            arrivals.push_back(
                arrived ? hemisphere_.leaf_at(frames_[receivers[k]].to_local(-rays[k].direction))
                        : whole_hemisphere);
        }
    }

    void learn(std::uint32_t patch, std::uint16_t cell, std::span<const std::uint32_t> receivers,
               std::span<const std::uint16_t> arrivals) override {
        const Side side = sides_[patch];
        const std::size_t leaf = cell - first_leaf_;
        const double sent = side.rays_per_area * densities_.of(patch, leaf); // D_it
        float sum = 0;
        for (std::size_t k = 0; k < receivers.size(); ++k) {
            if (receivers[k] >= sides_.size())
                continue;
            const Side& other = sides_[receivers[k]];
            const std::size_t there = arrivals[k] - first_leaf_;
            const double received =
                other.rays_per_area * densities_.of(receivers[k], there); // D_js
            const auto part = static_cast<float>(1 / (sent + received));
            sum += part * other.value;
            known_.add(receivers[k], there, part * side.value, 1);
        }
        known_.add(patch, leaf, sum, static_cast<float>(receivers.size()));
    }

    void save(StateWriter& state) const override;
    void load(StateReader& state) override;

    [[nodiscard]] std::uint64_t density_rays() const override { return rays_; }
    [[nodiscard]] std::uint64_t density_bytes() const override {
        return densities_.bytes() + (keeps_learning_ ? known_.bytes() : 0);
    }

  private:
    /// A patch as seen by another.
    struct Side {
        float value;         ///< rho^2 / A relative to the mean patch, mean of channels
        float rays_per_area; ///< sent in a step by a triangle of density 1, local units
    };
    /// The rays of one look from a patch, and what they hit.
    struct LookRays {
        std::vector<Ray> rays;
        std::vector<std::uint32_t> receivers;
        std::vector<std::uint16_t> cells, arrivals;
    };

    [[nodiscard]] std::size_t rays_of_look() const {
        return keeps_learning_ ? rays_of_first_look : rays_of_one_look;
    }
    [[nodiscard]] double mean_radiosity(std::span<const Vec3> radiosity) const;

    void describe_sides();
    void look(const SolverInput& input);
    void look_from(std::uint32_t patch, const SolverInput& input, LookRays& looks) const;
    void estimate_importance(std::span<const Vec3> radiosity);
    [[nodiscard]] double find_prior_mean() const;
    template <class Body>
    void for_patches(const Body& body) const;

    const Mesh& mesh_;
    const Needs& needs_;
    const Hemisphere& hemisphere_;
    Workers workers_;
    std::size_t first_leaf_;
    bool keeps_learning_, learns_ = false;
    bool prepared_ = false; ///< not before the pilot
    HemisphereImportance known_;
    RayDensities densities_;
    double training_steps_ = 0; ///< steps whose rays are in known_, the look being a part of one
    std::uint64_t steps_ = 0;   ///< steps that are done, without the pilot
    std::uint64_t rays_ = 0;
    std::vector<Side> sides_;   ///< sides by patch
    std::vector<Frame> frames_; ///< frames by patch
};

template <class Body>
void VisibilityGuide::for_patches(const Body& body) const {
    workers_.for_chunks(sides_.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
            if (needs_.power(i) && mesh_.patches()[i].area > 0)
                body(i);
    });
}

void VisibilityGuide::describe_sides() {
    double area = 0;
    for (const Patch& patch : mesh_.patches())
        area += patch.area;
    const double mean_area = area / static_cast<double>(mesh_.patches().size());
    for (std::uint32_t i = 0; i < mesh_.patches().size(); ++i) {
        const double own_area = mesh_.patches()[i].area;
        const Vec3& rho = mesh_.material(i).reflectance;
        const bool sends = needs_.power(i) && own_area > 0;
        const double value = own_area > 0 ? mean_of_channels(rho * rho) * mean_area / own_area : 0;
        const double rays = sends ? static_cast<double>(rays_of_look()) / own_area : 0;
        sides_.push_back({static_cast<float>(std::min(value, max_value)),
                          static_cast<float>(std::min(rays, max_rays_per_area))});
        frames_.push_back(mesh_.hemisphere_frame(i));
    }
}

/// Looks from all patches, and learns in their order, whichever thread looks.
void VisibilityGuide::look(const SolverInput& input) {
    constexpr std::size_t at_once = 1024;
    std::vector<LookRays> looks(std::min(at_once, sides_.size()));
    for (std::size_t begin = 0; begin < sides_.size(); begin += at_once)
        workers_.for_each_in_order(
            std::min(at_once, sides_.size() - begin),
            [&](std::size_t k) {
                look_from(static_cast<std::uint32_t>(begin + k), input, looks[k]);
            },
            [&](std::size_t k) {
                const LookRays& s = looks[k];
                for (std::size_t ray = 0; ray < s.rays.size(); ++ray)
                    learn(static_cast<std::uint32_t>(begin + k), s.cells[ray],
                          std::span(s.receivers).subspan(ray, 1),
                          std::span(s.arrivals).subspan(ray, 1));
                rays_ += s.rays.size();
            });
    input.monitor.rays += rays_;
    training_steps_ =
        static_cast<double>(rays_) / (input.options.rays * static_cast<double>(sides_.size()));
    known_.commit(training_steps_);
}

void VisibilityGuide::look_from(std::uint32_t patch, const SolverInput& input,
                                LookRays& looks) const {
    looks = {};
    if (!needs_.power(patch) || !(mesh_.patches()[patch].area > 0) || input.monitor.interrupted)
        return;
    constexpr std::uint64_t stream = 0x5ee2; // of no step
    SobolBlocks<4> points(hash_words({input.options.seed, stream, patch}));
    const PatchStart start(mesh_, patch, frames_[patch]);
    for (std::uint32_t k = 0; k < rays_of_look(); ++k) {
        const auto u = points.at(k);
        const Vec3 direction = cosine_direction({u[2], u[3]});
        looks.cells.push_back(hemisphere_.leaf_at(direction));
        looks.rays.push_back(start.ray({u[0], u[1]}, direction));
    }
    find_receivers(looks.rays, mesh_, input.tracer, looks.receivers);
    find_arrivals(looks.rays, looks.receivers, looks.arrivals);
}

double VisibilityGuide::mean_radiosity(std::span<const Vec3> radiosity) const {
    double power = 0, area = 0;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        power += mesh_.patches()[i].area * mean_of_channels(radiosity[i]);
        area += mesh_.patches()[i].area;
    }
    return area > 0 ? power / area : 0;
}

/// Returns the mean importance over the patches that shoot.
double VisibilityGuide::find_prior_mean() const {
    std::vector<double> importance(sides_.size());
    for_patches([&](std::uint32_t i) {
        importance[i] = known_.sum_of(i) / (training_steps_ * mesh_.patches()[i].area);
    });
    double sum = 0, patches = 0;
    for (std::uint32_t i = 0; i < importance.size(); ++i) {
        sum += importance[i];
        patches += needs_.power(i);
    }
    return patches > 0 ? sum / patches : 0;
}

void VisibilityGuide::estimate_importance(std::span<const Vec3> radiosity) {
    const double prior_mean = find_prior_mean(), energy = importance_of_energy(mesh_, radiosity);
    std::vector<double> roots(sides_.size()); // mean of sqrt(V) over a patch's power
    for_patches([&](std::uint32_t i) {
        thread_local std::vector<double> importance;
        importance.resize(known_.leaves());
        known_.estimate(i, 1 / (training_steps_ * mesh_.patches()[i].area), prior_mean, importance);
        for (std::size_t t = 0; t < importance.size(); ++t)
            roots[i] += known_.share(t) * densities_.keep(i, t, std::sqrt(importance[t] + energy));
    });
    double power = 0, sum = 0;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const double shot = mesh_.patches()[i].area * mean_of_channels(radiosity[i]);
        power += shot;
        sum += shot * roots[i];
    }
    densities_.set_mean(power > 0 ? sum / power : 0);
    for_patches([&](std::uint32_t i) { densities_.find_for_power(i); });
}

/// Saves no rays_per_area, which follows from the radiosity before each step.
void VisibilityGuide::save(StateWriter& state) const {
    state.add(steps_);
    state.add(training_steps_);
    densities_.save(state);
    if (keeps_learning_)
        known_.save(state);
}

void VisibilityGuide::load(StateReader& state) {
    steps_ = state.whole_up_to(std::numeric_limits<std::uint32_t>::max());
    const double of_look = training_steps_; // each step adds one at most
    training_steps_ = state.number({of_look, of_look + static_cast<double>(steps_)});
    densities_.load(state);
    if (keeps_learning_)
        known_.load(state);
    for_patches([&](std::uint32_t i) { densities_.find_for_power(i); });
}

} // namespace

std::unique_ptr<Strategy> make_visibility_guide(const SolverInput& input,
                                                const Hemisphere& hemisphere,
                                                const Workers& workers, bool learn) {
    return std::make_unique<VisibilityGuide>(input, hemisphere, workers, learn);
}

double bytes_of_visibility_guide(int depth, double patches) {
    return 18 * patches *
           (double(Hemisphere::cells_up_to(depth)) - double(Hemisphere::cells_up_to(depth - 1)));
}

} // namespace hemilux
