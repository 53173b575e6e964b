#include "radiosity/engine/factors/pairs/pair_rays.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {
namespace {

/// The sequence of the powers of the inverse of the root of x^5 = x + 1 (Roberts 2018), which fills
/// four dimensions evenly at any number of points.
constexpr std::array<double, 4> step = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                        0.5385972572236101};

} // namespace

void PairRays::add(const FacePlane& a, std::uint32_t from, const FacePlane& b, std::uint32_t to,
                   std::uint32_t count, std::uint64_t seed) {
    const PolygonSampler of_a(a.shape), of_b(b.shape);
    Rng random(seed);
    std::array<double, 4> u;
    for (double& coordinate : u)
        coordinate = random.uniform();
    for (std::uint32_t k = 0; k < count; ++k) {
        const Vec3 x = of_a.sample({u[0], u[1]}), y = of_b.sample({u[2], u[3]}), d = y - x;
        const double square = glm::dot(d, d);
        const double heights = std::max(a.plane.height(y), 0.0) * std::max(b.plane.height(x), 0.0);
        const double kernel = heights / (square * square);
        if (kernel > 0) {
            rays_.push_back({.origin = x, .direction = d, .t_max = 1 - 1e-12, .from = from});
            targets_.push_back(to);
            kernel_.push_back(kernel);
        }
        for (std::size_t axis = 0; axis < 4; ++axis)
            u[axis] += step[axis] - (u[axis] + step[axis] >= 1 ? 1 : 0);
    }
    ends_.push_back(rays_.size());
}

PairRays::Share PairRays::share(std::size_t begin, std::size_t end) const {
    Share share;
    share.rays = static_cast<std::uint32_t>(end - begin);
    for (std::size_t k = begin; k < end; ++k) {
        share.all += kernel_[k];
        share.squares += kernel_[k] * kernel_[k];
        if (blocked_[k])
            continue;
        share.seen += kernel_[k] * tracer_.passed(rays_[k]);
        ++share.arrived;
    }
    return share;
}

} // namespace hemilux
