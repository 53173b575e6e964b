#include "radiosity/lit_sides.h"

#include "radiosity/light_paths.h"

#include <numeric>

namespace hemilux {
namespace {

constexpr std::uint32_t paths = 1u << 14; ///< from all emitters together
constexpr double reflected = 0.5;
constexpr std::uint32_t rays_of_shell = 64; ///< a side
constexpr double few = 32;                  ///< rays that reached a shell
constexpr double too_few = 4;               ///< rays of a shell that found light

class Estimate {
  public:
    Estimate(const Mesh& mesh, const Tracer& tracer)
        : mesh_(mesh), tracer_(tracer), arrived_(mesh.scene().facets.size(), SideLight{}),
          left_(arrived_) {}

    /// Emitters share the paths by power and by area, half and half: a dim lamp counts too.
    void shine(const std::vector<bool>& shines_back) {
        std::vector<double> power(arrived_.size()), area(arrived_.size(), 0.0);
        for (std::uint32_t f = 0; f < power.size(); ++f) {
            power[f] = power_of(mesh_, f);
            area[f] = power[f] > 0 ? area_of(f) : 0;
        }
        Rng rng(1);
        for (const std::vector<double>* weights : {&power, &area}) {
            const std::vector<std::uint32_t> shares = shares_of(*weights, paths / 2);
            for (std::uint32_t f = 0; f < shares.size(); ++f)
                for (std::uint32_t k = 0; k < shares[f]; ++k)
                    follow({f, shines_back[f]}, rng);
        }
    }

    /// Shells that few rays reached, if rays of their own find enough light.
    void look_from(std::span<const std::uint32_t> facets) {
        double reached = 0;
        for (const std::uint32_t f : facets)
            reached += arrived_[f][0] + arrived_[f][1];
        if (reached >= few)
            return;
        for (const std::uint32_t f : facets)
            arrived_[f] = {};
        if (gather(facets) < too_few)
            for (const std::uint32_t f : facets)
                arrived_[f] = {};
    }

    [[nodiscard]] std::vector<SideLight> take() { return std::move(arrived_); }

  private:
    [[nodiscard]] double area_of(std::uint32_t f) const { return mesh_.whole_side(f, false).area; }

    void follow(FacetSide side, Rng& rng) {
        Ray ray = diffuse_ray(mesh_, side, rng);
        for (;;) {
            left_[side.facet][side.back] += 1;
            const std::optional<Hit> hit = tracer_.closest(ray);
            if (!hit)
                return;
            side = {hit->facet, !hit->front};
            arrived_[side.facet][side.back] += 1;
            if (rng.uniform() > reflected)
                return;
            ray = diffuse_ray(mesh_, side, point_of(ray, *hit), rng);
        }
    }

    /// The number of rays that found light.
    double gather(std::span<const std::uint32_t> facets) {
        std::vector<double> areas;
        for (const std::uint32_t f : facets)
            areas.push_back(area_of(f));
        const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
        const std::vector<std::uint32_t> shares = shares_of(areas, rays_of_shell);
        Rng rng(hash_words({facets[0]}));
        double found = 0;
        for (std::size_t k = 0; k < facets.size(); ++k)
            for (std::uint32_t ray = 0; ray < shares[k]; ++ray)
                for (const bool back : {false, true}) {
                    const double light = light_along(diffuse_ray(mesh_, {facets[k], back}, rng));
                    arrived_[facets[k]][back] += light * area / rays_of_shell;
                    found += light > 0;
                }
        return found;
    }

    /// Rays per area that leave what is struck.
    [[nodiscard]] double light_along(const Ray& ray) const {
        const std::optional<Hit> hit = tracer_.closest(ray);
        return hit ? left_[hit->facet][!hit->front] / area_of(hit->facet) : 0;
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::vector<SideLight> arrived_, left_;
};

} // namespace

std::vector<SideLight> light_on_sides(const Mesh& mesh, const Tracer& tracer, const Shells& shells,
                                      const std::vector<bool>& shines_back) {
    Estimate estimate(mesh, tracer);
    estimate.shine(shines_back);
    for (const Shell& shell : shells.all)
        estimate.look_from(shells.facets_of(shell));
    return estimate.take();
}

} // namespace hemilux
