// The technique of 1997 on one page (paper section 4; Jolivet and Plemenos, GraphiCon 1997).
//
// A patch is divided, in thought, into 2 x 2 parts with a hemisphere over the centre of each. In n
// steps all spherical triangles are divided into four at new directions on their edges, nearer to
// the end where more surfaces were counted, and are stored; in m further steps they are divided by
// estimated counts, and nothing is stored. Every triangle gets the same number of rays; its energy
// goes by its area. Plain progressive refinement follows, and is also the pilot of step_mean.h.
//
// `Printed` and `Corrected`: docs/decisions.md, D1, D2, D4 and D34.

#include "geometry/polygon_sampler.h"
#include "radiosity/hemisphere/hemisphere.h"
#include "radiosity/plain/plain.h"
#include "radiosity/plain/ray_numbers.h"
#include "radiosity/plain/step_mean.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace hemilux::plain {
namespace {

constexpr int n = 2, m = 1; // the paper names no values

/// Of a triangle: a whole number, and Phi_tr / Phi_ray.
struct Rays {
    double number, divisor;
};

struct Printed {
    static constexpr bool equal_rays = false;
    static constexpr double least_unshot = 1e-4;
    static double area(const SphericalTriangle& tr) {
        return tr.solid_angle() / (2 * std::numbers::pi);
    }
    static double N_hemi(double asked, double /*by_power*/) { return asked; }
    static double N_tr(double N_hemi, double all) {
        return all > 1 ? std::max(std::round(N_hemi / all), 1.0) : std::round(N_hemi);
    }
    static Rays rays(double N_tr, double /*from*/, double /*to*/) { return {N_tr, N_tr}; }
    static Vec3 start(const Polygon& part, Vec2 /*u*/) { return part.centre(); }
};

struct Corrected { // numbers of rays as in hemisphere.cpp
    static constexpr bool equal_rays = true;
    static constexpr double least_unshot = 0;
    static double area(const SphericalTriangle& tr) {
        return std::max(tr.projected_solid_angle() / std::numbers::pi, 0.0);
    }
    static double N_hemi(double /*asked*/, double by_power) { return by_power; }
    static double N_tr(double N_hemi, double all) { return N_hemi / all; }
    static Rays rays(double N_tr, double from, double to) {
        const double whole = std::floor(to) - std::floor(from);
        return {whole, N_tr >= 1 ? whole : N_tr};
    }
    static Vec3 start(const Polygon& part, Vec2 u) { return PolygonSampler(part).sample(u); }
};

/// A direction in the patch's frame, and ns or ens: surfaces counted along it, or estimated.
struct Direction {
    Vec3 to;
    double ns;
};
using Triangle = std::array<Direction, 3>;

/// The new point F of an edge AB: AF / FB = ns(B) / ns(A), equation (1); halved where a count is 0.
/// ens(F) = (ens(A) BF + ens(B) AF) / AB.
Direction divide(const Direction& a, const Direction& b) {
    const double AF = a.ns > 0 && b.ns > 0 ? b.ns / (a.ns + b.ns) : 0.5, BF = 1 - AF; // AB = 1
    const double angle =
        std::atan2(glm::length(glm::cross(a.to, b.to - a.to)), glm::dot(a.to, b.to));
    const Vec3 f = std::sin((1 - AF) * angle) * a.to + std::sin(AF * angle) * b.to;
    return {std::sin(angle) > 0 ? glm::normalize(f) : a.to, a.ns * BF + b.ns * AF};
}

/// Of the four triangles that ABC is divided into.
Triangle child_of(const Triangle& abc, std::size_t child) {
    const auto& [a, b, c] = abc;
    const Direction ab = divide(a, b), bc = divide(b, c), ca = divide(c, a);
    const std::array<Triangle, 4> four{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    return four[child];
}

/// 2 x 2 parts of a quad, or the four of a triangle that are similar to it.
std::array<Polygon, 4> parts_of(const Polygon& shape) {
    const auto& [a, b, c, d] = shape.corner;
    const Vec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, cd = (c + d) / 2.0, da = (d + a) / 2.0;
    const Vec3 ca = (c + a) / 2.0, o = (ab + cd) / 2.0;
    if (shape.is_triangle())
        return {{{{a, ab, ca, ca}}, {{ab, b, bc, bc}}, {{ca, bc, c, c}}, {{ab, bc, ca, ca}}}};
    return {{{{a, ab, o, da}}, {{ab, b, bc, o}}, {{o, bc, c, cd}}, {{da, o, cd, d}}}};
}

/// As it is stored. (In one expression g++ 12.2 -O2 would leave out the rounding to floats.)
struct StoredDirection {
    std::array<float, 3> to;
    std::uint8_t ns;
};

template <class Rules>
class Hemisphere1997 final : public StepMean {
  public:
    explicit Hemisphere1997(const SolverInput& input)
        : StepMean(input, Rules::equal_rays), tree_(n) {
        for (std::uint32_t i = 0; i < input.mesh.patches().size() && !input.monitor.interrupted;
             ++i)
            for (const Polygon& part : parts_of(input.mesh.patches()[i].shape))
                count(i, part.centre());
        solution_.bytes_density = stored_.size() * sizeof(stored_[0]);
    }

  private:
    /// Directions are stored in floats. Which triangles share one is as in the regular subdivision,
    /// whose vertices are numbered in the order in which its triangles need them.
    void count(std::uint32_t patch, const Vec3& centre) {
        const std::size_t first = stored_.size();
        const auto store = [&](const Vec3& v) {
            const Vec3 off{v.x == 0 && v.y == 0 ? .01 : v.x, v.y, std::max(v.z, .01)}; // see D7
            Ray ray{centre, input_.mesh.hemisphere_frame(patch).to_world(glm::normalize(off))};
            ray.from = input_.mesh.patches()[patch].facet;
            stored_.push_back(
                {{float(v.x), float(v.y), float(v.z)},
                 static_cast<std::uint8_t>(std::min(input_.tracer.count(ray), 255U))});
            ++solution_.rays_density;
        };
        for (std::size_t v = 0; v < Hemisphere(0).vertices().size(); ++v)
            store(tree_.vertices()[v]);
        for (const Hemisphere::Cell& tr : tree_.cells())
            for (std::size_t edge = 0; tr.level < n && edge < 3; ++edge)
                if (first + tr.midpoint[edge] == stored_.size())
                    store(divide(stored(first + tr.vertex[edge]),
                                 stored(first + tr.vertex[(edge + 1) % 3]))
                              .to);
    }

    [[nodiscard]] Direction stored(std::size_t at) const {
        const auto& [x, y, z] = stored_[at].to;
        return {glm::normalize(Vec3(x, y, z)), double(stored_[at].ns)};
    }

    [[nodiscard]] Triangle triangle(std::size_t hemisphere, int level, std::size_t index) const {
        if (level > n)
            return child_of(triangle(hemisphere, level - 1, index / 4), index % 4);
        const auto& v = tree_.cells()[Hemisphere::cells_up_to(level - 1) + index].vertex;
        const std::size_t first = hemisphere * tree_.vertices().size();
        return {stored(first + v[0]), stored(first + v[1]), stored(first + v[2])};
    }

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
                    shoot(i, step, hash_words({stream, i}), std::exchange(line, to), to, result);
                }
            result.reflect();
        }
        return true;
    }

    void shoot(std::uint32_t patch, std::uint64_t step, std::uint64_t key, double begin, double end,
               Step& result) const {
        const Patch& its = input_.mesh.patches()[patch];
        const auto parts = parts_of(its.shape);
        const Frame frame = input_.mesh.hemisphere_frame(patch);
        const bool guided = step < n + m;
        const int level = guided ? static_cast<int>(step) + 1 : 0;
        const std::size_t of_part = std::size_t{4} << (2 * level), all = guided ? 4 * of_part : 1;
        const double N_hemi = Rules::N_hemi(input_.options.rays, end - begin);
        const double N_tr = Rules::N_tr(N_hemi, double(all));
        double from = begin;
        std::uint32_t number = 0;
        for (std::size_t k = 0; k < all; ++k) {
            const double to = k + 1 < all ? begin + N_hemi * (double(k + 1) / double(all)) : end;
            const Rays rays = Rules::rays(N_tr, std::exchange(from, to), to);
            Polygon part = its.shape;
            SphericalTriangle tr;
            double share = 1; // of the patch's power
            if (guided && rays.number > 0) {
                const Triangle abc = triangle(4 * patch + k / of_part, level, k % of_part);
                tr = {abc[0].to, abc[1].to, abc[2].to};
                part = parts[k / of_part];
                share = part.area() / its.area * Rules::area(tr);
            }
            const Vec3 Phi_ray = 1 / rays.divisor * share * result.unshot[patch];
            for (auto left = static_cast<std::uint64_t>(rays.number); left > 0; --left, ++number) {
                RayNumbers random(key, number);
                Rng in_triangle(hash_words({key & 0xffffffff, key >> 32, number}));
                const auto uniform = [&] { return in_triangle.uniform(); };
                Ray ray{guided ? Rules::start(part, random.start())
                               : PolygonSampler(part).sample(random.start()),
                        frame.to_world(guided ? tr.sample_rejection(uniform)
                                              : cosine_direction({random.next(), random.next()}))};
                ray.from = its.facet;
                result.receive(input_.tracer.closest(ray), Phi_ray);
            }
        }
    }

    Hemisphere tree_;
    std::vector<StoredDirection> stored_; ///< by patch, part and vertex of the tree
};

} // namespace

std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input) {
    if (input.options.literal)
        return std::make_unique<Hemisphere1997<Printed>>(input);
    return std::make_unique<Hemisphere1997<Corrected>>(input);
}

} // namespace hemilux::plain
