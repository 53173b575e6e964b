#include "app/terminal/summary.h"

#include "radiosity/answers/asked/text.h"

#include <cmath>
#include <initializer_list>
#include <utility>

namespace hemilux {

namespace {

double sum(const Vec3& v) { return v.r + v.g + v.b; }

std::string energy_text(const Statistics& s) {
    const EnergyBalance& energy = s.energy;
    // Nearly all that suns and skies emit meets nothing of the scene: shares of it say nothing.
    if (s.emitted_far > 0)
        return formatted("energy: surfaces reflect %g W under suns and skies", s.reflected) +
               formatted("; balance closed to %.0e", energy.imbalance());
    const double emitted = sum(energy.emitted);
    const double absorbed = sum(energy.absorbed) / emitted;
    const double escaped = sum(energy.escaped) / emitted;
    const double unshot = sum(energy.unshot) / emitted;
    return formatted("energy: %g W emitted, ", emitted) + percent(absorbed) + " absorbed, " +
           percent(escaped) + " escaped, " + formatted("%.3f %% unshot", 100 * unshot) +
           formatted("; balance closed to %.0e", energy.imbalance());
}

/// Returns how well the estimated error is known.
std::string uncertainty_text(const Statistics& s) {
    return std::isfinite(s.estimated_error_uncertainty)
               ? ", give or take " + percent(s.estimated_error_uncertainty)
               : "";
}

/// Returns how far off the light is from place to place.
std::string local_text(double error) {
    constexpr double hardly_known = 1;
    return error > hardly_known
               ? "; more than 5 of 100 places are so dark that their own light is hardly known"
               : ", and within " + percent(error) + " of the light there in 95 of 100 places";
}

/// Returns the estimated error, of what, and what the other part of it is.
std::string errors_text(const Statistics& s) {
    if (!std::isfinite(s.estimated_error) && std::isfinite(s.error_sampling) &&
        s.error_sampling > 0) // else nothing is lit
        return "estimated error unknown: the run ended before that of the division was measured; "
               "sampling " +
               percent(s.error_sampling);
    std::string error = "estimated error " + percent(s.estimated_error) + uncertainty_text(s);
    if (!s.target.empty()) {
        error += ", of the light on ";
        for (std::size_t i = 0; i < s.target.size(); ++i)
            error +=
                (i > 0 ? " and " : "") + (s.target[i] == "camera" ? "the picture" : s.target[i]);
        if (std::isfinite(s.error_division))
            error += ": sampling " + percent(s.error_sampling) + ", division " +
                     percent(s.error_division) + ", give or take " +
                     percent(s.error_division_uncertainty);
        return error + "; elsewhere it is rough: " + percent(s.estimated_error_elsewhere);
    }
    if (s.estimated_error_of == ErrorOf::gathered && !std::isfinite(s.estimated_error))
        return error;
    if (s.estimated_error_of == ErrorOf::gathered)
        return error + ", surely at most " + percent(s.error_bound) + ", of gathered light" +
               local_text(s.error_local) + "; it reads patches of sampling error " +
               percent(s.error_sampling);
    if (!std::isfinite(s.error_division))
        return error + ", of the patches' mean light; --whole-error finds what they leave out";
    const std::string division =
        percent(s.error_division) + ", give or take " + percent(s.error_division_uncertainty);
    if (s.estimated_error_of == ErrorOf::surfaces)
        return error + ", of the light on the surfaces: sampling " + percent(s.error_sampling) +
               ", division " + division;
    return error + ", of the patches' mean light\nwithin patches the light differs by " + division +
           (s.error_division > s.error_sampling ? "; --divide auto makes that less" : "");
}

} // namespace

std::string mesh_text(const Mesh& mesh) {
    const Scene& scene = mesh.scene();
    return counted(scene.faces, "face", "faces") + ", " +
           counted(mesh.patches().size(), "patch", "patches") + ", " +
           counted(scene.materials.size(), "material", "materials") + ", " +
           counted(scene.groups.size(), "group", "groups");
}

std::string tracer_text(const BvhQuality& tree, double seconds) {
    return "BVH: " + counted(tree.nodes, "node", "nodes") +
           formatted(", depth %d, SAH cost %.1f, ", tree.depth, tree.sah_cost) +
           byte_size(tree.bytes) + ", built in " + duration(seconds);
}

std::string step_text(const StepRow& row) {
    std::string text = formatted("step %u: ", row.record.step) +
                       short_counted(row.record.rays, "ray", "rays") + ", " +
                       duration(row.record.seconds) + ", estimated error " +
                       percent(row.record.estimated_error);
    if (row.error)
        text += ", true error " + percent(row.error->all);
    return text;
}

std::string run_text(const Statistics& s) {
    std::string text = s.method + ": " + counted(s.patches, "patch", "patches") + ", " +
                       counted(s.steps, "step", "steps") + ", " +
                       short_counted(s.rays_energy, "energy ray", "energy rays");
    if (s.rays_density > 0)
        text += " and " + short_counted(s.rays_density, "density ray", "density rays");
    text += " in " + duration(s.seconds_density + s.seconds_solve) + " (" +
            short_count(s.rays_per_second) + " rays/s)";
    if (s.steps > 0)
        text += "\n" + errors_text(s) + "\n" + energy_text(s);
    return text;
}

std::string time_text(const Statistics& s) {
    const std::initializer_list<std::pair<const char*, double>> parts = {
        {"reading", s.seconds_read},
        {"the tree", s.seconds_bvh},
        {"dividing patches", s.seconds_divide},
        {"densities", s.seconds_density},
        {"solving", s.seconds_solve},
        {"finding the error", s.seconds_division_error},
        {"analysis", s.seconds_analysis},
        {"learning and judging light", s.seconds_learn},
        {"gathering", s.seconds_gather},
        {"layers", s.seconds_layers},
        {"pictures", s.seconds_picture},
        {"other files", s.seconds_write}};
    constexpr double least_share = .05;
    std::string text;
    double rest = s.seconds_total;
    for (const auto& [name, seconds] : parts)
        if (seconds >= least_share * s.seconds_total) {
            text += (text.empty() ? ": " : ", ") + std::string(name) + " " + duration(seconds);
            rest -= seconds;
        }
    if (!text.empty() && rest > 0)
        text += ", all else " + duration(rest);
    return "whole time " + duration(s.seconds_total) + text;
}

std::string memory_text(const Statistics& s) {
    std::string text = "memory: " + byte_size(s.bytes_peak) + " at the most";
    if (s.bytes_density > 0)
        text += ", of which densities " + byte_size(s.bytes_density) + " (" +
                formatted("%.1f",
                          static_cast<double>(s.bytes_density) / static_cast<double>(s.patches)) +
                " per patch; a byte per triangle of the full tree would be " +
                byte_size(s.bytes_density_paper) + ")";
    return text;
}

std::string error_text(const RelativeError& error) {
    std::string text = "true error " + percent(error.all);
    if (std::isfinite(error.detail))
        text += " (detail " + percent(error.detail) + ", rest " + percent(error.rest) + ")";
    return text;
}

std::string z_scores_text(const ZScores& z) {
    if (z.count == 0)
        return "z-scores: no patch has enough hits and a standard error";
    return formatted("z-scores: mean %.3f, rms %.3f, largest %.2f over ", z.mean, z.rms,
                     z.largest) +
           counted(z.count, "value", "values");
}

} // namespace hemilux
