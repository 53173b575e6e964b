#include "radiosity/linear/batch_mean.h"

namespace hemilux {

BatchMean mean_of_batches(std::span<const std::vector<Vec3>> batches,
                          std::span<const double> area) {
    const std::size_t count = batches.size();
    BatchMean result;
    result.products.resize(count * count);
    std::vector<Vec3> off(count);
    for (std::size_t i = 0; i < area.size(); ++i) {
        Vec3 mean(0.0), squares(0.0);
        for (const std::vector<Vec3>& batch : batches)
            mean += batch[i] / double(count);
        for (std::size_t r = 0; r < count; ++r) {
            off[r] = batches[r][i] - mean;
            squares += off[r] * off[r];
        }
        for (std::size_t r = 0; r < count; ++r)
            for (std::size_t t = 0; t < count; ++t)
                result.products[r * count + t] += area[i] * glm::dot(off[r], off[t]);
        result.radiosity.push_back(mean);
        result.variance.push_back(squares / double(count * (count - 1)));
    }
    return result;
}

} // namespace hemilux
