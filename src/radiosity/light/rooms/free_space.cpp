#include "radiosity/light/rooms/free_space.h"

#include "geometry/box.h"
#include "geometry/elementary.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

constexpr int rays_around = 24;

Box box_of_near(const Mesh& mesh) {
    Box box;
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
        if (!mesh.scene().materials[mesh.scene().facets[f].material].is_far)
            box.include(box_of(mesh.shape_of(f).corner));
    return box;
}

bool is_far(const Mesh& mesh, std::uint32_t facet) {
    return mesh.scene().materials[mesh.scene().facets[facet].material].is_far;
}

/// Returns directions that are spread evenly over the sphere, by the golden angle.
std::array<Vec3, rays_around> directions_around() {
    std::array<Vec3, rays_around> all;
    for (int k = 0; k < rays_around; ++k) {
        const double z = 1 - (2 * k + 1.0) / rays_around;
        const Vec2 around = elementary::on_circle(k * std::numbers::pi * (3 - std::sqrt(5.0)));
        const double r = std::sqrt(1 - z * z);
        all[std::size_t(k)] = {r * around.x, r * around.y, z};
    }
    return all;
}

/// What the rays from a place met.
struct View {
    int fronts = 0, backs = 0, open = 0;
    /// Nearly all that is near shows its back, or nothing is near.
    [[nodiscard]] bool is_void() const {
        constexpr int backs_per_front = 9;
        return fronts * backs_per_front <= backs;
    }
};

/// The grid, and which of its places hang together.
class Grid {
  public:
    Grid(const Mesh& mesh, const Tracer& tracer, Around around) : mesh_(mesh), tracer_(tracer) {
        constexpr double wanted = 6000, max_side = 64;
        box_ = box_of_near(mesh);
        // Around a thing, or over a sheet, there is room as well.
        const Vec3 margin = glm::max(0.02 * box_.extent(), Vec3(0.05 * largest(box_.extent())));
        if (around == Around::always || fills_its_box()) {
            box_.low -= margin;
            box_.high += margin;
        }
        const Vec3 extent = box_.extent();
        const double side = elementary::pow(extent.x * extent.y * extent.z / wanted, 1.0 / 3);
        for (int axis = 0; axis < 3; ++axis)
            n_[std::size_t(axis)] = static_cast<std::uint32_t>(
                std::clamp(std::round(extent[axis] / side), 2.0, max_side));
        parent_.resize(std::size_t{n_[0]} * n_[1] * n_[2]);
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (std::uint32_t k = 0; k < parent_.size(); ++k)
            places_.push_back(place(k));
    }

    FreeSpace find() {
        look_around();
        join_neighbours();
        return gather();
    }

  private:
    static double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

    /// Returns whether the scene is a sheet, or a thing that is seen from outside only.
    [[nodiscard]] bool fills_its_box() const {
        const Vec3 extent = box_.extent();
        if (std::min({extent.x, extent.y, extent.z}) < 0.01 * largest(extent))
            return true;
        constexpr int tries = 200;
        Rng rng(3);
        int free = 0;
        for (int k = 0; k < tries; ++k) {
            const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
            free += !around(box_.low + u * extent, nullptr).is_void();
        }
        return free < tries / 10;
    }

    [[nodiscard]] std::array<std::uint32_t, 3> index(std::uint32_t k) const {
        return {k % n_[0], k / n_[0] % n_[1], k / n_[0] / n_[1]};
    }
    /// Returns a place near the middle of a cell: walls often stand in planes of symmetry.
    [[nodiscard]] Vec3 place(std::uint32_t k) const {
        constexpr double shift = 0.4;
        Rng rng(hash_words({5, k}));
        const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
        const auto [x, y, z] = index(k);
        const Vec3 cell = Vec3(x, y, z) + 0.5 + shift * (u - 0.5);
        return box_.low + box_.extent() * cell / Vec3(n_[0], n_[1], n_[2]);
    }

