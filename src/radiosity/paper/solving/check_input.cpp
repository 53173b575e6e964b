#include "radiosity/paper/solving/check_input.h"

#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/lossless_component.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

namespace hemilux {
namespace {

bool is_negative(const Vec3& e) { return e.x < 0 || e.y < 0 || e.z < 0; }

void check_material(const Mesh& mesh, std::uint32_t patch) {
    const Material& material = mesh.material(patch);
    if (!is_reflectance(material.reflectance))
        throw SolveError(name_of_patch(mesh, patch) +
                             " has a reflectance that is not from 0 to 1 in each channel",
                         face_of(mesh, patch));
    if (is_negative(material.emission))
        throw SolveError(name_of_patch(mesh, patch) + " has a negative emission",
                         face_of(mesh, patch));
    check_finite(mesh, patch, material.emission, "the emission", 0);
    const double area = mesh.patches()[patch].area;
    check_finite(mesh, patch, mesh.frame().area_to_world(area) * material.emission,
                 "the emitted power", 0);
}

/// Throws SolveError where the brightest emitter of a channel is too faint.
void check_faint_channels(const Mesh& mesh) {
    for (int c = 0; c < 3; ++c) {
        const auto emission = [&](std::uint32_t i) { return mesh.material(i).emission[c]; };
        std::uint32_t brightest = 0;
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
            if (emission(i) > emission(brightest))
                brightest = i;
        if (emission(brightest) > 0 && emission(brightest) < min_radiosity)
            throw SolveError("the emission of " + name_of_patch(mesh, brightest) +
                                 ", the largest of its channel, is too small to go on with; scale "
                                 "emissions up or make it 0",
                             face_of(mesh, brightest));
    }
}

/// Lists up to three names, and how many more there are.
std::string list(const std::set<std::string>& names) {
    constexpr std::size_t most = 3;
    std::string text;
    std::size_t count = 0;
    for (const std::string& name : names)
        if (count++ < most)
            text += (count > 1 ? ", '" : "'") + name + "'";
    return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more"
                               : text;
}

std::string describe(const Mesh& mesh, const LosslessComponent& component) {
    constexpr std::array<const char*, 3> channels{"red", "green", "blue"};
    std::set<std::string> groups, materials;
    for (const std::uint32_t patch : component.patches) {
        const Facet& facet = mesh.scene().facets[mesh.patches()[patch].facet];
        if (facet.group < mesh.scene().groups.size())
            groups.insert(mesh.scene().groups[facet.group]);
        materials.insert(mesh.scene().materials[facet.material].name);
    }
    return "there is no finite solution: " + std::to_string(component.patches.size()) +
           " patches that reflect all light (" +
           channels.at(static_cast<std::size_t>(component.channel)) + ") enclose an emitter; of " +
           std::to_string(component.rays) +
           " rays from them none got out. Groups: " + list(groups) +
           "; materials: " + list(materials) + "; for example " +
           name_of_patch(mesh, component.patches.front()) +
           ". A reflectance below 1 on one of them lets light end";
}

/// Returns the number of rays that show a closed scene, where the geometry does not prove it. If so
/// many find no way out, there is none, or light would be reflected about as often before it
/// leaves.
double enough_rays(const SolverInput& input) {
    constexpr double of_closed = 3e5, of_others = 2e6;
    const double asked = input.options.rays * double(input.mesh.patches().size());
    return input.needs.closed ? of_closed : std::max(of_others, asked);
}

std::string advice(const Needs& needs) {
    return needs.closed ? ""
                        : "; if the scene has a smaller opening, a larger --rays looks for it with "
                          "more";
}

void check_input(const SolverInput& input) {
    const Mesh& mesh = input.mesh;
    bool perfect = false;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        check_material(mesh, i);
        const Vec3& rho = mesh.material(i).reflectance;
        perfect = perfect || std::max({rho.x, rho.y, rho.z}) >= 1;
    }
    check_faint_channels(mesh);
    if (!perfect)
        return;
    input.monitor.phase = "closed?";
    if (const auto component = find_lossless_component(input, enough_rays(input)))
        throw SolveError(describe(mesh, *component) + advice(input.needs),
                         face_of(mesh, component->patches.front()));
}

} // namespace

bool is_reflectance(const Vec3& r) {
    return r.x >= 0 && r.x <= 1 && r.y >= 0 && r.y <= 1 && r.z >= 0 && r.z <= 1;
}

Solution solution_before_steps(const SolverInput& input) {
    check_input(input);
    Solution solution;
    const std::size_t patches = input.mesh.patches().size();
    const double unknown = input.needs.bounces ? std::numeric_limits<double>::quiet_NaN() : 0;
    for (const Patch& patch : input.mesh.patches())
        solution.radiosity.push_back(input.mesh.material(patch).emission);
    solution.standard_error.assign(patches, Vec3(unknown));
    solution.hits.assign(patches, 0);
    solution.weight.assign(input.target.begin(), input.target.end());
    solution.may_find_light = input.needs.bounces;
    solution.energy.emitted = input.mesh.frame().area_to_world(1.0) * emitted_power(input.mesh);
    solution.energy.unshot = solution.energy.emitted;
    return solution;
}

} // namespace hemilux
