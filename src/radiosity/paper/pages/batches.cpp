#include "radiosity/paper/pages/batches.h"

#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"

#include <array>

namespace hemilux::plain {

void combine_batches(const Mesh& mesh, std::span<const std::vector<Vec3>, batches + 1> B,
                     Solution& solution) {
    std::vector<Vec3> variance(mesh.patches().size());
    std::array<double, batches * batches> products{};
    double sum = 0;
    for (std::size_t i = 0; i < variance.size(); ++i) {
        const double area = mesh.patches()[i].area;
        const Vec3 mean = mean_of_batches(B, i);
        for (std::size_t s = 0; s < batches; ++s) {
            const Vec3 off = B[s][i] - mean;
            variance[i] += off * off / double(batches * (batches - 1));
            for (std::size_t t = 0; t < batches; ++t)
                products[s * batches + t] += area * glm::dot(off, B[t][i] - mean);
        }
        sum += area * (variance[i].x + variance[i].y + variance[i].z);
    }
    variance = pooled_over_neighbours(mesh, variance); // of four samples each
    for (std::size_t i = 0; i < variance.size(); ++i)
        solution.standard_error[i] = glm::sqrt(variance[i]);
    solution.radiosity = B[batches];
    solution.variance = sum;
    solution.error_batches = batches;
    solution.effective_freedom =
        believed_freedom(solution.effective_freedom, effective_freedom(products, batches));
}

void add_missing(const Mesh& mesh, const Vec3& arriving, Solution& solution) {
    solution.missed = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Vec3 missing = mesh.material(i).reflectance * arriving;
        Vec3& sigma = solution.standard_error[i];
        sigma = glm::sqrt(sigma * sigma + missing * missing);
        solution.missed += mesh.patches()[i].area * glm::dot(missing, missing);
    }
}

} // namespace hemilux::plain
