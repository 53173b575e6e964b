#pragma once
// The emitters that points reach by shadow rays, and these rays. Each goes to an emitter that is
// drawn by its light (emitter_choice.h), and brings it by its exact factor (point_to_patch.h).
// Where its emission varies by a texture, the ray brings that of the texel where it ends.

#include "bvh/tracer.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/engine/emitters/emitter_choice.h"
#include "radiosity/engine/rays/shadow_rays.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Rng;

/// This is what an emitter brings.
struct LightAtPlace {
    std::uint32_t place; ///< of the estimate
    Vec3 light;          ///< [W/m2]
};

/// The chances of emitters, for a point or for those of a patch. They are dark before they are
/// weighed.
struct WeighedEmitters {
    EmitterChoice::Cut cut;
    std::uint32_t patch = none; ///< none: of a point

    /// Returns whether shadow rays are better than leaving emitters to random rays.
    [[nodiscard]] bool pays() const { return !cut.dark() && cut.pays(); }
};

class ReachedEmitters {
  public:
    /// Takes the small emitters of a mesh (small_emitters.h).
    explicit ReachedEmitters(const Mesh& mesh);

    /// Takes these emitters; those of a facet are either all among them or none.
    ReachedEmitters(const Mesh& mesh, std::span<const std::uint32_t> emitters);

    [[nodiscard]] bool empty() const { return emitters_.empty(); }
    [[nodiscard]] std::size_t count() const { return emitters_.size(); }
    [[nodiscard]] const EmitterChoice& choice() const { return choice_; }
    /// Returns what a patch emits on average that shadow rays find [W/m2].
    [[nodiscard]] const Vec3& emission(std::uint32_t patch) const { return emission_[patch]; }
    /// Returns whether shadow rays find the emission of a patch.
    [[nodiscard]] bool contains(std::uint32_t patch) const { return emission_[patch] != Vec3(0.0); }
    /// Prepares shadow rays of a point. It has the chances of its patch, if it names that.
    void weigh(const SurfacePoint& point, WeighedEmitters& weighed) const;
    /// Adds rays for `count` points of the sequence, `first` and those after it; some see nothing
    /// of their emitter and are left out. The light of each is its share of their mean.
    void add_rays(const SurfacePoint& point, const WeighedEmitters& weighed,
                  SobolBlocks<5>& numbers, std::uint32_t first, std::uint32_t count,
                  std::uint32_t place, ShadowRays<LightAtPlace>& rays) const;
    /// Adds one ray, of which `share` of the light counts.
    void add_ray(const SurfacePoint& point, const WeighedEmitters& weighed, Rng& rng,
                 const Vec3& share, std::uint32_t place, ShadowRays<LightAtPlace>& rays) const;

    /// A shadow ray to a point of an emitter, and the light that it brings [W/m2] over the chance
    /// of the emitter. aim() returns nothing if the point does not face it.
    struct Aimed {
        Ray ray;
        std::uint32_t target; ///< the emitter's facet
        double factor;        ///< [-], of the emission
        Vec3 emission;        ///< [W/m2], of the texel where the ray ends
    };
    [[nodiscard]] std::optional<Aimed> aim(const EmitterChoice::Choice& chosen,
                                           const SurfacePoint& point, Vec2 u) const;

  private:
    struct Emitter {
        Patch side; ///< of a whole facet
        PolygonSampler points;
        double near; ///< from the centre, see look_from; 0 where the emission varies
        Vec3 emission;
        bool varies; ///< its emission, by a texture
    };

    const Mesh& mesh_;
    std::vector<Vec3> emission_; ///< by patch
    std::vector<Patch> sides_;
    std::vector<Emitter> emitters_;
    EmitterChoice choice_;
};

} // namespace hemilux
