// The technique of 1997 on one page (paper section 4; Jolivet and Plemenos, GraphiCon 1997).
//
// A patch is divided, in thought, into parts with a hemisphere over the centre of each. In n steps
// all spherical triangles are divided into four at new directions on their edges, nearer to the end
// where more surfaces were counted, and are stored. In m further steps they are divided by
// estimated counts, and nothing is stored (stored_subdivision.h). Every triangle gets the same
// number of rays; its energy goes by its area. Plain progressive refinement follows, and is also
// the pilot of step.h. n, m and the number of parts are the user's (subdivision_1997.h).
//
// With --literal (`printed_`) the rules are those of the print; beside each stands the corrected
// one (docs/decisions.md, D1, D2, D4, D10, D34 and D61).

#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/pages/step.h"
#include "radiosity/paper/pages/stored_subdivision.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

namespace hemilux::plain {
namespace {

class Hemisphere1997 final : public StepSolver {
  public:
    explicit Hemisphere1997(const SolverInput& input)
        : StepSolver(input, !input.options.literal), printed_(input.options.literal),
          n(static_cast<int>(input.options.own.of<Subdivision1997Options>().stored_steps)),
          m(static_cast<int>(input.options.own.of<Subdivision1997Options>().estimated_steps)),
          parts_(input.options.own.of<Subdivision1997Options>().parts), tree_(n),
          stored_(input.mesh.patches().size() * parts_) {
        if (!printed_)
            divide_to(n);
    }

  private:
    /// Returns A_tr / A_hemi.
    [[nodiscard]] double area(const SphericalTriangle& tr) const {
        using std::numbers::pi;
        return printed_ ? tr.solid_angle() / (2 * pi)
                        : std::max(tr.projected_solid_angle() / pi, 0.0);
    }

    /// Divides the triangles of all hemispheres until they are of this level, and counts.
    void divide_to(int level) {
        for (; divided_ < std::min(level, n); ++divided_)
            for (std::size_t h = 0; h < stored_.size() && !input_.monitor.interrupted; ++h) {
                const auto patch = static_cast<std::uint32_t>(h / parts_);
                const Polygon& shape = input_.mesh.patches()[patch].shape;
                const Vec3 centre = part_of(shape, parts_, h % parts_).centre();
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
        divide_to(std::cmp_less(step, n) ? static_cast<int>(step) + 1 : n);
        const double least = printed_ ? 1e-4 * result.power_unshot() : 0; // or it never ends
        for (std::uint64_t bounce = 0; result.power_unshot() > least; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean)) {
                if (input_.monitor.interrupted)
                    return false;
                if (std::cmp_less(step, n + m))
                    shoot(due, static_cast<int>(step) + 1, result);
                else
                    shoot_plainly(due,
                                  printed_ ? rays_rounded(input_.options.rays) : rays_on_line(due),
                                  result);
            }
            result.reflect();
        }
        return true;
    }

    /// Shoots through the triangles of a level over each part.
    void shoot(const Due& due, int level, Step& result) const {
        const Patch& patch = input_.mesh.patches()[due.patch];
        const Frame frame = input_.mesh.hemisphere_frame(due.patch);
        const std::size_t of_part = std::size_t{4} << (2 * level), all = parts_ * of_part;
        const double N_hemi = printed_ ? input_.options.rays : due.rays();
        const double N_tr = N_hemi / double(all);
        double from = due.begin;
        std::uint32_t number = 0;
        for (std::size_t k = 0; k < all; ++k) {
            const double share = double(k + 1) / double(all);
            const double to = k + 1 < all ? due.begin + N_hemi * share : due.end;
            const std::size_t index = k % of_part;
            Rays rays = printed_ ? rays_rounded(std::max(N_tr, 1.0)) : rays_on_line(N_tr, from, to);
            from = to;
            if (rays.number == 0)
                continue;
            const CountedTriangle abc =
                stored_[parts_ * due.patch + k / of_part].triangle(level, index, tree_);
            const std::vector<Vec3> known = // as printed, those that were counted shoot too
                printed_ && level <= n ? counted_directions(abc, level, index)
                                       : std::vector<Vec3>();
            rays.number += known.size();
            rays.divisor += double(known.size());
            const SphericalTriangle tr(abc[0].direction, abc[1].direction, abc[2].direction);
            const Polygon part = part_of(patch.shape, parts_, k / of_part);
            const PolygonSampler points(part);
            const Vec3 Phi_ray = // Phi_tr / N_tr, Phi_tr = Phi_patch A_part / A_patch A_tr / A_hemi
                1 / rays.divisor * (part.area() / patch.area * area(tr)) * result.unshot[due.patch];
            for (std::uint64_t i = 0; i < rays.number; ++i, ++number) {
                RayNumbers random(due.key, number);
                Rng in_triangle(hash_words({due.key & 0xffffffff, due.key >> 32, number}));
                const Vec3 start = printed_ ? part.centre() : points.sample(random.start());
                const Vec3 direction =
                    i < known.size() ? known[i]
                                     : tr.sample_rejection([&] { return in_triangle.uniform(); });
                result.shoot(patch, start, frame.to_world(direction), Phi_ray);
            }
        }
    }

    bool printed_;
    int n, m; ///< steps whose triangles are stored, and estimated
    std::size_t parts_;
    Hemisphere tree_;
    int divided_ = -1;                      ///< the last level that is stored
    std::vector<StoredSubdivision> stored_; ///< by patch and part
};

} // namespace

std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input) {
    return std::make_unique<Hemisphere1997>(input);
}

} // namespace hemilux::plain
