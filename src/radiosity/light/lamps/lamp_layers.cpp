#include "radiosity/light/lamps/lamp_layers.h"

#include "geometry/numeric.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/sparse/disjoint_sets.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <map>
#include <set>
#include <utility>

namespace hemilux {
namespace {

/// Returns by facet what it emits [W], of both sides.
std::vector<Vec3> emitted_power(const Mesh& mesh) {
    std::vector<Vec3> power(mesh.scene().facets.size(), Vec3(0.0));
    for (const Patch& patch : mesh.patches())
        power[patch.facet] +=
            mesh.frame().area_to_world(patch.area) * mesh.material(patch).emission;
    return power;
}

/// Joins the emitting facets of one group and material that have a corner in common.
DisjointSets touching(const Mesh& mesh, const std::vector<Vec3>& power) {
    using Corner = std::array<double, 3>;
    std::map<std::pair<std::pair<std::uint32_t, std::uint32_t>, Corner>, std::uint32_t> first;
    const Scene& scene = mesh.scene();
    DisjointSets joined(scene.facets.size());
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        if (power[f] == Vec3(0.0))
            continue;
        const Facet& facet = scene.facets[f];
        for (const std::uint32_t vertex : facet.vertex) {
            const Vec3& at = scene.vertices[vertex];
            const auto [there, is_new] =
                first.try_emplace({{facet.group, facet.material}, {at.x, at.y, at.z}}, f);
            if (!is_new)
                joined.join(there->second, f);
        }
    }
    return joined;
}

std::string base_name(const Scene& scene, const Facet& facet, LayersBy by) {
    const std::string& material = scene.materials[facet.material].name;
    const bool has_group = facet.group < scene.groups.size() && !scene.groups[facet.group].empty();
    return by == LayersBy::material || !has_group ? material : scene.groups[facet.group];
}

/// Gives out names that differ.
class Names {
  public:
    std::string take(std::string base) {
        if (base.empty())
            base = "lamp";
        std::string name = base;
        for (unsigned number = 2; !taken_.insert(name).second; ++number)
            name = base + " " + std::to_string(number);
        return name;
    }

  private:
    std::set<std::string> taken_;
};

} // namespace

LampLayers find_lamp_layers(const Mesh& mesh, LayersBy by) {
    const Scene& scene = mesh.scene();
    const std::vector<Vec3> power = emitted_power(mesh);
    DisjointSets joined = touching(mesh, power);
    LampLayers found;
    found.of_facet.assign(scene.facets.size(), none);
    std::map<std::uint32_t, std::uint32_t> layer_of; // by what makes up a layer
    Names names;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        if (power[f] == Vec3(0.0))
            continue;
        const Facet& facet = scene.facets[f];
        const std::uint32_t key = by == LayersBy::lamp    ? joined.find(f)
                                  : by == LayersBy::group ? facet.group
                                                          : facet.material;
        const auto [there, is_new] =
            layer_of.try_emplace(key, static_cast<std::uint32_t>(found.layers.size()));
        if (is_new)
            found.layers.push_back({names.take(base_name(scene, facet, by))});
        found.of_facet[f] = there->second;
        found.layers[there->second].power += power[f];
    }
    for (const PointEmitter& emitter : point_emitters_of(scene)) {
        found.of_point.push_back(static_cast<std::uint32_t>(found.layers.size()));
        found.layers.push_back(
            {names.take(emitter.name), power_per_intensity(emitter) * emitter.intensity});
    }
    return found;
}

Mesh lit_by_layer(const Mesh& mesh, const LampLayers& layers, std::uint32_t layer) {
    Scene scene = mesh.scene();
    std::map<std::uint32_t, std::uint32_t> dark; // the material that is black where one emits
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        if (layers.of_facet[f] == none || layers.of_facet[f] == layer)
            continue;
        std::uint32_t& material = scene.facets[f].material;
        const auto [there, is_new] =
            dark.try_emplace(material, static_cast<std::uint32_t>(scene.materials.size()));
        if (is_new) {
            Material copy = scene.materials[material];
            copy.emission = Vec3(0.0);
            scene.materials.push_back(std::move(copy));
        }
        material = there->second;
    }
    if (scene.varying) {
        std::vector<MaterialTextures>& textures = own_textures_of(scene).of_material;
        if (!textures.empty())
            textures.resize(scene.materials.size());
        for (const auto& [material, copy] : dark)
            if (!textures.empty())
                textures[copy].reflectance = textures[material].reflectance;
    }
    if (scene.point_emitters) {
        auto of_layer = std::make_shared<std::vector<PointEmitter>>();
        for (std::size_t k = 0; k < layers.of_point.size(); ++k)
            if (layers.of_point[k] == layer)
                of_layer->push_back((*scene.point_emitters)[k]);
        scene.point_emitters = std::move(of_layer);
    }
    Mesh lit = mesh;
    lit.recolour(std::move(scene));
    return lit;
}

Vec3 emission_in(const Mesh& mesh, const LampLayers& lamps, std::size_t layer,
                 std::uint32_t patch) {
    return layer == lamps.of_facet[mesh.patches()[patch].facet] ? mesh.material(patch).emission
                                                                : Vec3(0.0);
}

LampShares::LampShares(const LampLayers& lamps) {
    Vec3 all(0.0);
    for (const LampLayer& layer : lamps.layers)
        all += layer.power;
    for (const LampLayer& layer : lamps.layers)
        of_power_.push_back(ratio_or_zero(layer.power, all));
}

void share_whole(const Mesh& mesh, const Solution& whole, LampPatches& light) {
    const LampShares shares(light.lamps);
    for (Relit& part : light.patches)
        part.slope.resize(whole.slope.size());
    std::vector<Vec3> parts(light.patches.size());
    for (std::uint32_t i = 0; i < whole.radiosity.size(); ++i) {
        const Vec3 reflected = whole.radiosity[i] - mesh.material(i).emission;
        Vec3 found(0.0);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            parts[k] = light.patches[k].radiosity[i] - emission_in(mesh, light.lamps, k, i);
            found += parts[k];
        }
        shares.add_up(reflected, [&](std::size_t k) -> Vec3& { return parts[k]; });
        for (std::size_t k = 0; k < parts.size(); ++k) {
            Relit& part = light.patches[k];
            part.radiosity[i] = emission_in(mesh, light.lamps, k, i) + parts[k];
            part.standard_error[i] *= ratio_or_zero(reflected, found);
            if (!whole.slope.empty()) {
                const Vec3 share = ratio_or_zero(parts[k], reflected);
                part.slope[i] = {share * whole.slope[i].x, share * whole.slope[i].y};
            }
        }
    }
}

} // namespace hemilux
