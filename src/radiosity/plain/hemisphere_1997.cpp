// The technique of 1997 on one page (paper section 4; Jolivet and Plemenos, GraphiCon 1997).
//
// A patch is divided, in thought, into 2 x 2 parts with a hemisphere over the centre of each. In n
// steps all spherical triangles are divided into four at new directions on their edges, nearer to
// the end where more surfaces were counted, and are stored; in m further steps they are divided by
// estimated counts, and nothing is stored. Every triangle gets the same number of rays; its energy
// goes by its area. Plain progressive refinement follows, and is also the pilot of step.h.
//
// With --literal (`printed_`) the rules are those of the print; beside each stands the corrected
// one (docs/decisions.md, D1, D2, D4, D10 and D34).

#include "radiosity/hemisphere/hemisphere.h"
#include "radiosity/plain/plain.h"
#include "radiosity/plain/step.h"
#include "radiosity/plain/stored_directions.h"
#include "radiosity/scene/edge_division.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace hemilux::plain {
namespace {

constexpr int n = 2, m = 1; // the paper names no values

using Triangle = std::array<Direction, 3>;

/// The new point F of an edge AB: AF / FB = ns(B) / ns(A), equation (1); halved where a count is 0.
/// ens(F) = (ens(A) BF + ens(B) AF) / AB.
Direction divide(const Direction& a, const Direction& b) {
    const double AF = a.ns > 0 && b.ns > 0 ? b.ns / (a.ns + b.ns) : 0.5, BF = 1 - AF; // AB = 1
    return {point_on_arc(a.to, b.to, AF), a.ns * BF + b.ns * AF};
}

/// One of the four triangles that ABC is divided into.
Triangle child_of(const Triangle& abc, std::size_t child) {
    const auto& [a, b, c] = abc;
    const Direction ab = divide(a, b), bc = divide(b, c), ca = divide(c, a);
    const std::array<Triangle, 4> four{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    return four[child];
}

class Hemisphere1997 final : public StepSolver {
  public:
    explicit Hemisphere1997(const SolverInput& input)
        : StepSolver(input, !input.options.literal), printed_(input.options.literal), tree_(n) {
        const std::size_t patches = input.mesh.patches().size();
        for (std::uint32_t i = 0; i < patches && !input.monitor.interrupted; ++i)
            for (const Polygon& part : quarters_of(input.mesh.patches()[i].shape))
                count(i, part.centre());
        mean_.solution.bytes_density = stored_.bytes();
    }

  private:
    /// A_tr / A_hemi.
    [[nodiscard]] double area(const SphericalTriangle& tr) const {
        using std::numbers::pi;
        return printed_ ? tr.solid_angle() / (2 * pi)
                        : std::max(tr.projected_solid_angle() / pi, 0.0);
    }

    /// Which triangles share a direction is as in the regular subdivision, whose vertices are
    /// numbered in the order in which its triangles need them.
    void count(std::uint32_t patch, const Vec3& centre) {
        const std::size_t first = stored_.size();
        const auto store = [&](const Vec3& v) { stored_.add(v, count_surfaces(patch, centre, v)); };
        for (std::size_t v = 0; v < Hemisphere(0).vertices().size(); ++v)
            store(tree_.vertices()[v]);
        for (const Hemisphere::Cell& tr : tree_.cells()) {
            const auto corner = [&](std::size_t k) { return stored_.at(first + tr.vertex[k % 3]); };
            for (std::size_t edge = 0; tr.level < n && edge < 3; ++edge)
                if (first + tr.midpoint[edge] == stored_.size())
                    store(divide(corner(edge), corner(edge + 1)).to);
        }
    }

    [[nodiscard]] Triangle triangle(std::size_t hemisphere, int level, std::size_t index) const {
        if (level > n)
            return child_of(triangle(hemisphere, level - 1, index / 4), index % 4);
        const auto& v = tree_.cells()[Hemisphere::cells_up_to(level - 1) + index].vertex;
        const std::size_t first = hemisphere * tree_.vertices().size();
        return {stored_.at(first + v[0]), stored_.at(first + v[1]), stored_.at(first + v[2])};
    }

    /// For each patch, each triangle and each direction: shoots a ray; bounce after bounce.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        const double least = printed_ ? 1e-4 * result.power_unshot() : 0; // or it never ends
        for (std::uint64_t bounce = 0; result.power_unshot() > least; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean)) {
                if (input_.monitor.interrupted)
                    return false;
                if (step < n + m)
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

    /// Through the triangles of a level over each part.
    void shoot(const Due& due, int level, Step& result) const {
        const Patch& patch = input_.mesh.patches()[due.patch];
        const auto parts = quarters_of(patch.shape);
        const Frame frame = input_.mesh.hemisphere_frame(due.patch);
        const std::size_t of_part = std::size_t{4} << (2 * level), all = 4 * of_part;
        const double N_hemi = printed_ ? input_.options.rays : due.rays();
        const double N_tr = N_hemi / double(all);
        double from = due.begin;
        std::uint32_t number = 0;
        for (std::size_t k = 0; k < all; ++k) {
            const double share = double(k + 1) / double(all);
            const double to = k + 1 < all ? due.begin + N_hemi * share : due.end;
            const Rays rays =
                printed_ ? rays_rounded(std::max(N_tr, 1.0)) : rays_on_line(N_tr, from, to);
            from = to;
            if (rays.number == 0)
                continue;
            const Triangle abc = triangle(4 * due.patch + k / of_part, level, k % of_part);
            const SphericalTriangle tr(abc[0].to, abc[1].to, abc[2].to);
            const Polygon& part = parts[k / of_part];
            const PolygonSampler points(part);
            const Vec3 Phi_ray = // Phi_tr / N_tr, Phi_tr = Phi_patch A_part / A_patch A_tr / A_hemi
                1 / rays.divisor * (part.area() / patch.area * area(tr)) * result.unshot[due.patch];
            for (std::uint64_t left = rays.number; left > 0; --left, ++number) {
                RayNumbers random(due.key, number);
                Rng in_triangle(hash_words({due.key & 0xffffffff, due.key >> 32, number}));
                const Vec3 start = printed_ ? part.centre() : points.sample(random.start());
                const Vec3 direction = tr.sample_rejection([&] { return in_triangle.uniform(); });
                result.shoot(patch, start, frame.to_world(direction), Phi_ray);
            }
        }
    }

    bool printed_;
    Hemisphere tree_;
    StoredDirections stored_; ///< by patch, part and vertex of the tree
};

} // namespace

std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input) {
    return std::make_unique<Hemisphere1997>(input);
}

} // namespace hemilux::plain
