// The paper on one page: NewHemisphereRadiosity (section 5; Plemenos and Jolivet 1998).
//
// The two procedures of the paper with its names. `Printed` and `Corrected` are its rules and ours,
// side by side: the print breaks Lambert's law (docs/decisions.md, D1), starts at centres (D2),
// loses triangles that are due less than half a ray (D4) or count nothing (D5), and shoots as many
// rays from a dim patch as from a lamp (D10).

#include "radiosity/hemisphere/hemisphere.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/plain/plain.h"
#include "radiosity/plain/ray_numbers.h"
#include "radiosity/plain/step_mean.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace hemilux::plain {
namespace {

using Cell = Hemisphere::Cell;
constexpr double pi = std::numbers::pi;

/// Of a triangle: a whole number, and Phi_tr / Phi_ray.
struct Rays {
    double number, divisor;
};

struct Printed {
    static constexpr bool equal_rays = false;
    static constexpr double least_unshot = 1e-4; ///< of what is emitted: else it would not end
    /// A_tr / A_hemi
    static double area(const Cell& tr) { return tr.solid_angle / (2 * pi); }
    /// D_tr as it counts
    static double density(double D_tr, double /*D_average*/) { return D_tr; }
    static double N_hemi(double asked, double /*by_power*/) { return asked; }
    static Rays rays(double N_tr, double /*from*/, double /*to*/) {
        return {std::round(N_tr), std::round(N_tr)};
    }
    static Vec3 start(const Patch& patch, const PolygonSampler&, Vec2) { return patch.centre; }
};

/// Patches and their triangles own intervals of one line, as long as the rays that they are due; a
/// ray stands at each whole number. So N_tr is rounded up or down, right on average. Below one ray,
/// the ray that is shot carries the power of those that are not.
struct Corrected {
    static constexpr bool equal_rays = true;
    static constexpr double least_unshot = 0;
    static double area(const Cell& tr) { return tr.projected_solid_angle / pi; }
    static double density(double D_tr, double D_average) {
        return std::max({D_tr, 1.0, D_average / 4});
    }
    static double N_hemi(double /*asked*/, double by_power) { return by_power; }
    static Rays rays(double N_tr, double from, double to) {
        const double whole = std::floor(to) - std::floor(from);
        return {whole, N_tr >= 1 ? whole : N_tr};
    }
    static Vec3 start(const Patch&, const PolygonSampler& points, Vec2 u) {
        return points.sample(u);
    }
};

/// Not divided. Kept is N_tr / N_hemi, in floats and summed over the triangles up to this one.
struct Triangle {
    const Cell* tr;
    float D_tr, N_up_to = 0;
};

template <class Rules>
class NewHemisphereRadiosity final : public StepMean {
  public:
    explicit NewHemisphereRadiosity(const SolverInput& input)
        : StepMean(input, Rules::equal_rays), hemisphere_(input.options.depth) {
        for (std::uint32_t i = 0; i < input.mesh.patches().size() && !input.monitor.interrupted;
             ++i)
            preprocessing(i);
    }

  private:
    /// For each spherical triangle of the patch's hemisphere: divides it where its density is above
    /// the threshold.
    void preprocessing(std::uint32_t patch) {
        std::vector<int> counts(hemisphere_.vertices().size(), -1);
        const auto count = [&](std::uint16_t vertex) { // which triangles share
            if (counts[vertex] < 0) {
                Vec3 to = hemisphere_.vertices()[vertex];
                to = {to.x == 0 && to.y == 0 ? .01 : to.x, to.y, std::max(to.z, .01)}; // see D7
                Ray ray{input_.mesh.patches()[patch].centre,
                        input_.mesh.hemisphere_frame(patch).to_world(glm::normalize(to))};
                ray.from = input_.mesh.patches()[patch].facet;
                counts[vertex] = static_cast<int>(std::min(input_.tracer.count(ray), 255U));
                ++solution_.rays_density;
                ++input_.monitor.rays;
            }
            return counts[vertex];
        };
        std::vector<Triangle>& triangles = triangles_.emplace_back();
        const std::function<void(const Cell&)> visit = [&](const Cell& tr) {
            const int sum = count(tr.vertex[0]) + count(tr.vertex[1]) + count(tr.vertex[2]);
            const double density = sum / 3.0;
            if (density > input_.options.threshold && tr.level < hemisphere_.depth())
                for (std::size_t child = 0; child < 4; ++child)
                    visit(hemisphere_.cells()[tr.first_child + child]);
            else
                triangles.push_back({&tr, static_cast<float>(density)});
        };
        for (std::size_t root = 0; root < 4; ++root)
            visit(hemisphere_.cells()[root]);
        find_rays(triangles);
        solution_.bytes_density += triangles.size() * sizeof(Triangle);
    }

