// density: the divided hemisphere of one patch, as preprocessing of the paper makes it (section
// 5a).

#include "app/settings/exit_code.h"
#include "parallel/workers.h"
#include "python/parts.h"
#include "python/scene.h"
#include "python/waiting.h"
#include "radiosity/engine/densities/density.h"

#include <numbers>

namespace hemilux {
namespace {

struct OnePatch {
    std::vector<DensityLeaf> leaves;
    std::vector<DensityCount> counts;
    std::uint64_t rays = 0;
};

/// Counts the surfaces of this patch alone: all others are idle.
OnePatch count_of(const PythonMesh& mesh, std::uint32_t patch, const Hemisphere& hemisphere,
                  double threshold, Monitor& monitor) {
    Needs needs;
    needs.idle.assign(mesh.mesh().patches().size(), true);
    needs.idle[patch] = false;
    const DensityMap map(mesh.mesh(), mesh.tree(0), hemisphere, threshold, Workers(1), monitor,
                         needs);
    OnePatch result;
    if (monitor.interrupted)
        return result;
    map.leaves(patch, result.leaves);
    map.counts(patch, result.counts);
    result.rays = map.rays();
    return result;
}

py::dict result_of(const PythonMesh& mesh, std::uint32_t patch, const Hemisphere& hemisphere,
                   const OnePatch& found) {
    const Frame frame = mesh.mesh().hemisphere_frame(patch);
    const auto cell = [&](std::size_t k) -> const Hemisphere::Cell& {
        return hemisphere.cells()[found.leaves[k].cell];
    };
    const std::size_t triangles = found.leaves.size(), counts = found.counts.size();
    std::vector<Vec3> corners;
    for (const DensityLeaf& leaf : found.leaves)
        for (const std::uint16_t vertex : hemisphere.cells()[leaf.cell].vertex)
            corners.push_back(frame.to_world(hemisphere.vertices()[vertex]));
    py::dict result;
    result["triangles"] = array_of(std::move(corners)); // which Python puts together by three
    result["density"] =
        array_by<double>(triangles, [&](std::size_t k) { return found.leaves[k].density; });
    result["level"] =
        array_by<std::int64_t>(triangles, [&](std::size_t k) { return cell(k).level; });
    result["solid_angle"] =
        array_by<double>(triangles, [&](std::size_t k) { return cell(k).solid_angle; });
    result["power_share"] = array_by<double>(
        triangles, [&](std::size_t k) { return cell(k).projected_solid_angle / std::numbers::pi; });
    result["directions"] = array_by<Vec3>(counts, [&](std::size_t k) {
        return frame.to_world(hemisphere.vertices()[found.counts[k].vertex]);
    });
    result["surfaces"] =
        array_by<std::uint8_t>(counts, [&](std::size_t k) { return found.counts[k].surfaces; });
    result["rays"] = found.rays;
    return result;
}

py::dict density(const PythonMesh& mesh, std::uint32_t patch, int depth, double threshold) {
    if (patch >= mesh.mesh().patches().size())
        throw UsageError("patch: there is no patch " + std::to_string(patch) +
                         "; they are numbered from 0 to " +
                         std::to_string(mesh.mesh().patches().size() - 1));
    const Hemisphere hemisphere(depth);
    Monitor monitor;
    OnePatch found;
    run_without_lock(monitor, py::none(),
                     [&] { found = count_of(mesh, patch, hemisphere, threshold, monitor); });
    return result_of(mesh, patch, hemisphere, found);
}

} // namespace

void add_density(py::module_& module) { module.def("density", &density); }

} // namespace hemilux
