#include "radiosity/answers/run/unknown_groups.h"

#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <algorithm>
#include <vector>

namespace hemilux {
namespace {

/// The relative standard error above which light is not known.
constexpr double unknown = .25;

/// The most groups that are named.
constexpr std::size_t max_named = 4;

struct OfGroup {
    double light = 0, variance = 0; ///< squares times area
};

} // namespace

std::optional<Finding> unknown_groups_finding(const Mesh& mesh, const Solution& solution) {
    const auto& names = mesh.scene().groups;
    if (names.size() < 2 || solution.steps < 2 || !solution.weight.empty())
        return {};
    std::vector<OfGroup> groups(names.size());
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        const Vec3 reflected = solution.radiosity[i] - mesh.material(patch).emission;
        OfGroup& group = groups[mesh.scene().facets[patch.facet].group];
        group.light += patch.area * glm::dot(reflected, reflected);
        group.variance +=
            patch.area * glm::dot(solution.standard_error[i], solution.standard_error[i]);
    }
    std::vector<std::string> found;
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].variance > unknown * unknown * groups[g].light)
            found.push_back(names[g]);
    if (found.empty())
        return {};
    std::string text = "the light of ";
    for (std::size_t k = 0; k < std::min(found.size(), max_named); ++k)
        text += (k > 0 ? ", " : "") + found[k];
    if (found.size() > max_named)
        text += " and " + std::to_string(found.size() - max_named) + " other groups";
    return Finding{Finding::Kind::warning,
                   text + " is not known: its standard error is more than a quarter of it",
                   "--for group:" + found.front() + " finds it"};
}

} // namespace hemilux
