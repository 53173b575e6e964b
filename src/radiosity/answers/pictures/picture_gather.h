#pragma once
// The light on what a picture shows, gathered from a solution. Shadows are at their places, with
// the edges that patches are too large for.
//
// Light straight from small emitters has sharp edges. Where some shadow rays of the points around
// are blocked and some are not, it is found by shadow rays at each pixel. All other light varies
// slowly. It is gathered at the points of a grid (gather_grid.h). Each of them takes other rays of
// one well distributed sequence (interleaved sampling: Keller and Heidrich 2001). Then the light is
// smoothed over the points around (slow_light.h; Wald et al. 2002). The fewer neighbours are near
// enough for that, and the more they differ, the more rays a point takes. Where most of their noise
// comes from bright patches, half of these further rays are aimed at such patches
// (bright_patches.h). Pixels read the functions around them that lie on the same surface.

#include "geometry/vector.h"
#include "radiosity/answers/pictures/gather_grid.h"
#include "radiosity/answers/pictures/slow_light.h"
#include "radiosity/light/final_gather/gather_in_parts.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

struct PictureGatherOptions {
    /// The cosine-distributed rays of a point. It takes a quarter of them where it has many
    /// neighbours to average over, and up to about four times as many where it has few. Four times
    /// as many halve the noise.
    unsigned rays = 16;
    unsigned shadow_rays = 8; ///< of a pixel at the edge of a shadow
    unsigned samples = 4;     ///< of a pixel
    unsigned round = 0;       ///< the errors of rounds by the rays are independent
    /// Where light changes faster than the points of the grid are close together, each place
    /// gathers by so many rays of its own. 0: it reads the grid, so that pictures are smooth there.
    unsigned coarse_rays = 0;
    bool only_reflected = false;         ///< nothing that arrives straight from emitters
    std::function<void()> check = [] {}; ///< may throw to end it; is called by several threads
};

class PictureGather {
  public:
    PictureGather(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                  const CameraRays& camera, int width, int height,
                  const PictureGatherOptions& options, const Workers& workers);
    /// Gathers at the points of a grid; pixel (0, 0) to (2, 2) is around its first point.
    PictureGather(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                  GatherGrid grid, const PictureGatherOptions& options);

    /// Gathers at the points that places above row `end` of the picture read. Each point depends on
    /// a few around it, so rows from the top are finished one after the other, and what they show
    /// is the same as if all were gathered at once.
    void prepare_rows(int end, const Workers& workers);

    /// A place where samples of a pixel show a surface: `count` of them, the first of which is
    /// number `sample` of the pixel.
    struct Place {
        SurfacePoint at;
        Vec2 pixel; ///< in pixels
        unsigned sample, count;
        std::uint32_t part = 0; ///< GridPoint::part
    };
    /// Direct light is slow.unshadowed times the share of it that arrives. This share is the ratio
    /// of sums over `direct` of places around, as the few rays of one place estimate it badly.
    struct Light {
        EmitterLight direct;
        SlowLight slow;
        Vec3 of_points{0.0}; ///< from lights without extent, as it arrives at the place
        /// The distance within which places that gathered slow light by themselves may share it, in
        /// local units; 0 where the grid was read, and where no point of it is around.
        double reach = 0;
    };
    /// Returns the light at each place, whose row is prepared. Several threads may call it.
    [[nodiscard]] std::vector<Light> irradiance(std::span<const Place> places) const;
    /// Returns the rays so far, but for those of paths that go on.
    [[nodiscard]] std::uint64_t rays() const { return in_parts_.rays(); }
    /// Returns the number of shadow rays of a pixel at the edge of a shadow.
    [[nodiscard]] unsigned shadow_rays() const { return of_sample() * options_.samples; }

  private:
    [[nodiscard]] GatherSamples samples_of(int x, int y, unsigned count) const;
    template <class Rays>
    void gather(std::size_t first, std::size_t end, const Rays& rays_at, Shadows shadows,
                const Workers& workers);
    [[nodiscard]] std::size_t points_of_chunk() const;
    [[nodiscard]] std::size_t chunks_up_to(int end) const;
    [[nodiscard]] int rows_of(std::size_t chunks) const;
    [[nodiscard]] unsigned more_rays(int x, int y) const;
    [[nodiscard]] unsigned of_sample() const {
        return std::max(1u, options_.shadow_rays / options_.samples);
    }
    void judge_points(int first, int end, const Workers& workers);

    /// What is done from the top: chunks of points that have their rays, and rows.
    struct Done {
        std::size_t first_rays = 0, more_rays = 0;
        int asked = 0, judged = 0, once = 0, twice = 0;
    };

    PictureGatherOptions options_;
    GatherInParts in_parts_;
    GatherGrid grid_;
    SlowLightField light_; ///< of the grid
    Done done_;
};

} // namespace hemilux
