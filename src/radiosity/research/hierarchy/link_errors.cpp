#include "radiosity/research/hierarchy/link_errors.h"

#include "radiosity/paper/solution/missed_light.h"

#include <algorithm>

namespace hemilux {

/// Returns the squares of 1.5 times the change: the mean of that there and that on the whole
/// surface, as some patches change little by chance.
std::vector<Vec3> squares_of_changes(const PatchTree& tree, std::span<const double> area,
                                     std::span<const Vec3> before, std::span<const Vec3> after) {
    std::vector<Vec3> squares(area.size());
    for (const std::uint32_t root : tree.roots()) {
        const PatchTree::Node& node = tree[root];
        const auto patches = tree.order().subspan(node.begin, node.end - node.begin);
        Vec3 of_root(0.0);
        for (const std::uint32_t i : patches) {
            const Vec3 change = 1.5 * (after[i] - before[i]);
            squares[i] = change * change;
            of_root += area[i] * squares[i];
        }
        if (node.area > 0)
            for (const std::uint32_t i : patches)
                squares[i] = .5 * (squares[i] + of_root / node.area);
    }
    return squares;
}

std::vector<Vec3> missed_over_links(const PatchTree& tree, const Links& links,
                                    std::span<const LinkFactors> batches,
                                    std::span<const std::uint32_t> points,
                                    std::span<const Vec3> radiosity) {
    const std::size_t nodes = tree.nodes().size(), n = radiosity.size();
    std::vector<Vec3> result(n);
    std::vector<double> light(n), by_node(nodes), squares(nodes), by_patch(n);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < n; ++i)
            light[i] = radiosity[i][c];
        tree.pull(light, by_node);
        std::ranges::fill(squares, 0.0);
        for (std::size_t l = 0; l < points.size(); ++l) {
            const Link& link = links.all()[l];
            const bool seen = std::ranges::any_of(
                batches, [l](const LinkFactors& f) { return f.factors()[l] > 0; });
            const double share =
                std::min(1.0, rule_of_three / (double(points[l]) * double(batches.size())));
            const double most =
                share * rough_factor(tree[link.to], tree[link.from]) * by_node[link.from];
            if (!seen)
                squares[link.to] += most * most;
        }
        tree.push(squares, by_patch);
        for (std::size_t i = 0; i < n; ++i)
            result[i][c] = by_patch[i];
    }
    return result;
}

} // namespace hemilux
