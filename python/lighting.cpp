// What is asked of a solution: light at points, pictures, lightmaps, and the light of each lamp.

#include "app/settings/exit_code.h"
#include "parallel/workers.h"
#include "python/parts.h"
#include "python/run.h"
#include "python/waiting.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/gathering/light_of_lightmap.h"
#include "radiosity/answers/gathering/light_of_picture.h"
#include "radiosity/answers/gathering/light_of_points.h"
#include "radiosity/answers/lamps/light_of_lamps.h"
#include "radiosity/answers/views/automatic_camera.h"

#include <pybind11/stl.h>

namespace hemilux {
namespace {

/// Gathers from the solution of a run, while Python's other threads go on: work(gatherer) may not
/// touch Python's objects.
template <class Work>
py::list gather_from(const PythonRun& kept, const Asked& asked, const py::object& progress,
                     const Work& work) {
    const Run& run = kept.result->run;
    std::vector<std::string> texts;
    struct Keeping : Watcher {
        explicit Keeping(std::vector<std::string>& kept_texts) : kept(kept_texts) {}
        void take(const Finding& finding) override {
            if (finding.kind == Finding::Kind::warning)
                kept.push_back(finding.text);
        }
        std::vector<std::string>& kept;
    } watcher(texts);
    Monitor monitor;
    run_without_lock(monitor, progress, [&] {
        const LitScene scene{run.mesh(), *run.problem->tracer, run.solution().radiosity,
                             asked.threads};
        Gatherer gatherer(scene, run.solution(), asked, monitor, watcher);
        work(gatherer);
    });
    py::list warnings;
    for (const std::string& text : texts)
        warnings.append(text);
    return warnings;
}

py::dict errors_of(const AnswerError& error, const Work& work, py::list warnings) {
    py::dict result;
    result["estimated_error"] = error.whole;
    result["error_bound"] = error.bound;
    result["error_local"] = error.local;
    result["rays"] = work.rays();
    result["warnings"] = std::move(warnings);
    return result;
}

/// Returns an array of shape (height, width, 3).
py::array_t<float> pixels_of(Image&& image) {
    return arrays_detail::owning<float>(std::move(image.pixels), {image.height, image.width, 3});
}

py::dict points_of(const PythonRun& kept, const Doubles& places, const Asked& asked,
                   const py::object& progress) {
    const std::span<const Vec3> rows(reinterpret_cast<const Vec3*>(places.data()),
                                     2 * static_cast<std::size_t>(places.shape(0)));
    std::vector<WantedPoint> wanted;
    for (std::size_t k = 0; k < rows.size(); k += 2)
        wanted.push_back({rows[k], glm::normalize(rows[k + 1])});
    Answer<GatheredPoints> answer;
    py::list warnings = gather_from(kept, asked, progress, [&](Gatherer& gatherer) {
        answer = gather_points(gatherer, wanted,
                               estimated_error(gatherer.scene().mesh, gatherer.solution()));
    });
    const std::vector<PointLight>& lights = answer.value.found.lights;
    std::vector<Vec3> irradiance, standard_error;
    for (const PointLight& light : lights) {
        irradiance.push_back(light.irradiance);
        standard_error.push_back(light.standard_error);
    }
    py::dict result = errors_of(answer.error, answer.work, std::move(warnings));
    result["irradiance"] = array_of(std::move(irradiance));
    result["standard_error"] = array_of(std::move(standard_error));
    py::array_t<bool> known(static_cast<py::ssize_t>(lights.size()));
    for (std::size_t k = 0; k < lights.size(); ++k)
        known.mutable_at(static_cast<py::ssize_t>(k)) = lights[k].is_known;
    result["is_known"] = known;
    return result;
}

py::tuple tuple_of(const Camera& camera) {
    const auto& [eye, target, up, fov] = camera;
    return py::make_tuple(eye.x, eye.y, eye.z, target.x, target.y, target.z, fov, up.x, up.y, up.z);
}

py::dict picture_of(const PythonRun& kept, const std::optional<std::vector<double>>& camera,
                    int width, int height, std::optional<int> up, const Asked& asked,
                    const py::object& progress) {
    WantedPicture wanted;
    wanted.size = {width, height};
    if (camera) {
        const std::vector<double>& n = *camera;
        wanted.camera = {.eye = {n[0], n[1], n[2]}, .target = {n[3], n[4], n[5]}};
        if (n.size() > 6)
            wanted.camera.vertical_fov_degrees = n[6];
        if (n.size() > 9)
            wanted.camera.up = {n[7], n[8], n[9]};
    }
    std::optional<Answer<LightOfPicture>> answer;
    py::list warnings = gather_from(kept, asked, progress, [&](Gatherer& gatherer) {
        const auto& [mesh, tracer, radiosity, threads] = gatherer.scene();
        if (!camera)
            wanted.camera =
                automatic_camera(mesh, tracer, radiosity, double(width) / height, up, threads);
        answer = gather_picture(gatherer, wanted);
    });
    py::dict result = errors_of(answer->error, answer->work, std::move(warnings));
    result["light"] = pixels_of(std::move(answer->value.image));
    result["camera"] = tuple_of(wanted.camera);
    return result;
}

py::dict lightmap_of(const PythonRun& kept, int size, bool irradiance, const Asked& asked,
                     const py::object& progress) {
    const Mesh& mesh = kept.result->run.mesh();
    Answer<LightOfLightmap> answer;
    LightmapLayout layout;
    try {
        layout = {placed_triangles(mesh, find_charts(mesh, size)), size, gutter};
    } catch (const LightmapTooSmall& error) {
        throw UsageError(std::string("size: ") + error.what());
    }
    py::list warnings = gather_from(kept, asked, progress, [&](Gatherer& gatherer) {
        answer = gather_lightmap(gatherer,
                                 {"", layout, irradiance ? Bake::irradiance : Bake::radiosity});
    });
    const std::size_t count = layout.triangles.size();
    std::vector<Vec3> corners;
    std::vector<double> places;
    for (const PlacedTriangle& triangle : layout.triangles) {
        for (const Vec3& corner : corners_of(mesh, triangle))
            corners.push_back(mesh.frame().to_world(corner));
        for (const Vec2& place : triangle.place) {
            places.push_back(place.x / size);
            places.push_back(place.y / size);
        }
    }
    const auto n = static_cast<py::ssize_t>(count);
    py::dict result = errors_of(answer.error, answer.work, std::move(warnings));
    result["light"] = pixels_of(std::move(answer.value.image));
    result["face"] = array_by<std::int64_t>(count, [&](std::size_t k) {
        return std::int64_t{mesh.scene().facets[layout.triangles[k].facet].face};
    });
    result["corners"] = arrays_detail::owning<double>(std::move(corners), {n, 3, 3});
    result["places"] = arrays_detail::owning<double>(std::move(places), {n, 3, 2});
    return result;
}

py::list lamps_of(PythonRun& kept, const std::string& by, unsigned threads,
                  const py::object& progress) {
    const Run& run = kept.result->run;
    const auto* const solver = dynamic_cast<const KeepsRays*>(run.solver.get());
    if (!solver || run.solution().steps == 0)
        throw UsageError("lamps: only stored-transport keeps the rays that other lamps would take, "
                         "and after a step");
    const LayersBy layers = by == "group"      ? LayersBy::group
                            : by == "material" ? LayersBy::material
                                               : LayersBy::lamp;
    std::optional<LampLight> light;
    kept.monitor.interrupted.set_wished(false);
    run_without_lock(kept.monitor, progress, [&] {
        light =
            light_of_lamps({run.mesh(), *run.problem->tracer, run.solution().radiosity, threads},
                           run.solution(), *solver, layers, kept.monitor);
    });
    py::list result;
    for (std::size_t k = 0; light && k < light->patches.size(); ++k) {
        py::dict lamp;
        lamp["name"] = light->lamps.layers[k].name;
        lamp["power"] = array_of(std::vector<Vec3>{light->lamps.layers[k].power});
        lamp["radiosity"] = array_of(std::move(light->patches[k].radiosity));
        lamp["standard_error"] = array_of(std::move(light->patches[k].standard_error));
        lamp["estimated_error"] = light->errors[k];
        result.append(lamp);
    }
    return result;
}

} // namespace

void add_lighting(py::module_& module) {
    py::class_<PythonRun>(module, "Run");
    py::class_<Asked>(module, "Asked")
        .def(py::init<>())
        .def_readwrite("error", &Asked::error)
        .def_readwrite("seed", &Asked::seed)
        .def_readwrite("threads", &Asked::threads)
        .def_readwrite("max_rays", &Asked::max_rays)
        .def_readwrite("seconds", &Asked::seconds);
    module.def("points", &points_of);
    module.def("picture", &picture_of);
    module.def("lightmap", &lightmap_of);
    module.def("lamps", &lamps_of);
}

} // namespace hemilux
