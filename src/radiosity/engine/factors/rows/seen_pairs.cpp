#include "radiosity/engine/factors/rows/seen_pairs.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

std::vector<std::vector<SeenPair>> pairs_of(std::vector<std::vector<SeenPatch>> seen) {
    std::vector<std::vector<SeenPair>> higher(seen.size());
    for (std::uint32_t i = 0; i < seen.size(); ++i) {
        for (const auto& [j, rays] : seen[i])
            higher[std::min(i, j)].push_back({std::max(i, j), rays});
        seen[i] = {};
    }
    for (std::vector<SeenPair>& row : higher) {
        std::ranges::sort(row, {}, &SeenPair::to);
        std::size_t kept = 0;
        for (const SeenPair& pair : row)
            if (kept > 0 && row[kept - 1].to == pair.to)
                row[kept - 1].rays += pair.rays;
            else
                row[kept++] = pair;
        row.resize(kept);
    }
    return higher;
}

void pairs_by_rays(std::uint32_t i, std::span<const FacePlane> faces,
                   std::span<const SeenPair> seen, std::uint32_t rays,
                   std::vector<PairExchange>& pairs, std::vector<float>& missed) {
    for (const SeenPair& pair : seen) {
        const double of_one = 1 / (rays * (1 / faces[i].area + 1 / faces[pair.to].area));
        const double deviation = of_one * std::sqrt(pair.rays + 1.0);
        pairs.push_back({pair.to, static_cast<float>(deviation), of_one * pair.rays});
        missed.push_back(pair.rays == 1 ? static_cast<float>(of_one) : 0);
    }
}

} // namespace hemilux
