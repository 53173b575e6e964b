#pragma once
// The light that arrives at points, gathered once more from a solution on patches.
//
// A patch holds one value for its whole area; a point sees more: the edge of a shadow, the light of
// a lamp that is near. So the light straight from small emitters is found by shadow rays with their
// exact factor, and all other light by cosine-distributed rays that read the solution where they
// strike (final gather: Reichert 1992; Lischinski, Tampieri and Greenberg 1993, "local pass").
// Where a patch is so near that what it sends may not be what it sends on average, as in corners
// and in gaps, a ray goes on as a path (Christensen 1999).

#include "bvh/tracer.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/final_gather/linear_light.h"
#include "radiosity/final_gather/surface_points.h"
#include "radiosity/sampling/sobol.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/stored_transport/emitter_choice.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class StopFlag;
class Workers;

/// Random numbers of a point: `count` points of the Sobol sequence of a seed, `first` and those
/// after it.
struct GatherSamples {
    std::uint64_t seed;
    std::uint32_t first, count;
};

/// Light straight from small emitters [W/m2]. What varies from sample to sample varies in both
/// alike, but for shadows.
struct DirectLight {
    Vec3 arriving{0.0};
    Vec3 unshadowed{0.0}; ///< what would arrive if nothing stood between
    double nearness = 0;  ///< mean inverse distance of the emitters, by that light; local frame
};
enum class Shadows { traced, left_out };

struct IndirectLight {
    Vec3 irradiance{0.0}; ///< [W/m2]
    double nearness = 0;  ///< mean inverse distance of what the rays met; local frame
};

class FinalGather {
  public:
    /// Rays of one round: cosine-distributed ones, and up to so many shadow rays.
    static constexpr unsigned usual_random_rays = 16, usual_shadow_rays = 4;

    /// `light`: what patches send. All of it outlives this.
    FinalGather(const Mesh& mesh, const Tracer& tracer, PatchLight light,
                unsigned random_rays = usual_random_rays, unsigned shadow_rays = usual_shadow_rays);

