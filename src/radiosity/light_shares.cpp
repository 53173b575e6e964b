#include "radiosity/light_shares.h"

#include "radiosity/light_paths.h"

#include <algorithm>
#include <optional>

namespace hemilux {
namespace {

constexpr std::uint32_t paths = 4096;

double largest(const Vec3& v) { return std::max({v.r, v.g, v.b}); }

class Shares {
  public:
    Shares(const Mesh& mesh, const Tracer& tracer)
        : mesh_(mesh), tracer_(tracer),
          two_sided_(std::ranges::any_of(mesh.patches(), &Patch::back)) {}

    LightShares find() {
        std::vector<double> power;
        for (std::uint32_t f = 0; f < mesh_.scene().facets.size(); ++f)
            power.push_back(power_of(mesh_, f));
        const std::vector<std::uint32_t> count = shares_of(power, paths);
        for (std::uint32_t f = 0; f < count.size(); ++f)
            for (std::uint32_t k = 0; k < count[f]; ++k)
                follow({f, two_sided_ && k % 2 == 1});
        return sum_;
    }

  private:
    [[nodiscard]] const Material& material(std::uint32_t facet) const {
        return mesh_.scene().materials[mesh_.scene().facets[facet].material];
    }

    /// Until the light falls on a back, leaves, or is absorbed by chance.
    void follow(FacetSide side) {
        const Vec3& e = material(side.facet).emission;
        Vec3 weight = e / (e.r + e.g + e.b) / double{paths};
        Ray ray = diffuse_ray(mesh_, side, rng_);
        for (;;) {
            const std::optional<Hit> hit = tracer_.closest(ray);
            const double all = weight.r + weight.g + weight.b;
            if (!hit || (!hit->front && !two_sided_)) {
                (hit ? sum_.backs : sum_.escaped) += all;
                return;
            }
            const Vec3& reflectance = material(hit->facet).reflectance;
            const double survival = std::min(largest(reflectance), longest);
            if (!(rng_.uniform() < survival))
                return;
            weight *= reflectance / survival;
            ray = diffuse_ray(mesh_, {hit->facet, !hit->front}, point_of(ray, *hit), rng_);
        }
    }

    static constexpr double longest = 0.99; ///< of the chances to go on
    const Mesh& mesh_;
    const Tracer& tracer_;
    bool two_sided_;
    Rng rng_{2};
    LightShares sum_;
};

} // namespace

LightShares find_light_shares(const Mesh& mesh, const Tracer& tracer) {
    return Shares(mesh, tracer).find();
}

} // namespace hemilux
