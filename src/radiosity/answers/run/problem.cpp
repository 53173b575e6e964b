#include "radiosity/answers/run/problem.h"

#include "geometry/polygon.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/needs/convex_enclosure.h"
#include "radiosity/engine/needs/find_needs.h"

#include <utility>

namespace hemilux {
namespace {

Needs needs_of(const Mesh& mesh, bool keep_all) {
    if (!keep_all)
        return find_needs(mesh);
    Needs needs;
    needs.closed = convex_enclosure(mesh) == Enclosure::tight;
    return needs;
}

} // namespace

void Problem::aim_at(RunTarget aim) {
    target = std::move(aim);
    weights = target_weights(target, *mesh, *tracer, threads);
}

void Problem::find_again() {
    if (!keep_all)
        needs = find_needs(*mesh);
    weights = target_weights(target, *mesh, *tracer, threads);
}

/// Prepares the tracer and the needs, each by a thread of its own, where there are two.
Problem prepare(std::shared_ptr<Mesh> mesh, MadeTracer made, const ProblemChoices& choices,
                Watcher& watcher) {
    Problem problem{.mesh = std::move(mesh),
                    .tracer = nullptr,
                    .keep_all = choices.keep_all,
                    .threads = choices.threads};
    const Mesh& of = *problem.mesh;
    Workers(choices.threads).for_chunks(2, 1, [&](std::size_t part, std::size_t) {
        if (part == 1)
            problem.needs = needs_of(of, choices.keep_all);
        else if (!made.tracer)
            made = make_tracer(of, choices.threads);
    });
    problem.tracer = std::move(made.tracer);
    problem.tree = made.tree;
    if (std::string text = crowd_text(made.crowd, of); !text.empty())
        watcher.tell(Finding::Kind::warning, std::move(text));
    return problem;
}

Problem prepare(std::shared_ptr<Mesh> mesh, std::shared_ptr<const Tracer> tracer,
                const ProblemChoices& choices) {
    Needs needs = needs_of(*mesh, choices.keep_all);
    return {.mesh = std::move(mesh),
            .tracer = std::move(tracer),
            .keep_all = choices.keep_all,
            .threads = choices.threads,
            .needs = std::move(needs)};
}

std::string crowd_text(const Crowd& crowd, const Mesh& mesh) {
    constexpr std::size_t many = 1000;
    if (crowd.triangles < many)
        return "";
    const Scene& scene = mesh.scene();
    const Facet& facet = scene.facets[crowd.facet];
    constexpr double steps = 4096; // in the scene: rounding is not to be printed
    const Vec3 local = polygon_of(mesh.vertices(), facet.vertex).centre();
    const Vec3 place = mesh.frame().to_world(glm::round(local * steps) / steps);
    return "a ray has to test about " + grouped(crowd.triangles) +
           " triangles, as so many lie in one place (group " + scene.groups[facet.group] +
           formatted(", around %.4g %.4g %.4g), ", place.x, place.y, place.z) +
           "so this takes long; remove what is there many times over, as Merge by Distance of "
           "Blender does, or end sooner by --time";
}

} // namespace hemilux
