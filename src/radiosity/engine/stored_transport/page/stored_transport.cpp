// The principle of stored transport (not in the paper).
//
// Each patch looks around along cosine-distributed rays and counts which patches they hit. With
// S_ij = A_i F_ij = A_j F_ji the counts c of both sides estimate one number,
//
//     S_ij = (c_ij + c_ji) / (N / A_i + N / A_j),   N rays from each patch,
//
// and row i must sum to A_i less what its own rays lost. Scaling S_ij by g_i g_j makes it so and
// leaves S symmetric (Sinkhorn and Knopp 1967); the little that is missing then goes to S_ii. So no
// energy is made or lost between patches. All bounces are then solved on S: no ray is traced twice.
//
// Four independent batches of rays give four solutions, whose spread gives the standard error; the
// result is the solution of all rays together. The engine adds what makes it fast: sparse rows,
// Sobol points, more rays where the error is, shadow rays to small emitters, conjugate gradients.

#include "radiosity/engine/stored_transport/page/stored_transport.h"

#include "geometry/compensated_sum.h"
#include "radiosity/paper/pages/batches.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/check_input.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace hemilux::plain {
namespace {

constexpr int scalings = 20;
constexpr int max_sweeps = 100'000;

/// The counts of what rays hit; row i of c belongs to the rays of patch i.
struct Counts {
    explicit Counts(std::size_t n) : c(n * n), escaped(n), absorbed(n) {}
    std::vector<double> c, escaped, absorbed;
};

class StoredTransport final : public Solver {
  public:
    explicit StoredTransport(const SolverInput& input)
        : input_(input), n_(static_cast<std::uint32_t>(input.mesh.patches().size())),
          solution_(solution_before_steps(input)) {
        if (n_ > max_patches_of_stored_transport)
            throw std::invalid_argument("too many patches to keep all pairs of them");
        counts_.assign(batches + 1, Counts(n_));
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

    /// Doubles the rays, or adds as many as in the first step.
    bool step() override {
        const double first = std::ceil(input_.options.rays / double(batches));
        const double more = !input_.options.stop.steps && N_ > 0 ? N_ : first;
        for (std::size_t s = 0; s < batches; ++s)
            look_around(s, more);
        N_ += more;
        const double all = N_ * double(batches);
        std::array<std::vector<Vec3>, batches + 1> B; // of each batch, then of all rays
        for (std::size_t s = 0; s <= batches && !input_.monitor.interrupted; ++s)
            B[s] = solve(counts_[s], s < batches ? N_ : all);
        if (input_.monitor.interrupted)
            return false;
        combine_batches(input_.mesh, B, solution_);
        account(counts_[batches].escaped, all);
        ++solution_.steps;
        return true;
    }

  private:
    [[nodiscard]] double area(std::size_t i) const { return input_.mesh.patches()[i].area; }

    /// Traces so many more rays from each patch, for one batch and for all together.
    void look_around(std::size_t batch, double rays) {
        for (std::uint32_t i = 0; i < n_ && !input_.monitor.interrupted; ++i) {
            const auto start = PatchStart::in_any_axes(input_.mesh, i);
            Rng random(hash_words({input_.options.seed, batch, i, solution_.steps}));
            for (auto left = static_cast<std::uint64_t>(rays); left > 0 && area(i) > 0; --left) {
                const auto hit = input_.tracer.closest(start.cosine_ray(random));
                const std::uint32_t j = hit ? input_.mesh.patch_at(*hit) : none;
                for (Counts* const to : {&counts_[batch], &counts_[batches]})
                    ++(!hit ? to->escaped[i] : j == none ? to->absorbed[i] : to->c[i * n_ + j]);
                solution_.hits[j == none ? i : j] += j != none;
                ++solution_.rays_energy;
                ++input_.monitor.rays;
            }
        }
    }

    /// Returns S with closed rows.
    [[nodiscard]] std::vector<double> exchange(const Counts& counts, double N) const {
        std::vector<double> S(std::size_t{n_} * n_), due, rays_per_area, g(n_, 1.0), sum(n_);
        for (std::size_t i = 0; i < n_; ++i) {
            rays_per_area.push_back(area(i) > 0 ? N / area(i) : 0);
            due.push_back(area(i) * (1 - (counts.escaped[i] + counts.absorbed[i]) / N));
        }
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j)
                if (const double both = counts.c[i * n_ + j] + counts.c[j * n_ + i]; both > 0)
                    S[i * n_ + j] = both / (rays_per_area[i] + rays_per_area[j]);
        for (int k = 0; k <= scalings; ++k) {
            for (std::size_t i = 0; i < n_; ++i) {
                sum[i] = 0;
                for (std::size_t j = 0; j < n_; ++j)
                    sum[i] += g[i] * S[i * n_ + j] * g[j];
            }
            for (std::size_t i = 0; i < n_ && k < scalings; ++i)
                g[i] *= sum[i] > 0 ? std::sqrt(due[i] / sum[i]) : 0;
        }
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t j = 0; j < n_; ++j)
                S[i * n_ + j] *= g[i] * g[j];
            S[i * n_ + i] += due[i] - sum[i];
        }
        return S;
    }

    /// Applies B_i = E_i + rho_i / A_i sum_j S_ij B_j again and again until nothing changes (Gauss
    /// and Seidel).
    [[nodiscard]] std::vector<Vec3> solve(const Counts& counts, double N) const {
        const std::vector<double> S = exchange(counts, N);
        std::vector<Vec3> B(n_, Vec3(0.0));
        double change = 1, all = 0;
        for (int sweep = 0; change > 1e-12 * all && !input_.monitor.interrupted; ++sweep) {
            if (sweep == max_sweeps)
                throw SolveError("these rays have not seen where light leaves the scene or is "
                                 "absorbed; a larger --rays looks for it with more",
                                 0);
            change = all = 0;
            for (std::uint32_t i = 0; i < n_; ++i) {
                Vec3 arriving(0.0);
                for (std::size_t j = 0; j < n_; ++j)
                    arriving += S[std::size_t{i} * n_ + j] * B[j];
                const Material& material = input_.mesh.material(i);
                const Vec3 before = B[i];
                B[i] = material.emission;
                if (area(i) > 0)
                    B[i] += material.reflectance * arriving / area(i);
                change += area(i) * mean_of_channels(glm::abs(B[i] - before));
                all += area(i) * mean_of_channels(B[i]);
            }
        }
        return B;
    }

    /// Notes where the power goes: what has not left the scene is absorbed.
    void account(const std::vector<double>& escaped, double rays) {
        CompensatedSum<Vec3> power;
        for (std::size_t i = 0; i < n_; ++i)
            power += area(i) * escaped[i] / rays * solution_.radiosity[i];
        EnergyBalance& energy = solution_.energy;
        energy.escaped = input_.mesh.frame().area_to_world(1.0) * power.value();
        energy.absorbed = energy.emitted - energy.escaped;
        energy.unshot = Vec3(0.0);
    }

    SolverInput input_;
    std::uint32_t n_;
    std::vector<Counts> counts_; ///< counts of each batch, then of all
    double N_ = 0;               ///< rays of each patch and batch
    Solution solution_;
};

} // namespace

std::unique_ptr<Solver> stored_transport(const SolverInput& input) {
    return std::make_unique<StoredTransport>(input);
}

} // namespace hemilux::plain
