#pragma once
// The light that comes straight from small emitters, by shadow rays, and from lights without extent
// (light_of_points.h).
//
// Random rays find a small emitter by luck. Here a sample is a point of the receiver, an emitter,
// and a point of that: well-distributed in five dimensions (sobol.h). The emitter is drawn by the
// light that it would send without obstacles (emitter_choice.h). Its contribution is the kernel of
// form factors times the visibility along one ray (point_to_patch.h). The kernel is the closed form
// of point and polygon, or of two points where the emitter looks small.

#include "bvh/tracer.h"
#include "geometry/vector.h"
#include "parallel/ranks.h"
#include "parallel/workers.h"
#include "radiosity/engine/emitters/light_of_points.h"
#include "radiosity/engine/emitters/reached_emitters.h"
#include "radiosity/paper/scene/needs.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Patch;
class StateReader;
class StateWriter;
struct Monitor;

/// Several estimates of this light at once, independent of each other.
class DirectLight {
  public:
    /// Makes an estimate for each seed. `emitters` are patches, in their order; those of a facet
    /// are either all among them or none. Each of the ranks traces the rays of its patches.
    DirectLight(const Mesh& mesh, const Tracer& tracer, const Needs& needs,
                std::span<const std::uint32_t> emitters, std::vector<std::uint64_t> seeds,
                const Ranks& ranks = one_rank());

    /// Goes on until each patch for which that pays has so many samples in each estimate. Returns
    /// the number of rays traced by this call, those of all ranks. If the monitor was interrupted
    /// meanwhile, some patches have fewer samples, and another call takes up the rest. All ranks
    /// must call this.
    std::uint64_t sample_up_to(std::span<const std::uint32_t> samples, const Workers& workers,
                               Monitor& monitor);

    [[nodiscard]] std::size_t estimates() const { return seeds_.size(); }
    /// Returns the mean over the samples of one estimate [W/m2 arriving].
    [[nodiscard]] Vec3 irradiance(std::uint32_t patch, std::size_t estimate) const {
        return of_surfaces(patch, estimate) + of_points_.irradiance(patch, estimate);
    }
    /// Returns the mean over all estimates [W/m2 arriving].
    [[nodiscard]] Vec3 irradiance(std::uint32_t patch) const {
        return of_surfaces(patch) + of_points_.irradiance(patch);
    }
    /// Returns the same without the light of those without extent.
    [[nodiscard]] Vec3 of_surfaces(std::uint32_t patch, std::size_t estimate) const {
        const std::uint32_t n = samples_[patch];
        return n > 0 ? sum_[patch * seeds_.size() + estimate] / static_cast<double>(n) : Vec3(0.0);
    }
    [[nodiscard]] Vec3 of_surfaces(std::uint32_t patch) const;
    [[nodiscard]] const LightOfPoints& of_points() const { return of_points_; }
    /// Returns whether no shadow ray of this patch goes to a surface, also as random rays find more
    /// (EmitterChoice::Cut::pays).
    [[nodiscard]] bool leaves_surfaces(std::uint32_t patch) const { return samples_[patch] == 0; }
    /// Returns the number of samples of this patch in each estimate.
    [[nodiscard]] std::uint32_t samples(std::uint32_t patch) const {
        return std::max(samples_[patch], of_points_.samples(patch));
    }
    /// Returns the number of samples of this patch that brought light.
    [[nodiscard]] std::uint32_t hits(std::uint32_t patch) const {
        return hits_[patch] + of_points_.hits(patch);
    }
    /// Returns the irradiance if nothing blocked any sample [W/m2, mean of channels].
    [[nodiscard]] double unblocked(std::uint32_t patch) const {
        const double n = double(samples_[patch]) * double(seeds_.size());
        return (n > 0 ? unblocked_[patch] / n : 0) + of_points_.unblocked(patch);
    }
    [[nodiscard]] std::uint64_t bytes() const {
        return sum_.size() * sizeof(Vec3) +
               samples_.size() * (2 * sizeof(std::uint32_t) + sizeof(double)) + of_points_.bytes();
    }

    void save(StateWriter& state) const;
    /// Throws StateError for what save() cannot have written of this mesh.
    void load(StateReader& state);

  private:
    struct RayBatch;
    void sample(std::uint32_t patch, std::uint32_t end, RayBatch& batch);
    void send(RayBatch& batch);

    const Mesh& mesh_;
    const Tracer& tracer_;
    const Needs& needs_;
    OwnBlocks own_;
    ReachedEmitters emitters_;
    std::vector<std::uint64_t> seeds_;
    std::vector<Vec3> sum_; ///< by patch and estimate
    std::vector<std::uint32_t> samples_, hits_;
    std::vector<double> unblocked_; ///< sum over the samples of a patch
    LightOfPoints of_points_;
};

} // namespace hemilux
