// Progressive radiosity on one page (paper section 3.1; Cohen, Chen, Wallace and Greenberg 1988).
//
// The patch with the largest unshot power shoots it to all others, by form factors that are found
// on the fly and then forgotten:
//
//     B_i and dB_i grow by rho_i dB_s F_si A_s / A_i,   dB_s becomes 0,   s the shooter.
//
// dB is the unshot part of B. An image may be shown after each shot, so a step is one shot. With
// --ambient the image includes a guess of what is still unshot: that it spreads evenly. The run
// ends when all but a little is shot.
//
// F_si is the share of cosine-distributed rays from s that hit i. Cohen et al. drew what s sees on
// the pixels of a hemicube; the paper's reference 12, and the engine, look from i to s instead.
//
// The parameter is --rays: each shot traces so many for each patch of the scene. They are of four
// independent batches, which share the shooter and nothing else. The result is their mean, and
// their spread its standard error, to which comes what is unshot.
//
// The method is good for a first picture after few shots, and needs no memory for pairs. It is bad
// for many patches that reflect much, as each shoots many times.

#include "geometry/compensated_sum.h"
#include "radiosity/paper/pages/batches.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solving/check_input.h"
#include "radiosity/paper/solving/progressive_options.h"

#include <array>
#include <cmath>
#include <utility>

namespace hemilux::plain {
namespace {

/// The share of the emitted power that is not shot in the end.
constexpr double rest = 1e-4;

/// The form factors F_si from one patch, and the shares of its rays that hit nothing or a back.
struct FormFactors {
    std::vector<double> to;
    double escaped = 0, absorbed = 0;
};

/// The light that a batch has found: radiosity, and its unshot part, by patch.
struct Light {
    std::vector<Vec3> B, dB;
};

class Progressive final : public Solver {
  public:
    explicit Progressive(const SolverInput& input)
        : input_(input), patches_(input.mesh.patches()), solution_(solution_before_steps(input)) {
        light_.fill({solution_.radiosity, solution_.radiosity}); // the emission, all unshot
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }
    [[nodiscard]] bool finished() const override {
        const EnergyBalance& energy = solution_.energy;
        const bool all_shot =
            !(mean_of_channels(energy.unshot) > rest * mean_of_channels(energy.emitted));
        return solution_.steps > 0 && (all_shot || !input_.needs.bounces);
    }

    bool step() override {
        std::uint32_t s = 0; // the shooter
        for (std::uint32_t i = 0; i < patches_.size(); ++i)
            if (mean_of_channels(unshot(i)) > mean_of_channels(unshot(s)))
                s = i;
        std::array<FormFactors, batches> F;
        for (std::size_t b = 0; b < batches; ++b)
            F[b] = find_factors(s, b);
        if (input_.monitor.interrupted)
            return false;
        for (std::size_t b = 0; b < batches; ++b)
            shoot(s, F[b], light_[b]);
        show();
        ++solution_.steps;
        return true;
    }

  private:
    /// Returns the unshot power of a patch, A_i dB_i, in the mean of the batches.
    [[nodiscard]] Vec3 unshot(std::size_t i) const {
        Vec3 dB(0.0);
        for (const Light& light : light_)
            dB += light.dB[i] / double(batches);
        return patches_[i].area * dB;
    }

    /// Returns the form factors from patch s to all others.
    [[nodiscard]] FormFactors find_factors(std::uint32_t s, std::size_t batch) {
        FormFactors F{.to = std::vector<double>(patches_.size())};
        const double rays =
            std::ceil(input_.options.rays * double(patches_.size()) / double(batches));
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

    void shoot(std::uint32_t s, const FormFactors& F, Light& light) {
        const Vec3 Phi = patches_[s].area * std::exchange(light.dB[s], Vec3(0.0));
        escaped_ += F.escaped * Phi;
        absorbed_ += F.absorbed * Phi;
        for (std::uint32_t i = 0; i < patches_.size(); ++i) {
            if (F.to[i] == 0)
                continue;
            const Vec3& rho = input_.mesh.material(i).reflectance;
            const Vec3 reflected = rho * (F.to[i] / patches_[i].area) * Phi;
            light.B[i] += reflected;
            light.dB[i] += reflected;
            absorbed_ += (1.0 - rho) * F.to[i] * Phi;
        }
    }

    /// Shows the mean of the batches. What is unshot will come to each patch as the ambient term of
    /// Cohen et al.: spread evenly and reflected again and again by the mean reflectance.
    void show() {
        std::array<std::vector<Vec3>, batches + 1> B; // of each batch, then their mean
        B[batches].assign(patches_.size(), Vec3(0.0));
        Vec3 power(0.0), reflectance(0.0); // unshot, and the mean times the area
        double area = 0;
        for (std::size_t b = 0; b < batches; ++b)
            B[b] = light_[b].B;
        for (std::uint32_t i = 0; i < patches_.size(); ++i) {
            for (const Light& light : light_)
                B[batches][i] += light.B[i] / double(batches);
            power += unshot(i);
            reflectance += patches_[i].area * input_.mesh.material(i).reflectance;
            area += patches_[i].area;
        }
        solution_.effective_freedom.reset(); // of other errors, before this shot
        combine_batches(input_.mesh, B, solution_);
        const Vec3 ambient = power / area / (1.0 - glm::min(reflectance / area, Vec3(.999)));
        solution_.missed = 0;
        for (std::uint32_t i = 0; i < patches_.size(); ++i) {
            const Vec3 missing = input_.mesh.material(i).reflectance * ambient;
            Vec3& sigma = solution_.standard_error[i];
            sigma = glm::sqrt(sigma * sigma + missing * missing);
            solution_.missed += patches_[i].area * glm::dot(missing, missing);
            if (input_.options.own.of<ProgressiveOptions>().ambient)
                solution_.radiosity[i] += missing;
        }
        const double to_world = input_.mesh.frame().area_to_world(1 / double(batches));
        solution_.energy.absorbed = to_world * absorbed_.value();
        solution_.energy.escaped = to_world * escaped_.value();
        solution_.energy.unshot = input_.mesh.frame().area_to_world(1.0) * power;
    }

    SolverInput input_;
    std::span<const Patch> patches_;
    std::array<Light, batches> light_;
    CompensatedSum<Vec3> absorbed_, escaped_; ///< power, over all batches
    Solution solution_;                       ///< shown after the last shot
};

} // namespace

std::unique_ptr<Solver> progressive(const SolverInput& input) {
    return std::make_unique<Progressive>(input);
}

} // namespace hemilux::plain
