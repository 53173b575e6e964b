// The paper on one page: NewHemisphereRadiosity (section 5; Plemenos and Jolivet 1998).
//
// These are the procedures of the paper, with its names. First stand the rules of the print, which
// --literal keeps, and beside them the corrected ones (D numbers: docs/paper/decisions.md).

#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/pages/step.h"

#include <algorithm>
#include <numbers>

namespace hemilux::plain {
namespace {

using Cell = Hemisphere::Cell; // a spherical triangle
using std::numbers::pi;

struct Printed {
    /// A_tr / A_hemi are areas on the sphere, which breaks Lambert's law (D1).
    static double area(const Cell& tr) { return tr.solid_angle / (2 * pi); }
    /// D_tr is what was counted: where that is nothing, no ray takes the power (D5).
    static double density(double D_tr, double /*D_average*/) { return D_tr; }
    /// Dim patches shoot N_hemi rays too (D10). Where N_tr rounds to 0, power is lost (D4).
    static Rays rays(const Due&, double N_hemi, double from, double to) {
        return rays_rounded(N_hemi * (to - from));
    }
    /// Rays start at the centre of their patch (D2).
    static Vec3 start(const Patch& from, RayNumbers) { return from.centre; }
    /// The last light would cost as many rays as the first, so this share of it is not shot (D10).
    static constexpr double rest = 1e-4;
};

struct Corrected {
    /// A_tr / A_hemi are areas of the projection to the patch's plane, as Lambert's law asks.
    static double area(const Cell& tr) { return tr.projected_solid_angle / pi; }
    /// D_tr is one surface at least, and a quarter of the average: all power has rays.
    static double density(double D_tr, double D_average) {
        return std::max({D_tr, 1.0, D_average / 4});
    }
    /// Patches shoot by their power, N_hemi rays on average. Each triangle gets the rays that stand
    /// on its part of the patch's line: N_tr, rounded up or down.
    static Rays rays(const Due& due, double /*N_hemi*/, double from, double to) {
        return rays_on_line(due, from, to);
    }
    /// Rays start anywhere on their patch.
    static Vec3 start(const Patch& from, RayNumbers u) { return from.shape.sample(u.start()); }
    /// All light is shot: dim patches have few rays, and chance ends the last ones.
    static constexpr double rest = 0;
};

template <class Rules>
class NewHemisphereRadiosity final : public StepSolver {
  public:
    explicit NewHemisphereRadiosity(const SolverInput& scene)
        : StepSolver(scene, Rules::rest == 0), hemisphere_(scene.options.depth) {
        const std::size_t patches = scene.mesh.patches().size();
        for (std::uint32_t i = 0; i < patches && !scene.monitor.interrupted; ++i)
            preprocessing(i);
    }

  private:
    struct Triangle { ///< not divided
        const Cell* tr;
        double D_tr;
    };
    using Triangles = std::vector<Triangle>; ///< all of a patch's hemisphere

    /// Procedure Preprocessing (Scene), for one patch. Triangles share vertices, so the surfaces
    /// along the ray to each vertex are counted once.
    void preprocessing(std::uint32_t patch) {
        constexpr int not_counted = -1;
        std::vector<int> counts(hemisphere_.vertices().size(), not_counted);
        const auto count = [&](std::uint16_t vertex) {
            if (counts[vertex] == not_counted)
                counts[vertex] = count_surfaces(patch, input_.mesh.patches()[patch].centre,
                                                hemisphere_.vertices()[vertex]);
            return counts[vertex];
        };
        Triangles& triangles = triangles_.emplace_back();
        for (std::size_t root = 0; root < 4; ++root)
            divide(hemisphere_.cells()[root], count, triangles);
        const double average = D_average(triangles);
        for (Triangle& t : triangles)
            t.D_tr = Rules::density(t.D_tr, average);
        mean_.solution.bytes_density += triangles.size() * sizeof(Triangle);
    }

    /// Divides a triangle if its density is above ThresholdValue and its level below MaxLevel.
    template <class CountAtVertex>
    void divide(const Cell& tr, const CountAtVertex& count, Triangles& triangles) const {
        const double D_tr = (count(tr.vertex[0]) + count(tr.vertex[1]) + count(tr.vertex[2])) / 3.0;
        if (D_tr > input_.options.threshold && tr.level < hemisphere_.depth())
            for (std::size_t child = 0; child < 4; ++child)
                divide(hemisphere_.cells()[tr.first_child + child], count, triangles);
        else
            triangles.push_back({&tr, D_tr});
    }

    /// Returns D_average, weighted by area, so that all N_tr sum to N_hemi.
    static double D_average(const Triangles& triangles) {
        double sum = 0;
        for (const auto& [tr, D_tr] : triangles)
            sum += Rules::area(*tr) * D_tr;
        return sum;
    }

    /// What the loop of procedure Compute Radiosity (Scene) does: a step. It is a whole solution,
    /// bounce after bounce, which is then combined with those of the steps before.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        const double rest = Rules::rest * result.power_unshot();
        for (std::uint64_t bounce = 0; result.power_unshot() > rest; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean)) { // for each patch of Scene
                if (input_.monitor.interrupted)
                    return false;
                shoot(due, result);
            }
            result.reflect();
        }
        return true;
    }

    /// Shoots what a patch has received, through all triangles of its hemisphere.
    void shoot(const Due& due, Step& result) const {
        const Patch& patch = input_.mesh.patches()[due.patch];
        const Frame frame = input_.mesh.hemisphere_frame(due.patch);
        const Triangles& triangles = triangles_[due.patch];
        const double average = D_average(triangles);
        if (average == 0) // as printed, there are no rays where nothing was seen
            return;
        double from = 0;
        for (std::uint32_t number = 0; const auto& [tr, D_tr] : triangles) { // for each triangle
            // N_tr / N_hemi = A_tr / A_hemi D_tr / D_average is the length of its part of the line.
            const double to = from + Rules::area(*tr) * D_tr / average;
            const Rays N_tr = Rules::rays(due, input_.options.rays, from, to);
            from = to;
            // Phi_ray = Phi_tr / N_tr, Phi_tr = Phi_patch A_tr / A_hemi
            const Vec3 Phi_ray = 1 / N_tr.divisor * Rules::area(*tr) * result.unshot[due.patch];
            for (std::uint64_t ray = 0; ray < N_tr.number; ++ray) { // for each direction
                RayNumbers random(due.key, number++);
                const Vec3 direction = frame.to_world(tr->shape.sample_rejection(random)); // cosine
                result.shoot(patch, Rules::start(patch, random), direction, Phi_ray);
            }
        }
    }

    Hemisphere hemisphere_;
    std::vector<Triangles> triangles_; ///< those of each patch
};

} // namespace

std::unique_ptr<Solver> hemisphere(const SolverInput& scene) {
    if (scene.options.literal)
        return std::make_unique<NewHemisphereRadiosity<Printed>>(scene);
    return std::make_unique<NewHemisphereRadiosity<Corrected>>(scene);
}

Solution new_hemisphere_radiosity(const SolverInput& scene, Useful useful) {
    const std::unique_ptr<Solver> image = hemisphere(scene); // Preprocessing (Scene)
    while (!useful(image->solution()) && image->step()) {    // Compute Radiosity (Scene)
    }
    return image->solution();
}

} // namespace hemilux::plain