    View around(const Vec3& from, std::vector<SeenPlace>* seen) const {
        static const std::array<Vec3, rays_around> directions = directions_around();
        View result;
        for (const Vec3& direction : directions) {
            const Ray ray{.origin = from, .direction = direction};
            const std::optional<Hit> hit = tracer_.closest(ray);
            if (!hit || is_far(mesh_, hit->facet))
                ++result.open;
            else if (const auto place = place_seen(mesh_, tracer_, ray)) {
                ++result.fronts;
                if (seen)
                    seen->push_back(*place);
            } else
                ++result.backs;
        }
        return result;
    }

    void look_around() {
        seen_.resize(places_.size());
        std::size_t count = 0;
        for (std::size_t k = 0; k < places_.size(); ++k) {
            around_.push_back(around(places_[k], &seen_[k]));
            if (around_[k].is_void())
                seen_[k].clear();
            count += seen_[k].size();
        }
        constexpr std::size_t max_seen = 2000;
        step_ = count / max_seen + 1;
    }

    std::uint32_t root(std::uint32_t k) {
        while (parent_[k] != k)
            k = parent_[k] = parent_[parent_[k]];
        return k;
    }

    void join_neighbours() {
        const std::array<std::uint32_t, 3> stride{1, n_[0], n_[0] * n_[1]};
        for (std::uint32_t k = 0; k < parent_.size(); ++k)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::uint32_t other = k + stride[axis];
                if (index(k)[axis] + 1 == n_[axis] || around_[k].is_void() ||
                    around_[other].is_void())
                    continue;
                const Ray way{
                    .origin = places_[k], .direction = places_[other] - places_[k], .t_max = 1};
                if (!tracer_.occluded(way))
                    parent_[root(std::max(k, other))] = root(std::min(k, other));
            }
    }

    FreeSpace gather() {
        constexpr std::size_t min_places = 8;
        std::size_t number = 0; // of what is seen
        FreeSpace result;
        std::vector<Space> all(parent_.size());
        for (std::uint32_t k = 0; k < parent_.size(); ++k) {
            if (around_[k].is_void())
                continue;
            Space& space = all[root(k)];
            space.places.push_back(places_[k]);
            for (const SeenPlace& place : seen_[k])
                if (number++ % step_ == 0)
                    space.seen.push_back(place);
            space.openness += double(around_[k].open) / rays_around;
            ++result.places;
        }
        for (Space& space : all)
            if (space.places.size() >= min_places) {
                space.openness /= double(space.places.size());
                result.spaces.push_back(std::move(space));
            }
        std::ranges::stable_sort(result.spaces, [](const Space& a, const Space& b) {
            return a.places.size() > b.places.size();
        });
        const Vec3 extent = box_.extent();
        result.volume_of_place = extent.x * extent.y * extent.z / double(parent_.size());
        return result;
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    Box box_;
    std::array<std::uint32_t, 3> n_{};
    std::vector<Vec3> places_;
    std::vector<View> around_;
    std::vector<std::uint32_t> parent_;        ///< of a forest whose trees are the spaces
    std::vector<std::vector<SeenPlace>> seen_; ///< by place
    std::size_t step_ = 1;                     ///< one of so many is kept
};

} // namespace

std::optional<SeenPlace> place_seen(const Mesh& mesh, const Tracer& tracer, const Ray& ray) {
    const std::optional<Hit> hit = tracer.closest(ray);
    if (!hit || is_far(mesh, hit->facet) || (!hit->front && !mesh.has_back(hit->facet)))
        return std::nullopt;
    return SeenPlace{ray.origin + hit->t * ray.direction,
                     mesh.whole_side(hit->facet, !hit->front).normal, hit->facet};
}

std::vector<SeenPlace> FreeSpace::seen() const {
    std::vector<SeenPlace> all;
    for (const Space& space : spaces)
        all.insert(all.end(), space.seen.begin(), space.seen.end());
    return all;
}

FreeSpace find_free_space(const Mesh& mesh, const Tracer& tracer, Around around) {
    return Grid(mesh, tracer, around).find();
}

} // namespace hemilux
