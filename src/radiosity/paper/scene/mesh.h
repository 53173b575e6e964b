#pragma once
// Describes the scene as the solvers see it: facets divided into patches, moved into a local frame.
//
// Rays are traced against whole facets, which share the vertices of the file. The patch that a ray
// hits is found from the coordinates inside the facet. So dividing a face costs the BVH nothing,
// and two neighbours divided differently have no crack between them.

#include "bvh/intersect.h"
#include "geometry/box.h"
#include "geometry/frame.h"
#include "geometry/polygon.h"
#include "radiosity/paper/scene/facet_division.h"
#include "radiosity/paper/scene/scene.h"

#include <memory>
#include <span>
#include <vector>

namespace hemilux {

struct MeshOptions {
    /// Facets are divided until no edge is longer [m]; 0 keeps each facet as one patch. This
    /// division leaves out those of a sun and a sky. Half the length gives about four times as many
    /// patches.
    double max_edge = 0;
    /// Every facet gets a patch on its back too.
    bool two_sided = false;
    /// A division into more patches than this is refused before they are made.
    std::size_t max_patches = 50'000'000;
    /// The number of threads that find the colours of textured patches; 0 means one per core.
    unsigned threads = 0;
};

/// A piece of a facet with constant radiosity, in the local frame. Lengths and areas are in local
/// units.
struct Patch {
    Polygon shape; ///< counter-clockwise from the side that this patch is
    Vec3 centre;   ///< centre of mass
    Vec3 normal;   ///< unit, to the side that emits and reflects
    double area;   ///< local units
    std::uint32_t facet;
    std::uint32_t material;
    bool back;             ///< the reverse of a two-sided facet
    std::uint32_t colours; ///< Mesh::material
};

/// Returns the largest distance of a corner from the patch's centre, in the local frame.
[[nodiscard]] double radius_of(const Patch& patch);

/// The frame of computation: world = centre + local / scale. The scale is a power of two, so that
/// nothing is lost by it, and the scene lies within [-1,1]^3.
struct LocalFrame {
    Vec3 centre{0.0};   ///< [m]
    double scale = 1.0; ///< [1/m]
    [[nodiscard]] Vec3 to_local(const Vec3& world) const { return (world - centre) * scale; }
    [[nodiscard]] Vec3 to_world(const Vec3& local) const { return centre + local / scale; }
    /// Converts an area in local units to [m2].
    [[nodiscard]] double area_to_world(double area) const { return area / (scale * scale); }

    /// Returns the frame around the vertices that the scene's facets use.
    [[nodiscard]] static LocalFrame of(const Scene& scene);
    [[nodiscard]] std::vector<Vec3> to_local(std::span<const Vec3> world) const;
};

/// The facets of a scene as rays meet them, in the local frame.
struct LocalFacets {
    /// Throws std::invalid_argument when the scene has no facet.
    explicit LocalFacets(const Scene& scene);

    LocalFrame frame;
    std::vector<Vec3> vertices;                 ///< those of the scene, and others behind them
    std::vector<FacetCorners> corners;          ///< indices into `vertices`, by facet
    std::vector<FacetCorners> corners_to_trace; ///< the same for a tracer; empty: as `corners`
    bool all_layers_are_offset = true;

    /// Returns a facet, counter-clockwise from its front.
    [[nodiscard]] Polygon shape_of(std::uint32_t facet) const {
        return polygon_of(vertices, corners[facet]);
    }
};

/// The division of pieces of facets into smaller patches, by whoever refines a mesh.
class FinerPatches {
  public:
    virtual ~FinerPatches() = default;
    /// Returns whether pieces of the facet are divided.
    [[nodiscard]] virtual bool divides(std::uint32_t facet) const = 0;
    /// Returns the front patch at a place of a facet whose pieces are divided.
    [[nodiscard]] virtual std::uint32_t patch_at(std::uint32_t facet, const FacetDivision& pieces,
                                                 const FacetDivision::Place& place) const = 0;
};

class Mesh {
  public:
    /// Throws std::invalid_argument when the scene has no facet or too many patches would be made.
    explicit Mesh(Scene scene, const MeshOptions& options = {});
    /// Does the same with facets that are not quite where the scene has them (layered_mesh.h).
    Mesh(Scene scene, const MeshOptions& options, LocalFacets facets);

    /// Takes smaller patches in place of those there are (engine/cells/refine.h). They are in the
    /// order of facets, of which each begins with the patch `first_patch[facet]`. Facets, and
    /// tracers of them, remain valid.
    void take_finer(std::vector<Patch> patches, std::span<const std::uint32_t> first_patch,
                    std::shared_ptr<const FinerPatches> finer);
    /// Returns the division into these smaller patches; null where there are none.
    [[nodiscard]] const FinerPatches* finer() const { return finer_.get(); }

