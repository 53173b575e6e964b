// rays: what single rays meet, many at once.

#include "parallel/workers.h"
#include "python/parts.h"
#include "python/scene.h"
#include "python/waiting.h"

#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// Rays in the units of the vertices; Python has checked that there are as many of both.
struct RayArrays {
    std::span<const Vec3> origins, directions;

    [[nodiscard]] std::size_t size() const { return origins.size(); }
    /// Returns a ray of unit direction in the local frame.
    [[nodiscard]] Ray local(const LocalFrame& frame, std::size_t k) const {
        return {frame.to_local(origins[k]), glm::normalize(directions[k])};
    }
};

/// Calls each(k, ray) for all rays, from several threads; leaves the rest where it is interrupted.
template <class Each>
void for_rays(const PythonMesh& mesh, const RayArrays& rays, unsigned threads, Monitor& monitor,
              const Each& each) {
    constexpr std::size_t chunk = 1024;
    const LocalFrame& frame = mesh.mesh().frame();
    Workers(threads).for_chunks(rays.size(), chunk, [&](std::size_t begin, std::size_t end) {
        if (monitor.interrupted)
            return;
        for (std::size_t k = begin; k < end; ++k)
            each(k, rays.local(frame, k));
    });
}

py::tuple closest(const PythonMesh& mesh, const Doubles& origins, const Doubles& directions,
                  unsigned threads) {
    const RayArrays rays{rows_of(origins), rows_of(directions)};
    std::vector<std::int64_t> face(rays.size(), -1), patch(rays.size(), -1);
    std::vector<double> distance(rays.size(), std::numeric_limits<double>::infinity());
    std::vector<std::uint8_t> front(rays.size());
    Monitor monitor;
    run_without_lock(monitor, py::none(), [&] {
        const WideBvh& tree = mesh.tree(threads);
        for_rays(mesh, rays, threads, monitor, [&](std::size_t k, const Ray& ray) {
            const std::optional<Hit> hit = tree.closest(ray);
            if (!hit)
                return;
            face[k] = mesh.mesh().scene().facets[hit->facet].face;
            const std::uint32_t of_hit = mesh.mesh().patch_at(*hit);
            patch[k] = of_hit == none ? -1 : static_cast<std::int64_t>(of_hit);
            distance[k] = hit->t / mesh.mesh().frame().scale;
            front[k] = hit->front;
        });
    });
    return py::make_tuple(array_of(std::move(face)), array_of(std::move(patch)),
                          array_of(std::move(distance)), array_of(std::move(front)));
}

py::array_t<std::int64_t> count(const PythonMesh& mesh, const Doubles& origins,
                                const Doubles& directions, unsigned threads) {
    const RayArrays rays{rows_of(origins), rows_of(directions)};
    std::vector<std::int64_t> surfaces(rays.size());
    Monitor monitor;
    run_without_lock(monitor, py::none(), [&] {
        const WideBvh& tree = mesh.tree(threads);
        for_rays(mesh, rays, threads, monitor,
                 [&](std::size_t k, const Ray& ray) { surfaces[k] = tree.count(ray); });
    });
    return array_of(std::move(surfaces));
}

} // namespace

void add_rays(py::module_& module) {
    module.def("closest", &closest);
    module.def("count", &count);
}

} // namespace hemilux
