#include "radiosity/engine/emitters/small_emitters.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/engine/factors/pairs/point_to_patch.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// Emitters that together fill more than this share of the view are found by random rays.
constexpr double largest_share = .3;

/// The most points from which the view is judged, and the most products of points and emitters.
constexpr std::size_t max_points = 512, max_views = 400'000;

/// One side of a facet that emits, as if it were not divided.
struct EmittingSide {
    std::uint32_t first, count; ///< among the emitting patches, side by side
    double area = 0;            ///< local units
    double brightness = 0;      ///< mean of channels [W/m2]
};

std::vector<std::uint32_t> emitting_patches(const Mesh& mesh) {
    std::vector<std::uint32_t> emitters;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        if (mesh.patches()[i].area * mean_of_channels(mesh.material(i).emission) > 0)
            emitters.push_back(i);
    // A side's patches follow each other; those of two sides alternate in the mesh.
    std::ranges::stable_sort(emitters, {}, [&](std::uint32_t i) {
        const Patch& patch = mesh.patches()[i];
        return std::pair(patch.facet, patch.back);
    });
    return emitters;
}

std::vector<EmittingSide> sides_of(const Mesh& mesh, const std::vector<std::uint32_t>& emitters) {
    std::vector<EmittingSide> sides;
    for (std::uint32_t k = 0; k < emitters.size(); ++k) {
        const Patch& patch = mesh.patches()[emitters[k]];
        const bool same = k > 0 && mesh.patches()[emitters[k - 1]].facet == patch.facet &&
                          mesh.patches()[emitters[k - 1]].back == patch.back;
        if (!same)
            sides.push_back({k, 0, 0, mean_of_channels(mesh.material(emitters[k]).emission)});
        ++sides.back().count;
        sides.back().area += patch.area;
    }
    return sides;
}

/// The points from which the view is judged. They lie on patches that reflect, each as likely as
/// its share of the area, in equal steps along it.
class Views {
  public:
    Views(const Mesh& mesh, std::size_t points) : mesh_(mesh) {
        double total = 0;
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
            total += reflecting_area(i);
        Rng rng(hash_words({points}));
        double before = 0;
        const double each = total / static_cast<double>(points);
        double next = each / 2;
        for (std::uint32_t i = 0; i < mesh.patches().size() && points_.size() < points; ++i) {
            const double end = before + reflecting_area(i);
            for (; next < end && points_.size() < points; next += each)
                points_.push_back(
                    {i, {rng.uniform(), rng.uniform(), rng.uniform(), rng.uniform()}});
            before = end;
        }
    }

    /// Returns the mean share of the view that a side fills if nothing stands between.
    [[nodiscard]] double share_of(const Patch& side) const {
        const PolygonSampler target(side.shape);
        double sum = 0;
        Ray ray{};
        for (const auto& [patch, u] : points_) {
            const Patch& from = mesh_.patches()[patch];
            sum += std::max(
                look_at(from, PolygonSampler(from.shape), side, target, u, everywhere, ray), 0.0);
        }
        return points_.empty() ? 1 : sum / static_cast<double>(points_.size());
    }

  private:
    [[nodiscard]] double reflecting_area(std::uint32_t i) const {
        return mesh_.material(i).reflectance != Vec3(0.0) ? mesh_.patches()[i].area : 0;
    }

    struct Point {
        std::uint32_t patch;
        std::array<double, 4> u;
    };
    const Mesh& mesh_;
    std::vector<Point> points_;
};

/// Returns what each side fills of the view. It is taken by its share of all area, which costs
/// nothing, if that is little for all of them together.
std::vector<double> shares_of(const Mesh& mesh, const std::vector<EmittingSide>& sides,
                              const std::vector<std::uint32_t>& emitters) {
    double total = 0, emitting = 0;
    for (const Patch& patch : mesh.patches())
        total += patch.area;
    for (const EmittingSide& side : sides)
        emitting += side.area;
    std::vector<double> shares;
    if (emitting <= largest_share * total) {
        for (const EmittingSide& side : sides)
            shares.push_back(side.area / total);
        return shares;
    }
    const Views views(mesh, std::clamp<std::size_t>(max_views / sides.size(), 1, max_points));
    for (const EmittingSide& side : sides) {
        const Patch& patch = mesh.patches()[emitters[side.first]];
        shares.push_back(views.share_of(mesh.whole_side(patch.facet, patch.back)));
    }
    return shares;
}

} // namespace

std::vector<std::uint32_t> small_emitters(const Mesh& mesh) {
    const std::vector<std::uint32_t> emitters = emitting_patches(mesh);
    const std::vector<EmittingSide> sides = sides_of(mesh, emitters);
    const std::vector<double> shares = shares_of(mesh, sides, emitters);
    std::vector<std::uint32_t> order(sides.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::uint32_t k) { return sides[k].brightness; });
    std::vector<std::uint32_t> small;
    double sum = 0;
    for (std::size_t begin = 0; begin < order.size();) {
        // Sides of one brightness are all in or all out, whatever their order.
        std::size_t end = begin;
        double together = 0;
        for (; end < order.size() && sides[order[end]].brightness == sides[order[begin]].brightness;
             ++end)
            together += shares[order[end]];
        const bool fits = sum + together <= largest_share;
        sum += fits ? together : 0;
        for (; begin < end; ++begin) {
            if (!fits)
                continue;
            const EmittingSide& side = sides[order[begin]];
            for (std::uint32_t k = 0; k < side.count; ++k)
                small.push_back(emitters[side.first + k]);
        }
    }
    std::ranges::sort(small);
    return small;
}

std::vector<Patch> sides_of_emitters(const Mesh& mesh, std::span<const std::uint32_t> emitters) {
    std::vector<Patch> sides;
    std::array<std::uint32_t, 2> last{none, none};
    for (const std::uint32_t e : emitters) {
        const Patch& patch = mesh.patches()[e];
        const bool first = std::exchange(last[patch.back ? 1 : 0], patch.facet) != patch.facet;
        if (mesh.emits_by_texture(patch))
            sides.push_back(patch);
        else if (first)
            sides.push_back(mesh.whole_side(patch.facet, patch.back));
    }
    return sides;
}

} // namespace hemilux