    /// Gives the patches other colours.
    void vary_colours(std::shared_ptr<VaryingColours> colours);

    /// Gives the scene other materials, colours and lights: those of `scene`, whose facets and
    /// vertices are the same but for their materials.
    void recolour(Scene scene);

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const LocalFrame& frame() const { return facets_.frame; }
    [[nodiscard]] std::span<const Patch> patches() const { return patches_; }
    /// Returns the colours of a patch: those of its material, or the means of textures over it. The
    /// latter have no name.
    [[nodiscard]] const Material& material(const Patch& patch) const {
        return colours_[patch.colours];
    }
    /// Returns whether the emission of a patch differs from that of others on its facet.
    [[nodiscard]] bool emits_by_texture(const Patch& patch) const {
        return scene_.varying && scene_.varying->emission_on(patch.material);
    }
    /// Returns whether a facet has patches on its back.
    [[nodiscard]] bool has_back(std::uint32_t facet) const {
        return two_sided_ || scene_.facets[facet].two_sided;
    }
    [[nodiscard]] const Material& material(std::uint32_t patch) const {
        return material(patches_[patch]);
    }
    /// Returns vertices of the scene in the local frame, indexed by Facet::vertex. Those of facets
    /// offset from others in their plane follow (layered_mesh.h).
    [[nodiscard]] std::span<const Vec3> vertices() const { return facets_.vertices; }
    /// Returns the frame in which the subdivided hemisphere of a patch stands. It is turned about
    /// the normal by an angle hashed from the patch's index. So its vertices do not run along the
    /// edges of a regular mesh (docs/paper/decisions.md, D12).
    [[nodiscard]] Frame hemisphere_frame(std::uint32_t patch) const;
    /// Returns the cosine and sine of that angle. Finding them takes about as long as drawing a
    /// ray; whoever asks for the frames of all patches many times may keep them.
    [[nodiscard]] static Vec2 hemisphere_turn(std::uint32_t patch);
    [[nodiscard]] Frame hemisphere_frame(std::uint32_t patch, Vec2 turn) const {
        return Frame::from_normal(patches_[patch].normal).turned(turn);
    }
    /// Returns a facet in the local frame, counter-clockwise from its front.
    [[nodiscard]] Polygon shape_of(std::uint32_t facet) const { return facets_.shape_of(facet); }
    /// Returns the facets in the local frame, for a tracer to copy or to refer to.
    [[nodiscard]] FacetSoup soup() const;
    /// Returns the facets for a tracer; no ray can meet those that are buried under many others.
    [[nodiscard]] FacetSoup soup_to_trace() const;
    /// Returns false where so many facets lie over each other that not all could be offset.
    [[nodiscard]] bool all_layers_are_offset() const { return facets_.all_layers_are_offset; }
    /// Returns one side of a facet as a single patch, as if the facet were not divided.
    [[nodiscard]] Patch whole_side(std::uint32_t facet, bool back) const;
    /// Returns a part of a facet, or the back of it, as a patch.
    [[nodiscard]] Patch patch_from(const Polygon& shape, std::uint32_t facet, bool back) const;
    /// Returns the pieces of a facet, those of MeshOptions::max_edge.
    [[nodiscard]] const FacetDivision& pieces(std::uint32_t facet) const {
        return divisions_[facet].pieces;
    }
    /// Returns the first patch of a facet; those of a facet follow each other.
    [[nodiscard]] std::uint32_t first_patch(std::uint32_t facet) const {
        return divisions_[facet].first_patch;
    }
    /// Returns whether a facet has more than one patch on each side.
    [[nodiscard]] bool is_divided(std::uint32_t facet) const { return only_patch_[facet] == none; }
    /// Returns the patch on one side of a facet that is not divided; none on the back of a
    /// one-sided facet.
    [[nodiscard]] std::uint32_t patch_of(std::uint32_t facet, bool front) const {
        if (!front && !has_back(facet))
            return none;
        return only_patch_[facet] + (front ? 0 : 1);
    }
    /// Returns the patch that a ray hit; none where it hit the back of a one-sided facet.
    [[nodiscard]] std::uint32_t patch_at(const Hit& hit) const;

  private:
    struct Division {
        FacetDivision pieces;
        std::uint32_t first_patch;
    };

    void divide(const MeshOptions& options);
    void find_colours();

    Scene scene_;
    LocalFacets facets_;
    std::vector<Patch> patches_;
    std::vector<Material> colours_; ///< the materials, then those of patches on which colours vary
    std::vector<Division> divisions_;
    std::shared_ptr<const FinerPatches> finer_; ///< null where pieces are whole patches
    std::vector<std::uint32_t>
        only_patch_; ///< patch of a facet, none if divided: all that most hits need
    bool two_sided_ = false;
    unsigned threads_ = 0;
};

} // namespace hemilux
