#include "radiosity/answers/run/step_size.h"

#include "radiosity/answers/asked/text.h"

#include <algorithm>

namespace hemilux {

double rays_of_step(double rays, std::optional<double> seconds, const Method& method,
                    std::size_t patches) {
    /// A slow thread traces this many rays in a second. The usual number is reduced only where
    /// several fast threads would hardly end a step.
    constexpr double rays_per_second = 250e3, default_rays = 64, many_per_second = 2e6, least = 1;
    if (!seconds)
        return rays;
    /// `matrix` takes --rays for each of its matrices, and then solves them.
    constexpr double matrices = 16;
    const double each = method.work.pairs && method.work.linear_systems ? matrices : 1;
    const double per_patch = *seconds / each / static_cast<double>(patches);
    const double most = std::max(
        {rays_per_second * per_patch, std::min(default_rays, many_per_second * per_patch), least});
    return std::min(rays, most);
}

std::optional<Finding> smaller_step_finding(double asked, double taken) {
    if (taken >= asked)
        return {};
    return Finding{
        Finding::Kind::warning,
        formatted("a step takes %.4g rays per patch instead of %.4g, so that the time is enough "
                  "for some steps",
                  taken, asked)};
}

} // namespace hemilux
