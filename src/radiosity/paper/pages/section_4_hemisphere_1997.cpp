// The technique of 1997 on one page (paper section 4; Jolivet and Plemenos, GraphiCon 1997).
//
// A patch is divided, in thought, into parts with a hemisphere over the centre of each. In n steps
// all spherical triangles are divided into four at new directions on their edges, nearer to the end
// where more surfaces were counted, and are stored. In m further steps they are divided by
// estimated counts, and nothing is stored (stored_subdivision.h). Plain progressive refinement
// follows. First stand the rules of the print, which --literal keeps, and beside them the corrected
// ones (D numbers: docs/paper/decisions.md).

#include "radiosity/paper/hemisphere/subdivision_1997_options.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/pages/step.h"
#include "radiosity/paper/pages/stored_subdivision.h"

#include <algorithm>
#include <numbers>

namespace hemilux::plain {
namespace {

using std::numbers::pi;

struct Printed {
    /// A_tr / A_hemi are areas on the sphere, which breaks Lambert's law (D1).
    static double area(const SphericalTriangle& tr) { return tr.solid_angle() / (2 * pi); }
    /// Dim patches shoot N_hemi rays too (D10), one at least into each triangle (D34).
    static Rays rays(const Due&, double N_hemi, std::size_t /*k*/, std::size_t triangles) {
        return rays_rounded(std::max(N_hemi / double(triangles), 1.0));
    }
    static Rays rays(const Due&, double N_hemi) { return rays_rounded(N_hemi); }
    /// Rays start at the centre of the part (D2).
    static Vec3 start(const Polygon& part, RayNumbers) { return part.centre(); }
    /// Triangles are divided between the steps, and the rays that count also carry energy (D61).
    static constexpr bool counts_by_the_way = true;
    /// The last light would cost as many rays as the first, so this share of it is not shot (D10).
    static constexpr double rest = 1e-4;
};

struct Corrected {
    /// A_tr / A_hemi are areas of the projection to the patch's plane, as Lambert's law asks.
    static double area(const SphericalTriangle& tr) { return tr.projected_solid_angle() / pi; }
    /// Patches shoot by their power. Triangle k owns as long a part of the line as any other.
    static Rays rays(const Due& due, double /*N_hemi*/, std::size_t k, std::size_t triangles) {
        const auto of_all = [&](std::size_t n) { return double(n) / double(triangles); };
        return rays_on_line(due, of_all(k), of_all(k + 1));
    }
    static Rays rays(const Due& due, double /*N_hemi*/) { return rays_on_line(due); }
    /// Rays start anywhere on the part.
    static Vec3 start(const Polygon& part, RayNumbers u) { return part.sample(u.start()); }
    /// All triangles are divided, and all surfaces counted, before the first step.
    static constexpr bool counts_by_the_way = false;
    /// All light is shot: dim patches have few rays, and chance ends the last ones.
    static constexpr double rest = 0;
};

template <class Rules>
class Hemisphere1997 final : public StepSolver {
  public:
    Hemisphere1997(const SolverInput& input, const Subdivision1997Options& numbers)
        : StepSolver(input, Rules::rest == 0), own_(numbers), tree_(n()),
          stored_(input.mesh.patches().size() * own_.parts) {
        if (!Rules::counts_by_the_way)
            divide_to(n());
    }

  private:
    [[nodiscard]] int n() const { return static_cast<int>(own_.stored_steps); }

    /// Divides the triangles of all hemispheres until they are of this level, and counts.
    void divide_to(int level) {
        for (; divided_ < level; ++divided_)
            for (std::size_t h = 0; h < stored_.size() && !input_.monitor.interrupted; ++h) {
                const auto patch = static_cast<std::uint32_t>(h / own_.parts);
                const Polygon& whole = input_.mesh.patches()[patch].shape;
                const Vec3 centre = part_of(whole, own_.parts, h % own_.parts).centre();
                stored_[h].divide_to(divided_ + 1, tree_, [&](const Vec3& direction) {
                    return count_surfaces(patch, centre, direction);
                });
            }
        mean_.solution.bytes_density = 0;
        for (const StoredSubdivision& stored : stored_)
            mean_.solution.bytes_density += stored.bytes();
    }

    /// Shoots a ray for each patch, each triangle and each direction, bounce after bounce.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        const bool guided = step < own_.stored_steps + own_.estimated_steps; // n + m
        const int level = guided ? static_cast<int>(step) + 1 : n();
        divide_to(std::min(level, n()));
        const double rest = Rules::rest * result.power_unshot();
        for (std::uint64_t bounce = 0; result.power_unshot() > rest; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean)) {
                if (input_.monitor.interrupted)
                    return false;
                if (guided)
                    shoot(due, level, result);
                else
                    shoot_plainly(due, Rules::rays(due, input_.options.rays), result);
            }
            result.reflect();
        }
        return true;
    }

    /// Shoots through the triangles of a level over each part.
    void shoot(const Due& due, int level, Step& result) const {
        const std::size_t triangles = std::size_t{4} << (2 * level), all = own_.parts * triangles;
        std::uint32_t number = 0; // of the ray, among those of the patch
        for (std::size_t part = 0; part < own_.parts; ++part)
            for (std::size_t k = 0; k < triangles; ++k) {
                const Rays N_tr = Rules::rays(due, input_.options.rays, part * triangles + k, all);
                if (N_tr.number > 0)
                    shoot(due, {part, k, level}, N_tr, number, result);
            }
    }

    struct Place { ///< of a triangle
        std::size_t part, index;
        int level;
    };
    /// Shoots through one triangle. `number` is that of its first ray, then that after its last.
    void shoot(const Due& due, const Place& at, Rays N_tr, std::uint32_t& number,
               Step& result) const {
        const Patch& patch = input_.mesh.patches()[due.patch];
        const Frame frame = input_.mesh.hemisphere_frame(due.patch);
        const Polygon part = part_of(patch.shape, own_.parts, at.part);
        const CountedTriangle abc =
            stored_[own_.parts * due.patch + at.part].triangle(at.level, at.index, tree_);
        std::vector<Vec3> counted; // the directions of the rays that counted in this step
        if (Rules::counts_by_the_way && at.level <= n())
            counted = counted_directions(abc, at.level, at.index);
        N_tr.number += counted.size();
        N_tr.divisor += double(counted.size());
        const SphericalTriangle tr(abc[0].direction, abc[1].direction, abc[2].direction);
        const double A_tr = part.area() / patch.area * std::max(Rules::area(tr), 0.0);
        const Vec3 Phi_ray = 1 / N_tr.divisor * A_tr * result.unshot[due.patch];
        for (std::size_t i = 0; i < N_tr.number; ++i, ++number) {
            Rng random(hash_words({due.key & 0xffffffff, due.key >> 32, number}));
            const auto u = [&] { return random.uniform(); };
            const Vec3 direction = i < counted.size() ? counted[i] : tr.sample_rejection(u);
            result.shoot(patch, Rules::start(part, RayNumbers(due.key, number)),
                         frame.to_world(direction), Phi_ray);
        }
    }

    Subdivision1997Options own_;
    Hemisphere tree_;
    int divided_ = -1;                      ///< the last level that is stored
    std::vector<StoredSubdivision> stored_; ///< hemispheres, by patch and part
};

} // namespace

std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input) {
    return hemisphere_1997(input, {});
}

std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input,
                                        const Subdivision1997Options& numbers) {
    if (input.options.literal)
        return std::make_unique<Hemisphere1997<Printed>>(input, numbers);
    return std::make_unique<Hemisphere1997<Corrected>>(input, numbers);
}

} // namespace hemilux::plain
