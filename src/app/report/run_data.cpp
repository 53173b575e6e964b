#include "app/report/run_data.h"

#include "app/terminal/machine.h"
#include "io/files/text_words.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hemilux {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json materials_of(const Mesh& mesh) {
    Json list = Json::array();
    for (const Material& material : mesh.scene().materials)
        list.push_back({{"name", material.name},
                        {"reflectance", numbers(material.reflectance)},
                        {"emission", numbers(material.emission)},
                        {"far", material.is_far}});
    return list;
}

Json camera_json(const Camera& camera) {
    return {{"eye", numbers(camera.eye)},
            {"target", numbers(camera.target)},
            {"up", numbers(camera.up)},
            {"fov", camera.vertical_fov_degrees}};
}

Json steps_json(std::span<const StepRow> rows) {
    Json list = Json::array();
    for (const StepRow& row : rows) {
        const StepRecord& record = row.record;
        list.push_back({{"step", record.step},
                        {"rays", record.rays},
                        {"seconds", record.seconds},
                        {"estimated_error", record.estimated_error},
                        {"true_error", row.error ? Json(row.error->all) : Json()}});
    }
    return list;
}

Json charts_json(std::span<const PageChart> charts) {
    Json list = Json::array();
    for (const PageChart& chart : charts)
        if (!chart.svg.empty())
            list.push_back({{"name", chart.name}, {"svg", chart.svg}});
    return list;
}

/// Returns what a page says of any run. Content is ReportContent or ComparisonContent.
template <class Content>
Json common_json(const Content& content) {
    const Mesh& mesh = content.mesh;
    return {
        {"scene", content.scene},
        {"command", content.command},
        {"version", HEMILUX_VERSION},
        {"machine", machine_text()},
        {"centre", numbers(mesh.frame().centre)},
        {"materials", materials_of(mesh)},
        {"groups", mesh.scene().groups},
        {"camera", camera_json(content.camera)},
        {"exposure", content.exposure ? Json(*content.exposure) : Json()},
        {"warnings", std::vector<std::string>(content.warnings.begin(), content.warnings.end())}};
}

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json lit_steps(std::span<const LightOfStep> lights) {
    Json list = Json::array();
    for (const LightOfStep& light : lights)
        list.push_back(light.step);
    return list;
}

Json methods_json(std::span<const ComparedMethod> methods) {
    Json list = Json::array();
    for (const ComparedMethod& method : methods) {
        list.push_back(
            {{"name", method.name}, {"label", method.label}, {"steps", lit_steps(method.lights)}});
    }
    return list;
}

Json row_json(const StepRow& row) {
    const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(); };
    const auto error = [&](double RelativeError::*which) {
        return row.error ? Json((*row.error).*which) : Json();
    };
    const StepRecord& record = row.record;
    return Json::array({row.method, row.run, record.step, record.rays, record.seconds,
                        record.estimated_error, error(&RelativeError::all),
                        error(&RelativeError::detail), error(&RelativeError::rest),
                        number(row.total_error)});
}

} // namespace

double unit_of_lamps(const ReportContent& content) {
    return mean_light(content.mesh, content.solution.radiosity);
}

std::string run_json(const ReportContent& content) {
    const auto curve = [&](std::size_t kind) {
        return ChartedRuns{error_kinds()[kind].name, {content.steps}, &error_kinds()[kind]};
    };
    const bool is_compared = std::ranges::any_of(
        content.steps, [](const StepRow& row) { return row.error.has_value(); });
    std::vector<ChartedRuns> curves{curve(estimated_kind)};
    if (is_compared)
        curves.push_back(curve(true_kind));
    const PageChart chart = page_chart("error", curves);

    Json run = common_json(content);
    run["statistics"] = Json::parse(to_json(content.statistics));
    run["steps"] = steps_json(content.steps);
    run["charts"] = charts_json({&chart, 1});
    run["unit"] = content.unit;
    run["lit_steps"] = lit_steps(content.lights);
    for (std::size_t k = 0; k < content.lamps.patches.size(); ++k)
        run["lamps"].push_back(content.lamps.lamps.layers[k].name);
    if (run.contains("lamps"))
        run["lamp_unit"] = unit_of_lamps(content);
    if (content.densities)
        run["threshold"] = content.densities->threshold;
    return text_of(run);
}

std::string comparison_json(const ComparisonContent& content) {
    Json run = common_json(content);
    run["unit"] = content.unit;
    run["methods"] = methods_json(content.methods);
    run["summary"] = content.summary;
    run["facts"] = content.facts;
    run["columns"] = parts_of(steps_columns, ',');
    run["rows"] = Json::array();
    for (const StepRow& row : content.rows)
        run["rows"].push_back(row_json(row));
    run["charts"] = charts_json(content.charts);
    return text_of(run);
}

} // namespace hemilux
