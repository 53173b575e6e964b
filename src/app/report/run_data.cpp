#include "app/report/run_data.h"

#include "radiosity/scene/mesh.h"

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

/// As JSON has it, also where JSON stands within HTML.
std::string without_tags(const std::string& json) {
    std::string text;
    for (const char c : json)
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    return text;
}

} // namespace

std::string run_json(const ReportContent& content) {
    const Mesh& mesh = content.mesh;
    const Json run = {
        {"scene", content.scene},
        {"command", content.command},
        {"version", HEMILUX_VERSION},
        {"centre", numbers(mesh.frame().centre)},
        {"materials", materials_of(mesh)},
        {"groups", mesh.scene().groups},
        {"camera", camera_json(content.camera)},
        {"exposure", content.exposure ? Json(*content.exposure) : Json()},
        {"statistics", Json::parse(to_json(content.statistics))},
        {"steps", steps_json(content.steps)},
        {"warnings", std::vector<std::string>(content.warnings.begin(), content.warnings.end())}};
    return without_tags(run.dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace hemilux
