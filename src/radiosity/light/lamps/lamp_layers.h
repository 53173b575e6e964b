#pragma once
// The lamps of a scene apart from each other. Light is linear: what each lamp brings by itself is a
// layer of the light, and the sum of all layers is the whole.

#include "geometry/vector.h"
#include "radiosity/engine/solving/relighting.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace hemilux {

class Mesh;

/// This says which emitters make up a layer: faces of one group and material that touch each other,
/// or all of a group, or all of a material. A light without extent is a layer of its own, as are a
/// sun and a sky.
enum class LayersBy { lamp, group, material };

/// A layer, and what its emitters send.
struct LampLayer {
    std::string name; ///< that of the group, else of the material; no two are the same
    Vec3 power{0.0};  ///< [W]
};

/// The layers of a scene, in the order of their first faces; then those of lights without extent.
struct LampLayers {
    std::vector<LampLayer> layers;
    std::vector<std::uint32_t> of_facet; ///< `none` where nothing is emitted
    std::vector<std::uint32_t> of_point; ///< by light without extent
};

[[nodiscard]] LampLayers find_lamp_layers(const Mesh& mesh, LayersBy by);

/// Returns the mesh with the light of one layer alone. All else, patches and facets included, is as
/// it was, so a tracer of the mesh serves both.
[[nodiscard]] Mesh lit_by_layer(const Mesh& mesh, const LampLayers& layers, std::uint32_t layer);

/// Returns what a patch emits in a layer [W/m2].
[[nodiscard]] Vec3 emission_in(const Mesh& mesh, const LampLayers& lamps, std::size_t layer,
                               std::uint32_t patch);

/// Makes the parts of layers add up to a whole, each channel by itself. Where all parts are 0 the
/// layers share the whole by their power.
class LampShares {
  public:
    explicit LampShares(const LampLayers& lamps);
    /// part(layer) is a reference to one of the layers' colours.
    template <class Colour, class Part>
    void add_up(const Colour& whole, const Part& part) const {
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t k = 0; k < of_power_.size(); ++k)
                sum += double(part(k)[c]);
            for (std::size_t k = 0; k < of_power_.size(); ++k) {
                auto& own = part(k)[c];
                const double share = sum > 0 ? double(own) / sum : of_power_[k][c];
                own = static_cast<std::remove_reference_t<decltype(own)>>(share * double(whole[c]));
            }
        }
    }

  private:
    std::vector<Vec3> of_power_; ///< by layer: its share of the power of all, by channel
};

/// The light of patches by each lamp.
struct LampPatches {
    LampLayers lamps;
    std::vector<Relit> patches; ///< by layer; empty where they are not known
};

/// Scales the reflected light of each layer so that their sum is `whole`, by patch and channel.
/// Where no layer has found any of it, they share it by their power. Errors are scaled alike, and
/// within patches each changes as the whole does.
void share_whole(const Mesh& mesh, const Solution& whole, LampPatches& light);

} // namespace hemilux
