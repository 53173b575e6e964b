#include "io/results/scene_info_json.h"

#include <nlohmann/json.hpp>

namespace hemilux {
namespace {

using Json = nlohmann::ordered_json;

Json vector(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json to_object(const Orientation& sides) {
    return {{"faces_looking_away", sides.faces},      {"faces_in_doubt", sides.in_doubt},
            {"closed_inside_out", sides.inside_out},  {"open_lit_from_behind", sides.from_behind},
            {"lamps_turned_away", sides.emitters},    {"surfaces_that_disagree", sides.mixed},
            {"clashing_edges", sides.clashing_edges}, {"surfaces_without_sides", sides.one_sided},
            {"light_on_backs", sides.light.backs},    {"light_that_leaves", sides.light.escaped}};
}

Json to_object(std::span<const LeftOut> left_out) {
    Json list = Json::array();
    for (const LeftOut& item : left_out)
        list.push_back({{"what", item.what}, {"why", item.why}, {"saves", item.saved}});
    return list;
}

Json names_of(const std::vector<EmitterInfo>& emitters) {
    Json names = Json::array();
    for (const EmitterInfo& emitter : emitters)
        names.push_back(emitter.name);
    return names;
}

Json to_list(const std::vector<EmitterInfo>& emitters) {
    Json list = Json::array();
    for (const EmitterInfo& emitter : emitters)
        list.push_back({{"material", emitter.name},
                        {"emission", vector(emitter.emission)},
                        {"power", vector(emitter.power)},
                        {"both_sides", emitter.both_sides}});
    return list;
}

Json to_list(const std::vector<PointInfo>& points) {
    Json list = Json::array();
    for (const PointInfo& point : points)
        list.push_back({{"name", point.name},
                        {"kind", point.kind},
                        {"intensity", vector(point.intensity)},
                        {"power", vector(point.power)}});
    return list;
}

Json to_list(const std::vector<GlassInfo>& all) {
    Json list = Json::array();
    for (const GlassInfo& glass : all)
        list.push_back({{"material", glass.name},
                        {"transmittance", vector(glass.transmittance)},
                        {"open", glass.open}});
    return list;
}

Json to_object(const SceneReport& report) {
    const SceneInfo& info = report.info;
    return {
        {"faces", info.faces},
        {"facets", info.facets},
        {"triangles", info.triangles},
        {"quads", info.quads},
        {"vertices", info.vertices},
        {"materials", info.materials},
        {"groups", info.groups},
        {"patches", report.patches},
        {"lowest_corner", vector(info.bounds.low)},
        {"highest_corner", vector(info.bounds.high)},
        {"total_area", info.total_area},
        {"emitted_power", vector(info.emitted_power)},
        {"emitting_materials", names_of(info.emitters)},
        {"emitters", to_list(info.emitters)},
        {"lights_without_extent", to_list(info.points)},
        {"glass", to_list(info.glass)},
        {"faces_without_area", info.degenerate_faces},
        {"faces_not_planar", info.nonplanar_faces},
        {"faces_concave", info.concave_faces},
        {"open_edges", info.open_edges},
        {"edges_of_more_than_two", info.nonmanifold_edges},
        {"facets_covered", info.covered_facets},
        {"facets_covered_is_complete", info.all_compared},
        {"bad_reflectances", info.bad_reflectances},
        {"sides", report.sides ? to_object(*report.sides) : Json(nullptr)},
        {"not_needed", to_object(report.left_out)},
        {"warnings", report.warnings},
        {"error_division", report.error_division ? Json(*report.error_division) : Json(nullptr)}};
}

} // namespace

std::string to_json(const SceneReport& report) {
    // Names that are not UTF-8 are shown as far as they are; infinite bounds become null.
    constexpr int indent = 2;
    return to_object(report).dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace hemilux
