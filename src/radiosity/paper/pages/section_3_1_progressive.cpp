// Progressive radiosity on one page (paper section 3.1; Cohen, Chen, Wallace and Greenberg 1988).
//
// The patch s with the largest unshot power shoots it to all others, by form factors that are found
// on the fly and then forgotten:
//
//     B_i and dB_i grow by rho_i F_si A_s dB_s / A_i,   dB_s becomes 0.
//
// dB is the unshot part of B. An image may be shown after each shot, so a step is one shot; with
// --ambient the image includes a guess of what is unshot. The run ends when nearly all is shot.
// F_si is the share of cosine-distributed rays from s that hit i. Cohen et al. drew what s sees on
// the pixels of a hemicube; reference 12 of the paper, and the engine, look from i to s instead.
//
// The parameter is --rays: each shot traces so many for each patch of the scene. They are of four
// independent batches, which have the shooters in common and nothing else. The result is their
// mean. Its standard error comes from their spread, and from what is unshot.
//
// The method is good for a first picture after few shots, and needs no memory for pairs. It is bad
// for many patches that reflect much, as each shoots many times.

#include "geometry/compensated_sum.h"
#include "radiosity/paper/pages/batches.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solving/check_input.h"

#include <array>
#include <cmath>

namespace hemilux::plain {
namespace {

/// The share of the emitted power that is not shot in the end.
constexpr double rest = 1e-4;

/// The form factors F_si from one patch, and the shares of its rays that hit nothing or a back.
struct FormFactors {
    std::vector<double> to;
    double escaped = 0, absorbed = 0;
};

class Progressive final : public Solver {
  public:
    Progressive(const SolverInput& input, bool shows_ambient)
        : input_(input), shows_ambient_(shows_ambient), patches_(input.mesh.patches()),
          solution_(solution_before_steps(input)) {
        B_.fill(solution_.radiosity); // the emission, all of which is unshot
        dB_.fill(solution_.radiosity);
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }
    [[nodiscard]] bool finished() const override {
        const EnergyBalance& of = solution_.energy;
        const bool all_shot = mean_of_channels(of.unshot) <= rest * mean_of_channels(of.emitted);
        return solution_.steps > 0 && (all_shot || !input_.needs.bounces);
    }

    bool step() override {
        std::uint32_t s = 0;
        for (std::uint32_t i = 0; i < patches_.size(); ++i)
            if (mean_of_channels(unshot(i)) > mean_of_channels(unshot(s)))
                s = i;
        std::array<FormFactors, batches> F;
        for (std::size_t b = 0; b < batches; ++b)
            F[b] = find_factors(s, b);
        if (input_.monitor.interrupted)
            return false;
        for (std::size_t b = 0; b < batches; ++b)
            shoot(s, F[b], b);
        show();
        ++solution_.steps;
        return true;
    }

  private:
    /// Returns the unshot power of a patch, A_i dB_i, in the mean of the batches.
    [[nodiscard]] Vec3 unshot(std::uint32_t i) const {
        return patches_[i].area * mean_of_batches(dB_, i);
    }

    /// Returns the form factors from patch s to all others.
    [[nodiscard]] FormFactors find_factors(std::uint32_t s, std::size_t batch) {
        FormFactors F{.to = std::vector<double>(patches_.size())};
        const double of_shot = input_.options.rays * double(patches_.size());
        const double rays = std::ceil(of_shot / double(batches));
        const auto start = PatchStart::in_any_axes(input_.mesh, s);
        Rng random(hash_words({input_.options.seed, batch, solution_.steps}));
        for (double ray = 0; ray < rays && !input_.monitor.interrupted; ++ray) {
            const auto hit = input_.tracer.closest(start.cosine_ray(random));
            const std::uint32_t i = hit ? input_.mesh.patch_at(*hit) : none;
            (!hit ? F.escaped : i == none ? F.absorbed : F.to[i]) += 1 / rays;
            solution_.hits[i == none ? s : i] += i != none;
            ++solution_.rays_energy;
            ++input_.monitor.rays;
        }
        return F;
    }

    void shoot(std::uint32_t s, const FormFactors& F, std::size_t batch) {
        const Vec3 Phi = patches_[s].area * dB_[batch][s];
        dB_[batch][s] = Vec3(0.0);
        escaped_ += F.escaped * Phi / double(batches);
        absorbed_ += F.absorbed * Phi / double(batches);
        for (std::uint32_t i = 0; i < patches_.size(); ++i) {
            if (F.to[i] == 0)
                continue;
            const Vec3 rho = input_.mesh.material(i).reflectance;
            const Vec3 reflected = rho * F.to[i] * Phi / patches_[i].area;
            B_[batch][i] += reflected;
            dB_[batch][i] += reflected;
            absorbed_ += (1.0 - rho) * F.to[i] * Phi / double(batches);
        }
    }

    /// Shows the mean of the batches. What is unshot will come to each patch as the ambient term of
    /// Cohen et al. has it: spread evenly, and reflected again and again by the mean reflectance.
    void show() {
        Vec3 power(0.0), reflecting(0.0);
        double area = 0;
        for (std::uint32_t i = 0; i < patches_.size(); ++i) {
            B_[batches][i] = mean_of_batches(B_, i);
            power += unshot(i);
            reflecting += patches_[i].area * input_.mesh.material(i).reflectance;
            area += patches_[i].area;
        }
        const Vec3 ambient = power / area / (1.0 - glm::min(reflecting / area, Vec3(.999)));
        solution_.effective_freedom.reset(); // that of the errors before this shot
        combine_batches(input_.mesh, B_, solution_);
        add_missing(input_.mesh, ambient, solution_);
        for (std::uint32_t i = 0; i < patches_.size(); ++i)
            if (shows_ambient_)
                solution_.radiosity[i] += input_.mesh.material(i).reflectance * ambient;
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        solution_.energy = {solution_.energy.emitted, to_world * absorbed_.value(),
                            to_world * escaped_.value(), to_world * power};
    }

    SolverInput input_;
    bool shows_ambient_;
    std::span<const Patch> patches_;
    Solution solution_;                            ///< shown after the last shot
    std::array<std::vector<Vec3>, batches + 1> B_; ///< radiosity by batch and patch; then the mean
    std::array<std::vector<Vec3>, batches> dB_;    ///< the part of it that is unshot
    CompensatedSum<Vec3> absorbed_, escaped_;      ///< power, in the mean of the batches
};

} // namespace

std::unique_ptr<Solver> progressive(const SolverInput& input) { return progressive(input, false); }

std::unique_ptr<Solver> progressive(const SolverInput& input, bool ambient) {
    return std::make_unique<Progressive>(input, ambient);
}

} // namespace hemilux::plain
