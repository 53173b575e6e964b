// The full matrix on one page (paper section 2; Goral, Torrance, Greenberg and Battaile 1984).
//
// The form factors of all pairs of patches come first, then a linear system that holds all bounces:
//
//     B_i = E_i + rho_i sum_j F_ij B_j.
//
// F_ij is the share of the light of patch i that arrives at patch j. By Lambert's law it is the
// share of cosine-distributed rays from i that hit j, which also tells what stands between them.
// Gauss and Seidel solve the system: each equation gives its own unknown, again and again.
//
// The parameter is --rays, the rays from each patch in the first step; each further step doubles
// them. They are of four independent batches, whose solutions spread by their standard error. The
// result is the solution by all rays together. It is consistent: it depends on the factors in a
// non-linear way, so its bias falls as one over the rays, and its error more slowly.
//
// The method is good for reference, as nothing in it is clever. It is bad for many patches: it
// takes 40 bytes for each pair, and a sweep over all pairs for each bounce of the light.

#include "geometry/compensated_sum.h"
#include "radiosity/paper/pages/batches.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/check_input.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace hemilux::plain {
namespace {

constexpr int max_sweeps = 100'000;

/// The form factors F that so many rays from each patch have found.
struct FormFactors {
    explicit FormFactors(std::size_t n) : hits(n * n), escaped(n), absorbed(n) {}
    double rays = 0;
    std::vector<double> hits; ///< those of the rays of patch i that hit patch j, row by row
    std::vector<double> escaped, absorbed; ///< those that hit nothing, and the back of a face

    /// Returns sum_j F_ij B_j: the light that arrives at patch i.
    [[nodiscard]] Vec3 arriving(std::size_t i, const std::vector<Vec3>& B) const {
        Vec3 sum(0.0);
        for (std::size_t j = 0; j < B.size(); ++j)
            sum += hits[i * B.size() + j] / rays * B[j];
        return sum;
    }
};

class Matrix final : public Solver {
  public:
    explicit Matrix(const SolverInput& input)
        : input_(input), patches_(input.mesh.patches()), solution_(solution_before_steps(input)) {
        if (patches_.size() > max_patches_of_matrix)
            throw std::invalid_argument("too many patches to keep all pairs of them");
        factors_.assign(batches + 1, FormFactors(patches_.size()));
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }
    [[nodiscard]] bool finished() const override {
        return !input_.needs.bounces && solution_.steps > 0;
    }

    bool step() override {
        const double first = std::ceil(input_.options.rays / double(batches));
        const double more = solution_.steps > 0 ? factors_[0].rays : first;
        std::array<std::vector<Vec3>, batches + 1> B; // of each batch, then of all rays
        for (std::size_t s = 0; s < batches; ++s)
            find_factors(s, more);
        for (std::size_t s = 0; s <= batches && !input_.monitor.interrupted; ++s)
            B[s] = solve(factors_[s]);
        if (input_.monitor.interrupted)
            return false;
        combine_batches(input_.mesh, B, solution_);
        account(factors_[batches], B[batches]);
        ++solution_.steps;
        return true;
    }

  private:
    /// Traces so many more rays from each patch, for one batch and for all together.
    void find_factors(std::size_t batch, double more) {
        for (std::uint32_t i = 0; i < patches_.size() && !input_.monitor.interrupted; ++i) {
            const auto start = PatchStart::in_any_axes(input_.mesh, i);
            Rng random(hash_words({input_.options.seed, batch, i, solution_.steps}));
            for (double ray = 0; ray < more && patches_[i].area > 0; ++ray) {
                const auto hit = input_.tracer.closest(start.cosine_ray(random));
                const std::uint32_t j = hit ? input_.mesh.patch_at(*hit) : none;
                for (FormFactors* const F : {&factors_[batch], &factors_[batches]})
                    ++(!hit        ? F->escaped[i]
                       : j == none ? F->absorbed[i]
                                   : F->hits[i * patches_.size() + j]);
                solution_.hits[j == none ? i : j] += j != none;
                ++solution_.rays_energy;
                ++input_.monitor.rays;
            }
        }
        factors_[batch].rays += more;
        factors_[batches].rays += more;
    }

    /// Applies B_i = E_i + rho_i sum_j F_ij B_j to one patch after another, until a sweep over all
    /// changes nothing.
    [[nodiscard]] std::vector<Vec3> solve(const FormFactors& F) const {
        std::vector<Vec3> B(patches_.size(), Vec3(0.0));
        double change = 1, all = 0;
        for (int sweep = 0; change > 1e-12 * all && !input_.monitor.interrupted; ++sweep) {
            if (sweep == max_sweeps)
                throw SolveError("these rays have not seen where light leaves the scene or is "
                                 "absorbed; a larger --rays looks for it with more",
                                 0);
            change = all = 0;
            for (std::uint32_t i = 0; i < B.size(); ++i) {
                const Material& material = input_.mesh.material(i); // E_i and rho_i
                const Vec3 before = B[i];
                B[i] = material.emission + material.reflectance * F.arriving(i, B);
                change += patches_[i].area * mean_of_channels(glm::abs(B[i] - before));
                all += patches_[i].area * mean_of_channels(B[i]);
            }
        }
        return B;
    }

    /// Notes where the power goes. A_i F_ij and A_j F_ji are equal but for chance; what the balance
    /// lacks for that counts as unshot.
    void account(const FormFactors& F, const std::vector<Vec3>& B) {
        CompensatedSum<Vec3> absorbed, escaped;
        for (std::uint32_t i = 0; i < B.size(); ++i) {
            const double area = input_.mesh.frame().area_to_world(patches_[i].area);
            escaped += area * F.escaped[i] / F.rays * B[i];
            absorbed += area * F.absorbed[i] / F.rays * B[i];
            absorbed += area * (1.0 - input_.mesh.material(i).reflectance) * F.arriving(i, B);
        }
        EnergyBalance& energy = solution_.energy;
        energy.absorbed = absorbed.value();
        energy.escaped = escaped.value();
        energy.unshot = energy.emitted - energy.absorbed - energy.escaped;
    }

    SolverInput input_;
    std::span<const Patch> patches_;
    std::vector<FormFactors> factors_; ///< those of each batch, then of all
    Solution solution_;
};

} // namespace

std::unique_ptr<Solver> matrix(const SolverInput& input) { return std::make_unique<Matrix>(input); }

} // namespace hemilux::plain