    /// `estimates` of the irradiance at each point [W/m2], independent of each other and without
    /// bias for the light that the solution sends: those of point k stand from k * estimates on.
    /// `streams`: of random numbers, one for each point; where points share theirs, their errors
    /// are much alike. Where it was interrupted meanwhile the rest is 0.
    [[nodiscard]] std::vector<Vec3> irradiance(std::span<const SurfacePoint> points,
                                               std::span<const std::uint64_t> streams,
                                               std::size_t estimates, const Workers& workers,
                                               const StopFlag& interrupted);
    /// The irradiance in two parts, at each point by its own samples. Straight from small emitters,
    /// by a shadow ray for each sample; and all other, by a cosine-distributed ray for each, which
    /// reads the patch that it meets, however near. On the calling thread. Where shadows are left
    /// out no ray is traced, and nothing arrives.
    [[nodiscard]] std::vector<DirectLight> direct(std::span<const SurfacePoint> points,
                                                  std::span<const GatherSamples> samples,
                                                  Shadows shadows) const;
    [[nodiscard]] std::vector<IndirectLight> indirect(std::span<const SurfacePoint> points,
                                                      std::span<const GatherSamples> samples) const;
    /// Rounds of which an estimate is the mean, 1 at first. Their points are those of one sequence,
    /// so that more rounds reduce the error faster than independent estimates would.
    void set_rounds(unsigned rounds) { rounds_ = rounds; }
    /// From now on irradiance() also says what each cosine-distributed ray met: a patch, `escaped`
    /// or `absorbed` (receivers.h), in the order of the estimates, rounds * random_rays of each.
    void record_receivers(std::vector<std::uint32_t>& receivers) { receivers_ = &receivers; }
    /// From now on irradiance() finds instead what it lacks because light varies within patches: by
    /// as much it would be larger if only the mean light of each patch were right. Paths go on from
    /// where its rays read patches. At each vertex y they find the light that arrives there by the
    /// means of patches, less that at another point y' of its patch by the same random numbers:
    /// what y has more than the mean of its patch. `reads_near`: of gathers as those of indirect(),
    /// which read patches however near.
    void find_spread(bool reads_near) {
        find_ = reads_near ? Find::spread_however_near : Find::spread;
    }
    /// Traced so far.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    FinalGather(const Mesh& mesh, const Tracer& tracer, PatchLight light, unsigned random_rays,
                unsigned shadow_rays, const std::vector<std::uint32_t>& emitters);

    enum class Find { light, spread, spread_however_near };
    struct Emitter {
        Patch side; ///< of a whole facet
        PolygonSampler points;
        double near; ///< from the centre, see look_at
    };
    /// Rays that are not traced yet, of some points.
    struct Batch {
        struct Sample {
            std::uint32_t place; ///< of the estimate
            Vec3 light; ///< if nothing is in the way; of a random ray, its share of what it meets
        };
        std::vector<Ray> shadow, random;
        std::vector<Sample> to_emitter, from_patch;
        std::vector<std::uint32_t> targets;
        std::vector<std::uint32_t> receivers;
        std::vector<std::uint8_t> blocked;
        std::vector<bool> sees_emission;  ///< of random rays: emitters are left to them
        std::vector<std::uint64_t> seeds; ///< of random rays, for what follows from them
        /// Of random rays: nothing is to be found before their path has left the gather.
        std::vector<bool> in_gather;
        std::vector<bool> ends; ///< of random rays: their path does not go on
        EmitterChoice::Cut cut;
        std::uint32_t weighed = none; ///< the patch that the cut is of

        void clear_shadow_rays() {
            shadow.clear();
            targets.clear();
            to_emitter.clear();
        }
    };
    void gather(const SurfacePoint& point, std::uint64_t seed, std::size_t estimates,
                std::uint32_t place, Batch& batch) const;
    /// By `count` points of the sequence, `first` and those after it.
    void add_shadow_rays(const SurfacePoint& point, SobolBlocks<5>& numbers, std::uint32_t first,
                         std::uint32_t count, std::uint32_t place, Batch& batch) const;
    void weigh(const SurfacePoint& point, Batch& batch) const;
    /// What a random ray meets.
    struct Met {
        std::size_t ray; ///< in the batch
        std::uint32_t patch;
        Vec3 point;
        double distance; ///< local frame
    };
    /// Whether a gather takes the light of a patch that is met from so near as a path.
    [[nodiscard]] bool is_near(const Met& met, unsigned bounce) const;
    /// Adds what is found where a ray ends. True: its path goes on.
    bool end_ray(const Batch& batch, const Met& met, unsigned bounce, std::span<Vec3> found) const;
    void go_on(const Batch& from, const Met& met, bool in_gather, Batch& next,
               std::span<Vec3> found) const;
    struct Continuation {
        std::uint64_t seed;
        std::uint32_t place;
        Vec3 light;
        bool in_gather, ends;
        bool any; ///< light comes straight from emitters
    };
    void add_rays(const SurfacePoint& at, const Continuation& step, Batch& next) const;
    [[nodiscard]] Vec3 left_out_of(const Batch& batch, std::size_t ray, std::uint32_t patch) const {
        return batch.sees_emission[ray] ? Vec3(0.0) : left_out_[patch];
    }
    /// Afterwards the batch holds nothing but what its first random rays met.
    void send(Batch& batch, std::span<Vec3> found) const;
    template <class Add>
    void send_shadow_rays(Batch& batch, const Add& add) const;
    void send_random_rays(Batch& batch, std::span<IndirectLight> found) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    PatchLight light_;
    unsigned random_rays_, shadow_rays_;
    unsigned rounds_ = 1;
    Find find_ = Find::light;
    std::vector<std::uint32_t>* receivers_ = nullptr;
    std::vector<Vec3> left_out_; ///< by patch, what the emitters below emit
    std::vector<Patch> sides_;
    std::vector<Emitter> emitters_; ///< those reached by shadow rays
    EmitterChoice choice_;
    mutable std::atomic<std::uint64_t> rays_{0};
};

/// Points over the surfaces, and two independent estimates of the irradiance at each: those of
/// point k are 2 k and 2 k + 1.
struct GatheredTwice {
    std::vector<PatchPoint> points;
    std::vector<Vec3> irradiance; ///< [W/m2]
};
[[nodiscard]] GatheredTwice gather_twice(const PointsOverSurface& surface, FinalGather& gather,
                                         std::size_t points, std::uint64_t seed,
                                         const Workers& workers, const StopFlag& interrupted);

} // namespace hemilux
