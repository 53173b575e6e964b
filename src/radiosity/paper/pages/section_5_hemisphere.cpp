// The paper on one page: NewHemisphereRadiosity (section 5; Plemenos and Jolivet 1998).
//
// These are the two procedures of the paper, with its names. With --literal (`printed_`) the rules
// are those of the print. They break Lambert's law (docs/decisions.md, D1) and start rays at
// centres (D2). They lose triangles that are due less than half a ray (D4) or count nothing (D5),
// and shoot as many rays from a dim patch as from an emitter (D10). Beside each stands the
// corrected rule.

#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/pages/step.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace hemilux::plain {
namespace {

using Cell = Hemisphere::Cell;

/// A triangle that is not divided. It keeps N_tr / N_hemi in floats, summed over the triangles up
/// to this one.
struct Triangle {
    const Cell* tr;
    float D_tr, N_up_to = 0;
};

class NewHemisphereRadiosity final : public StepSolver {
  public:
    explicit NewHemisphereRadiosity(const SolverInput& input)
        : StepSolver(input, !input.options.literal), printed_(input.options.literal),
          hemisphere_(input.options.depth) {
        const std::size_t patches = input.mesh.patches().size();
        for (std::uint32_t i = 0; i < patches && !input.monitor.interrupted; ++i)
            preprocessing(i);
    }

  private:
    /// Returns A_tr / A_hemi.
    [[nodiscard]] double area(const Cell& tr) const {
        using std::numbers::pi;
        return printed_ ? tr.solid_angle / (2 * pi) : tr.projected_solid_angle / pi;
    }

    /// Returns D_tr as it counts in the number of rays.
    [[nodiscard]] double density(double D_tr, double D_average) const {
        return printed_ ? D_tr : std::max({D_tr, 1.0, D_average / 4});
    }

    /// Divides each spherical triangle of the patch's hemisphere where its density is above the
    /// threshold.
    void preprocessing(std::uint32_t patch) {
        std::vector<int> counts(hemisphere_.vertices().size(), -1);
        const auto count = [&](std::uint16_t vertex) { // which triangles share
            if (counts[vertex] < 0)
                counts[vertex] = count_surfaces(patch, input_.mesh.patches()[patch].centre,
                                                hemisphere_.vertices()[vertex]);
            return counts[vertex];
        };
        std::vector<Triangle>& triangles = triangles_.emplace_back();
        const std::function<void(const Cell&)> visit = [&](const Cell& tr) {
            const int sum = count(tr.vertex[0]) + count(tr.vertex[1]) + count(tr.vertex[2]);
            const double D_tr = sum / 3.0;
            if (D_tr > input_.options.threshold && tr.level < hemisphere_.depth())
                for (std::size_t child = 0; child < 4; ++child)
                    visit(hemisphere_.cells()[tr.first_child + child]);
            else
                triangles.push_back({&tr, static_cast<float>(D_tr)});
        };
        for (std::size_t root = 0; root < 4; ++root)
            visit(hemisphere_.cells()[root]);
        find_rays(triangles);
        mean_.solution.bytes_density += triangles.size() * sizeof(Triangle);
    }

    /// Finds N_tr / N_hemi = A_tr / A_hemi D_tr / D_average. D_average is weighted by area, so that
    /// all N_tr sum to N_hemi.
    void find_rays(std::vector<Triangle>& triangles) const {
        double counted = 0, D_average = 0, sum = 0;
        for (const Triangle& t : triangles)
            counted += area(*t.tr) * t.D_tr;
        for (const Triangle& t : triangles)
            D_average += area(*t.tr) * density(t.D_tr, counted);
        if (!(D_average > 0)) // nothing was counted: no ray, as printed
            return;
        for (float before = 0; Triangle & t : triangles) {
            const double D_tr = density(t.D_tr, counted);
            sum += area(*t.tr) * D_tr / D_average;
            t.N_up_to = std::max(before, static_cast<float>(sum));
            if (t.N_up_to == before && D_tr > 0) // never left out
                t.N_up_to = std::nextafter(before, 2.0F);
            before = t.N_up_to;
        }
    }

    /// Shoots a ray for each patch, each triangle and each direction, bounce after bounce, until
    /// nothing is left or chance has ended it.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        const double least = printed_ ? 1e-4 * result.power_unshot() : 0; // or it never ends
        for (std::uint64_t bounce = 0; result.power_unshot() > least; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean)) {
                if (input_.monitor.interrupted)
                    return false;
                shoot(due, result);
            }
            result.reflect();
        }
        return true;
    }

    void shoot(const Due& due, Step& result) const {
        const Patch& patch = input_.mesh.patches()[due.patch];
        const Frame frame = input_.mesh.hemisphere_frame(due.patch);
        const PolygonSampler points(patch.shape);
        const double all = triangles_[due.patch].back().N_up_to;
        const double N_hemi = printed_ ? input_.options.rays : due.rays() / all;
        double before = 0, from = due.begin;
        std::uint32_t number = 0;
        for (const Triangle& t : triangles_[due.patch]) {
            const double to = t.N_up_to < all ? due.begin + N_hemi * t.N_up_to : due.end;
            const double N_tr = N_hemi * (t.N_up_to - std::exchange(before, t.N_up_to));
            const Rays rays = printed_ ? rays_rounded(N_tr) : rays_on_line(N_tr, from, to);
            from = to;
            const Vec3 Phi_ray = // Phi_tr / N_tr, Phi_tr = Phi_patch A_tr / A_hemi
                1 / rays.divisor * area(*t.tr) * result.unshot[due.patch];
            for (std::uint64_t k = 0; k < rays.number; ++k) {
                RayNumbers random(due.key, number++);
                const Vec3 start = printed_ ? patch.centre : points.sample(random.start());
                const Vec3 direction = t.tr->shape.sample_rejection(random);
                result.shoot(patch, start, frame.to_world(direction), Phi_ray);
            }
        }
    }

    bool printed_;
    Hemisphere hemisphere_;
    std::vector<std::vector<Triangle>> triangles_; ///< by patch
};

} // namespace

std::unique_ptr<Solver> hemisphere(const SolverInput& input) {
    return std::make_unique<NewHemisphereRadiosity>(input);
}

} // namespace hemilux::plain
