#include "radiosity/paper/scene/alike_neighbours.h"

namespace hemilux {

std::vector<Vec3> pooled_over_neighbours(const Mesh& mesh, std::span<const Vec3> variance) {
    std::vector<Vec3> result(variance.size());
    for (std::uint32_t i = 0; i < result.size(); ++i) {
        Vec3 sum = variance[i];
        double count = 1;
        for_alike_neighbours(mesh, i, [&](std::uint32_t j) {
            sum += variance[j];
            ++count;
        });
        result[i] = glm::max(sum / count, 0.5 * (sum / count + variance[i]));
    }
    return result;
}

} // namespace hemilux
