#pragma once
// The light that comes to patches straight from lights without extent, by shadow rays.
//
// A patch's mean irradiance by one light is the integral of I V over the solid angle that the patch
// fills for the light, over the area; V is 1 where nothing stands between. A sample is a light,
// drawn by what it would send there, and a direction uniform over that solid angle. So light that
// nothing hides and that does not vary with the direction has no noise, also where the light almost
// touches the patch. A patch that looks small takes points uniform over its area instead.

#include "bvh/tracer.h"
#include "geometry/vector.h"
#include "parallel/ranks.h"
#include "parallel/workers.h"
#include "radiosity/engine/emitters/point_emitters.h"
#include "radiosity/engine/emitters/solid_angle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StateReader;
class StateWriter;
struct Monitor;

/// Several estimates of this light at once, independent of each other.
class LightOfPoints {
  public:
    /// Makes an estimate for each seed. Each of the ranks traces the rays of its patches.
    LightOfPoints(const Mesh& mesh, const Tracer& tracer, std::vector<std::uint64_t> seeds,
                  const Ranks& ranks = one_rank());

    [[nodiscard]] bool empty() const { return emitters_.empty(); }
    /// Goes on until each patch has so many samples in each estimate, and a few at least; none
    /// where no light shines. Returns the number of rays traced by this call, those of all ranks.
    /// If the monitor was interrupted meanwhile, some patches have fewer samples, and another call
    /// takes up the rest.
    std::uint64_t sample_up_to(std::span<const std::uint32_t> samples, const Workers& workers,
                               Monitor& monitor);

    /// Returns the mean over the samples of one estimate [W/m2 arriving].
    [[nodiscard]] Vec3 irradiance(std::uint32_t patch, std::size_t estimate) const {
        const std::uint32_t n = samples(patch);
        return n > 0 ? sum_[patch * seeds_.size() + estimate] / static_cast<double>(n) : Vec3(0.0);
    }
    /// Returns the mean over all estimates [W/m2 arriving].
    [[nodiscard]] Vec3 irradiance(std::uint32_t patch) const;
    /// Returns the number of samples of a patch in each estimate, of those that brought light in
    /// all, and the irradiance if nothing blocked any [W/m2, mean of channels].
    [[nodiscard]] std::uint32_t samples(std::uint32_t patch) const {
        return empty() ? 0 : samples_[patch];
    }
    [[nodiscard]] std::uint32_t hits(std::uint32_t patch) const {
        return empty() ? 0 : hits_[patch];
    }
    [[nodiscard]] double unblocked(std::uint32_t patch) const {
        const double n = double(samples(patch)) * double(seeds_.size());
        return n > 0 ? unblocked_[patch] / n : 0;
    }
    [[nodiscard]] std::uint64_t bytes() const;

    void save(StateWriter& state) const;
    /// Throws StateError for what save() cannot have written of this mesh.
    void load(StateReader& state);

  private:
    struct Work;
    void look_from_lights(std::uint32_t patch, Work& work) const;
    void sample(std::uint32_t patch, std::uint32_t end, Work& work);
    void send(Work& work);

    const Mesh& mesh_;
    const Tracer& tracer_;
    OwnBlocks own_;
    PointEmitters emitters_;
    std::vector<std::uint64_t> seeds_;
    std::vector<Vec3> sum_; ///< by patch and estimate
    std::vector<std::uint32_t> samples_, hits_;
    std::vector<double> unblocked_; ///< sum over the samples of a patch
};

} // namespace hemilux
