#include "app/running/run_target.h"

#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"
#include "io/files/error.h"

#include <algorithm>

namespace hemilux {
namespace {

std::vector<std::uint32_t> groups_of(const TargetSettings& target, const Scene& scene) {
    std::vector<std::uint32_t> groups;
    for (const std::string& name : target.groups) {
        const auto found = std::ranges::find(scene.groups, name);
        if (found == scene.groups.end())
            throw UsageError("--for: " + unknown_name("group", name, scene.groups));
        groups.push_back(static_cast<std::uint32_t>(found - scene.groups.begin()));
    }
    return groups;
}

/// Throws InputError unless every point lies on a face.
void check_points(const Problem& problem, const RunTarget& target,
                  const std::vector<PointsOfFile>& files) {
    const auto off = point_off_faces(target, *problem.mesh, *problem.tracer);
    std::size_t before = 0; // of the files before
    for (const PointsOfFile& file : files) {
        if (off && *off < before + file.points.size())
            throw InputError(file.path, file.points[*off - before].line,
                             "--for: expected a point on a face that looks along its normal");
        before += file.points.size();
    }
}

} // namespace

void check_target(const SolveSettings& settings) {
    const TargetSettings& target = settings.target;
    if (target.names().empty())
        return;
    if (!settings.method->takes_target())
        throw UsageError(
            "--for: --method " + std::string(settings.method->name) +
            " solves for all patches alike; these take a target: " +
            names_of_methods([](const Method& method) { return method.takes_target(); }));
    if (settings.plain)
        throw UsageError("--for: --plain solves for all patches alike; leave one of them out");
    if (settings.options.literal)
        throw UsageError("--for: with --literal each patch shoots as many rays as any other; "
                         "leave one of them out");
    if (target.camera && !settings.view.camera)
        throw UsageError("--for camera needs the view of --camera, as the program chooses one by "
                         "the light");
}

std::vector<PointsOfFile> points_of_target(const TargetSettings& target) {
    std::vector<PointsOfFile> points;
    for (const std::string& path : target.points)
        points.push_back({path, read_points(path)});
    return points;
}

void aim_at(Problem& problem, const SolveSettings& settings,
            const std::vector<PointsOfFile>& points) {
    RunTarget target;
    if (settings.target.camera)
        target.picture = TargetPicture{*settings.view.camera, settings.view.size};
    target.groups = groups_of(settings.target, problem.mesh->scene());
    for (const PointsOfFile& file : points)
        for (const NamedPoint& point : file.points)
            target.points.push_back({point.position, point.normal});
    check_points(problem, target, points);
    problem.aim_at(std::move(target));
    if (!reflects(*problem.mesh, problem.weights))
        throw InputError(settings.scene.path, "nothing that --for names reflects light, so there "
                                              "is no error to solve it to");
}

} // namespace hemilux
