#pragma once
// The light on what a picture shows, gathered from a solution: shadows at their places, with the
// edges that patches are too large for.
//
// Light straight from small emitters has sharp edges: where some shadow rays of the points around
// are blocked and some are not, it is found by shadow rays at each pixel. All other light varies
// slowly, the slower the further surfaces are away (Ward, Rubinstein and Clear 1988): it is
// gathered at every second pixel of every second row. Each of these points takes other rays of one
// well distributed sequence. A linear function is fitted to its neighbours within a share of the
// harmonic mean distance of what its rays met (interleaved sampling: Keller and Heidrich 2001; the
// filter: Wald et al. 2002). The fewer neighbours are so near, and the more they differ, the more
// rays a point takes. Pixels read the functions around them that lie on the same surface.

#include "geometry/vector.h"
#include "io/pictures/visible_facets.h"
#include "radiosity/final_gather/final_gather.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Workers;

/// Whether two points with unit normals belong to one surface, which may be bent a little.
[[nodiscard]] bool is_same_surface(const Vec3& a, const Vec3& normal_a, const Vec3& b,
                                   const Vec3& normal_b);

struct PictureGatherOptions {
    /// Cosine-distributed rays of a point: a quarter of them where it has many neighbours to
    /// average over, up to five times as many where it has few. A pixel at the edge of a shadow
    /// takes half as many shadow rays. Four times as many halve the noise.
    unsigned rays = 16;
    unsigned samples = 4;               ///< of a pixel
    std::function<bool()> give_up = {}; ///< true ends it with Interrupted
};

class PictureGather {
  public:
    PictureGather(const Mesh& mesh, const Tracer& tracer, PatchLight light,
                  const CameraRays& camera, int width, int height,
                  const PictureGatherOptions& options, const Workers& workers);

    /// Where samples of a pixel show a surface: `count` of them, the first of which is number
    /// `sample` of the pixel.
    struct Place {
        SurfacePoint at;
        Vec2 pixel; ///< in pixels
        unsigned sample, count;
    };
    /// Irradiance that varies slowly [W/m2].
    struct SlowLight {
        Vec3 unshadowed{0.0}; ///< straight from small emitters if nothing stood between
        Vec3 indirect{0.0};
    };
    /// Direct light is slow.unshadowed times the share of it that arrives: the ratio of sums over
    /// `direct` of places around, as the few rays of one place tell it badly.
    struct Light {
        DirectLight direct;
        SlowLight slow;
    };
    /// The light at each place. May be called by several threads.
    [[nodiscard]] std::vector<Light> irradiance(std::span<const Place> places) const;

    /// The distance in pixels between points at which indirect light is gathered.
    static constexpr int step = 2;

  private:
    /// Of shadow rays: bits, so that both together say that some were blocked.
    enum Shadow : std::uint8_t { none_blocked = 1, all_blocked = 2 };
    /// Of a sample of the grid. Without a surface there: facet none.
    struct Record {
        SurfacePoint at;
        double nearness = 0;     ///< mean inverse distance of what the rays met, or of lamps
        double noise = 0;        ///< relative error of the mean of the points around
        unsigned rays = 0;       ///< gathered by so many
        std::uint8_t shadow = 0; ///< Shadow, of rays from here and from the points beside it

        [[nodiscard]] bool is_of_surface(const SurfacePoint& point) const {
            return is_same_surface(point.position, point.normal, at.position, at.normal);
        }
    };
    [[nodiscard]] GatherSamples samples_of(int x, int y, unsigned count) const;
    [[nodiscard]] const Record* record(int x, int y) const;
    [[nodiscard]] std::size_t place_of(const Record& record) const {
        return static_cast<std::size_t>(&record - records_.data());
    }
    void find_points(const Mesh& mesh, const CameraRays& camera, const Workers& workers);
    template <class Rays>
    void gather(const Rays& rays_at, Shadows shadows, const Workers& workers);
    [[nodiscard]] unsigned more_rays(int x, int y) const;
    void find_noise(const Workers& workers);
    [[nodiscard]] double noise_around(const Record& here, int x, int y) const;
    [[nodiscard]] static double weight_of(const Record& here, const Record* there, double most);
    static void add(SlowLight& sum, const SlowLight& light, double weight);
    [[nodiscard]] double spacing(int x, int y) const;
    void ask_neighbours(const Workers& workers);
    struct Fit;
    void fit_light(int stride, const Workers& workers);
    struct Around {
        SlowLight light;
        std::uint8_t shadow = 0;
    };
    [[nodiscard]] std::optional<Around> interpolate(const Place& place) const;
    void give_up_if_asked() const;

    PictureGatherOptions options_;
    FinalGather final_gather_;
    int width_, height_;
    int columns_, rows_;
    std::vector<Record> records_;
    std::vector<SlowLight> light_; ///< of the records
    /// What it changes by from a record to the next one on the right, and in the next row.
    std::vector<std::array<SlowLight, 2>> slope_;
};

} // namespace hemilux