    /// N_tr / N_hemi = A_tr / A_hemi D_tr / D_average. By area, so that all N_tr sum to N_hemi.
    static void find_rays(std::vector<Triangle>& triangles) {
        double counted = 0, D_average = 0, sum = 0;
        for (const Triangle& t : triangles)
            counted += Rules::area(*t.tr) * t.D_tr;
        for (const Triangle& t : triangles)
            D_average += Rules::area(*t.tr) * Rules::density(t.D_tr, counted);
        if (!(D_average > 0)) // nothing was counted: no ray, as printed
            return;
        for (float before = 0; Triangle & t : triangles) {
            sum += Rules::area(*t.tr) * Rules::density(t.D_tr, counted) / D_average;
            t.N_up_to = std::max(before, static_cast<float>(sum));
            if (t.N_up_to == before && Rules::density(t.D_tr, counted) > 0) // never left out
                t.N_up_to = std::nextafter(before, 2.0F);
            before = t.N_up_to;
        }
    }

    /// For each patch, each triangle and each direction: shoots a ray; bounce after bounce, until
    /// nothing is left or chance has ended it.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        const auto patches = static_cast<std::uint32_t>(input_.mesh.patches().size());
        const double least = Rules::least_unshot * result.power_unshot();
        for (std::uint64_t bounce = 0; result.power_unshot() > least; ++bounce) {
            result.shot += result.power_unshot();
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            double line = Rng(stream).uniform();
            for (std::uint32_t i = 0; i < patches; ++i)
                if (mean_of_channels(result.unshot[i]) > 0) {
                    if (input_.monitor.interrupted)
                        return false;
                    const double to = line + mean_of_channels(result.unshot[i]) / Phi_mean;
                    shoot(i, hash_words({stream, i}), std::exchange(line, to), to, result);
                }
            result.reflect();
        }
        return true;
    }

    /// All power of a patch, which owns the line from `begin` to `end`.
    void shoot(std::uint32_t patch, std::uint64_t key, double begin, double end, Step& result) {
        const Patch& its = input_.mesh.patches()[patch];
        const Frame frame = input_.mesh.hemisphere_frame(patch);
        const PolygonSampler points(its.shape);
        const Vec3 Phi_patch = result.unshot[patch];
        const double all = triangles_[patch].back().N_up_to;
        const double N_hemi = Rules::N_hemi(input_.options.rays, (end - begin) / all);
        double before = 0, from = begin;
        std::uint32_t number = 0;
        for (const Triangle& t : triangles_[patch]) {
            const double to = t.N_up_to < all ? begin + N_hemi * t.N_up_to : end;
            const double N_tr = N_hemi * (t.N_up_to - std::exchange(before, t.N_up_to));
            const Rays rays = Rules::rays(N_tr, std::exchange(from, to), to);
            const Vec3 Phi_ray = // Phi_tr / N_tr, Phi_tr = Phi_patch A_tr / A_hemi
                1 / rays.divisor * Rules::area(*t.tr) * Phi_patch;
            for (auto left = static_cast<std::uint64_t>(rays.number); left > 0; --left) {
                RayNumbers random(key, number++);
                const auto uniform = [&] { return random.next(); };
                Ray ray{Rules::start(its, points, random.start()),
                        frame.to_world(t.tr->shape.sample_rejection(uniform))};
                ray.from = its.facet;
                result.receive(input_.tracer.closest(ray), Phi_ray);
            }
        }
    }

    Hemisphere hemisphere_;
    std::vector<std::vector<Triangle>> triangles_; ///< by patch
};

} // namespace

std::unique_ptr<Solver> hemisphere(const SolverInput& input) {
    if (input.options.literal)
        return std::make_unique<NewHemisphereRadiosity<Printed>>(input);
    return std::make_unique<NewHemisphereRadiosity<Corrected>>(input);
}

} // namespace hemilux::plain
