#include "app/loading/reference.h"

#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "io/files/error.h"
#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

namespace {

/// The tolerance for tables from other programs, which may carry fewer digits.
constexpr double tolerance = 1e-4;

bool same_patch(const PatchTable& table, std::size_t i, const Mesh& mesh) {
    const Patch& patch = mesh.patches()[i];
    const double area = mesh.frame().area_to_world(patch.area);
    const double away = glm::length(mesh.frame().to_local(table.centre[i]) - patch.centre);
    return std::abs(table.area[i] - area) <= tolerance * area &&
           away <= tolerance * std::sqrt(patch.area) + 1e-9;
}

/// Throws InputError unless the table's rows are the mesh's patches.
void check_same_patches(const PatchTable& table, const std::string& path, const Mesh& mesh) {
    const std::size_t patches = mesh.patches().size();
    if (table.radiosity.size() != patches)
        throw InputError(path, "has " + counted(table.radiosity.size(), "patch", "patches") +
                                   ", the scene has " + std::to_string(patches) +
                                   "; were --max-edge and --sides the same?");
    for (std::size_t i = 0; i < patches; ++i)
        if (!same_patch(table, i, mesh))
            throw InputError(path, "patch " + std::to_string(i) +
                                       " has another place or area than in the scene");
}

} // namespace

double Reference::relative_mse(const Mesh& mesh, std::span<const Vec3> solution) const {
    double area = 0, light = 0, sum = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        area += 3 * mesh.patches()[i].area;
        light += mesh.patches()[i].area * glm::dot(radiosity[i], Vec3(1.0));
    }
    const double least = .01 * (light / area) * (light / area);
    for (std::uint32_t i = 0; least > 0 && i < radiosity.size(); ++i) {
        const Vec3 off = solution[i] - radiosity[i];
        const Vec3 relative = off * off / (radiosity[i] * radiosity[i] + least);
        sum += mesh.patches()[i].area * glm::dot(relative, Vec3(1.0));
    }
    return sum / area;
}

Reference reference_of(PatchTable table, const std::string& path, const Mesh& mesh,
                       std::vector<bool> detail) {
    check_same_patches(table, path, mesh);
    return {std::move(table.radiosity), std::move(table.standard_error), std::move(detail)};
}

std::vector<bool> detail_mask(const Mesh& mesh, const std::vector<std::string>& groups) {
    const std::vector<std::string>& known = mesh.scene().groups;
    for (const std::string& group : groups)
        if (std::ranges::find(known, group) == known.end())
            throw UsageError("--detail: " + unknown_name("group", group, known));
    const auto wanted = [&](const std::string& name) {
        return groups.empty() ? name.starts_with("detail")
                              : std::ranges::find(groups, name) != groups.end();
    };
    std::vector<bool> group_wanted(known.size());
    std::transform(known.begin(), known.end(), group_wanted.begin(), wanted);

    std::vector<bool> mask(mesh.patches().size());
    for (std::size_t i = 0; i < mask.size(); ++i)
        mask[i] = group_wanted[mesh.scene().facets[mesh.patches()[i].facet].group];
    return mask;
}

} // namespace hemilux
