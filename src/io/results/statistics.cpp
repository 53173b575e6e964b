#include "io/results/statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <sys/resource.h>

namespace hemilux {
namespace {

/// The names of errors, in the order of ErrorOf.
constexpr std::array names_of_errors = {"patches", "surfaces", "gathered", "target"};

using Json = nlohmann::ordered_json;

Json channels(const Vec3& power) { return Json::array({power.x, power.y, power.z}); }

/// Returns the options by their names without dashes: true for a flag, several values as an array.
Json settings(const std::vector<GivenOption>& options) {
    Json object = Json::object();
    for (const auto& [name, values] : options) {
        Json& value = object[name.substr(std::min(name.find_first_not_of('-'), name.size()))];
        if (values.empty())
            value = true;
        else if (values.size() == 1)
            value = values.front();
        else
            value = values;
    }
    return object;
}

Json to_object(const Statistics& s) {
    Json left_out = Json::array();
    for (const LeftOut& item : s.left_out)
        left_out.push_back({{"what", item.what}, {"why", item.why}, {"saved", item.saved}});
    const auto error_of = static_cast<std::size_t>(s.estimated_error_of);
    Json object = {{"patches", s.patches},
                   {"faces", s.faces},
                   {"materials", s.materials},
                   {"method", s.method},
                   {"seed", s.seed},
                   {"threads", s.threads},
                   {"steps", s.steps},
                   {"rays_energy", s.rays_energy},
                   {"rays_density", s.rays_density},
                   {"seconds_read", s.seconds_read},
                   {"seconds_bvh", s.seconds_bvh},
                   {"seconds_density", s.seconds_density},
                   {"seconds_solve", s.seconds_solve},
                   {"seconds_divide", s.seconds_divide},
                   {"rays_divide", s.rays_divide},
                   {"seconds_division_error", s.seconds_division_error},
                   {"rays_division_error", s.rays_division_error},
                   {"rays_per_second", s.rays_per_second},
                   {"bytes_density", s.bytes_density},
                   {"bytes_density_paper", s.bytes_density_paper},
                   {"bytes_transport", s.bytes_transport},
                   {"links", s.links},
                   {"bytes_peak", s.bytes_peak},
                   {"estimated_error", s.estimated_error},
                   {"estimated_error_uncertainty", s.estimated_error_uncertainty},
                   {"error_bound", s.error_bound},
                   {"error_local", s.error_local},
                   {"estimated_error_of", names_of_errors.at(error_of)},
                   {"error_sampling", s.error_sampling},
                   {"error_division", s.error_division},
                   {"error_division_uncertainty", s.error_division_uncertainty},
                   {"energy",
                    {{"emitted", channels(s.energy.emitted)},
                     {"absorbed", channels(s.energy.absorbed)},
                     {"escaped", channels(s.energy.escaped)},
                     {"unshot", channels(s.energy.unshot)},
                     {"imbalance", s.energy.imbalance()}}},
                   {"left_out", left_out},
                   {"seconds_analysis", s.seconds_analysis},
                   {"seconds_learn", s.seconds_learn},
                   {"rays_learn", s.rays_learn},
                   {"rays_gather", s.rays_gather},
                   {"seconds_gather", s.seconds_gather},
                   {"seconds_picture", s.seconds_picture},
                   {"seconds_write", s.seconds_write},
                   {"seconds_total", s.seconds_total}};
    if (!s.target.empty()) {
        object["for"] = s.target;
        object["estimated_error_elsewhere"] = s.estimated_error_elsewhere;
    }
    if (s.emitted_far > 0) {
        object["emitted_far"] = s.emitted_far;
        object["reflected"] = s.reflected;
    }
    for (const LayerFigures& layer : s.layers)
        object["layers"].push_back(
            {{"name", layer.name}, {"emitted", channels(layer.emitted)}, {"error", layer.error}});
    if (!s.layers.empty()) {
        object["seconds_layers"] = s.seconds_layers;
        object["rays_layers"] = s.rays_layers;
    }
    for (const auto& [work, bytes_peak] : s.ranks)
        object["ranks"].push_back({{"rays", work.rays},
                                   {"matrix_entries", work.entries},
                                   {"bytes_sent", work.sent},
                                   {"bytes_received", work.received},
                                   {"bytes_peak", bytes_peak}});
    for (const ObjectFigures& of : s.objects)
        object["objects"].push_back({{"name", of.name},
                                     {"texels", of.texels},
                                     {"rays", of.rays},
                                     {"estimated_error", of.error},
                                     {"error_bound", of.bound}});
    for (const auto& [of, error] : s.answers)
        object["answers"].push_back({{"of", of},
                                     {"estimated_error", error.whole},
                                     {"error_bound", error.bound},
                                     {"error_local", error.local}});
    object["program"] = s.program;
    object["settings"] = settings(s.settings);
    return object;
}

} // namespace

std::string to_json(const Statistics& statistics) {
    // A name that is not UTF-8 must not cost the user the file; NaN and infinity become null.
    constexpr int indent = 2;
    return to_object(statistics).dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::uint64_t peak_memory_bytes() {
    constexpr std::uint64_t unit = 1024; // Linux reports KiB
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0)
        return 0;
    return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

} // namespace hemilux
