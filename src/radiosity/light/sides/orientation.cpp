#include "radiosity/light/sides/orientation.h"

#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/light/sides/emitter_sides.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <tuple>

namespace hemilux {
namespace {

/// A file is disordered if so large a part of its lit area is lit from behind. It also is if so
/// large a part of the edges that two facets share clash.
constexpr double much_area = 0.4, many_edges = 0.05;
/// The share of a surface's light that its backs get, for a surface that is lit from behind, and
/// for one in a file that is disordered.
constexpr double nearly_all = 0.9, the_greater_part = 0.5;
/// The least number of rays that must reach a shell: fewer show nothing.
constexpr double few_rays = 4;
/// The least part of a scene's light that matters: a surface that gets less is not worth a risk or
/// a warning.
constexpr double large_part = 1.0 / 20;
/// The least part of the emitted power whose emitters must face a wall: where it is less, the
/// others show that these may be meant to.
constexpr double many_emitters = 0.25;
/// The largest part of a shell's area that may disagree: if it is more, it is not clear which faces
/// of an open shell are wrong.
constexpr double many_faces = 0.1;

double sum_of(const SideLight& light) { return light[0] + light[1]; }
bool falls_on_backs(const SideLight& light, double share) {
    return sum_of(light) >= few_rays && light[1] > share * sum_of(light);
}

class OrientationSearch {
  public:
    OrientationSearch(const Mesh& mesh, const Tracer& tracer)
        : scene_(mesh.scene()), mesh_(mesh), tracer_(tracer), shells_(find_shells(scene_)),
          targets_(mesh) {}

    Orientation find() {
        find_emitters();
        find_light();
        result_.clashing_edges = shells_.clashing_edges;
        looks_away_.assign(scene_.faces, false);
        in_doubt_ = stays_ = looks_away_;
        for (std::uint32_t s = 0; s < shells_.all.size(); ++s)
            check(s);
        for (const Facet& facet : scene_.facets)
            if (facet.two_sided)
                looks_away_[facet.face] = in_doubt_[facet.face] = false;
        std::tie(result_.faces, result_.groups) = count(looks_away_);
        std::tie(result_.in_doubt, result_.groups_in_doubt) = count(in_doubt_);
        if (result_.faces > 0) {
            result_.looks_away = std::move(looks_away_);
            result_.light = find_light_shares(mesh_, tracer_);
        }
        return std::move(result_);
    }

  private:
    void find_emitters() {
        emitter_side_.resize(shells_.all.size());
        std::vector<double> power(shells_.all.size(), 0.0);
        double all = 0;
        for (std::uint32_t f = 0; f < scene_.facets.size(); ++f) {
            const double own = power_of(mesh_, f);
            power[shells_.of[f]] += own;
            all += own;
        }
        double wrong = 0;
        for (std::uint32_t s = 0; s < shells_.all.size(); ++s) {
            emits_.push_back(power[s] > 0);
            if (shells_.all[s].orientable && emits_[s])
                emitter_side_[s] = find_emitter_side(mesh_, tracer_, targets_, shells_, s);
            if (emitter_side_[s] && emitter_side_[s]->certain && emitter_side_[s]->back)
                wrong += power[s];
        }
        if (wrong < many_emitters * all)
            for (std::optional<EmitterSide>& side : emitter_side_)
                if (side)
                    side->certain = false;
    }

    /// Finds light by facet and adds it up by face: the facets of a face are turned together.
    void find_light() {
        std::vector<bool> shines_back(scene_.facets.size(), false);
        for (std::uint32_t f = 0; f < shines_back.size(); ++f)
            if (const Shell& shell = shells_.all[shells_.of[f]]; shell.orientable)
                shines_back[f] = shells_.against[f] != shines_to_backs(shells_.of[f]);
        light_ = light_on_sides(mesh_, tracer_, targets_, shines_back);
        light_of_face_.assign(scene_.faces, SideLight{});
        double lit = 0, from_behind = 0;
        for (std::uint32_t f = 0; f < light_.size(); ++f) {
            add(light_[f], false, light_of_face_[scene_.facets[f].face]);
            all_light_ += sum_of(light_[f]);
            if (emits_[shells_.of[f]] || sum_of(light_[f]) == 0 || scene_.facets[f].two_sided ||
                is_far(f))
                continue;
            const double area = mesh_.shape_of(f).area();
            lit += area;
            from_behind += area * light_[f][1] / sum_of(light_[f]);
        }
        const auto edges = static_cast<double>(shells_.shared_edges);
        const auto clashing = static_cast<double>(shells_.clashing_edges);
        reversed_ = lit > 0 && from_behind > much_area * lit;
        disordered_ = reversed_ || (clashing > 0 && clashing > many_edges * edges);
    }

    /// Returns whether a facet belongs to a sun or a sky.
    [[nodiscard]] bool is_far(std::uint32_t facet) const {
        return scene_.materials[scene_.facets[facet].material].is_far;
    }

    static void add(const SideLight& light, bool reversed, SideLight& sum) {
        sum[0] += light[reversed];
        sum[1] += light[!reversed];
    }
    /// Returns the light on the sides of a shell once it is consistent.
    [[nodiscard]] SideLight light_of(const Shell& shell) const {
        SideLight light{};
        for (const std::uint32_t f : shells_.facets_of(shell))
            add(light_[f], shells_.against[f], light);
        return light;
    }
    [[nodiscard]] bool shines_to_backs(std::uint32_t s) const {
        return emitter_side_[s] && emitter_side_[s]->back;
    }

    /// Checks a shell. A sun and a sky look at the scene, whatever the scene's own faces do.
    void check(std::uint32_t s) {
        const Shell& shell = shells_.all[s];
        if (is_far(shells_.facets_of(shell)[0]))
            return;
        if (!shell.orientable)
            ++result_.one_sided;
        else if (!shell.consistent)
            turn_some(s);
        else if (emits_[s]) {
            if (shines_to_backs(s))
                turn_all(s, emitter_side_[s]->certain || disordered_, result_.emitters);
        } else
            check_consistent(s);
    }

    void check_consistent(std::uint32_t s) {
        const Shell& shell = shells_.all[s];
        const SideLight light = light_of(shell);
        if (sum_of(light) < few_rays) {
            // What is dark and closed is taken for a thing, not for a room.
            if (shell.outwards != 0 ? disordered_ && shell.outwards < 0 : reversed_)
                turn_all(s, true, shell.closed ? result_.inside_out : result_.from_behind);
        } else if (falls_on_backs(light, disordered_ ? the_greater_part : nearly_all)) {
            if (shell.closed || disordered_)
                turn_all(s, true, shell.closed ? result_.inside_out : result_.from_behind);
            else if (sum_of(light) > large_part * all_light_)
                turn_all(s, false, result_.from_behind);
        }
    }

    void turn_all(std::uint32_t s, bool certain, std::size_t& kind) {
        for (const std::uint32_t f : shells_.facets_of(shells_.all[s]))
            (certain ? looks_away_ : in_doubt_)[scene_.facets[f].face] = true;
        kind += certain;
    }

    /// Returns whether the majority of a shell looks away.
    [[nodiscard]] bool majority_away(std::uint32_t s) const {
        if (emitter_side_[s])
            return emitter_side_[s]->back;
        const SideLight light = light_of(shells_.all[s]);
        return sum_of(light) < few_rays ? shells_.all[s].outwards < 0 : light[1] > light[0];
    }

    /// Turns some faces of a shell. The faces of a shell that encloses something cannot be meant to
    /// disagree; elsewhere light must confirm what is turned. A face whose own facets disagree, as
    /// one that is folded, stays.
    void turn_some(std::uint32_t s) {
        const Shell& shell = shells_.all[s];
        const bool away = majority_away(s);
        const bool encloses = shell.outwards != 0;
        const bool matters = emits_[s] || sum_of(light_of(shell)) > large_part * all_light_;
        const bool clear =
            encloses || disordered_ || (matters && !away && shell.against < many_faces);
        if (!clear && !matters)
            return;
        for (const std::uint32_t f : shells_.facets_of(shell))
            if (shells_.against[f] == away)
                stays_[scene_.facets[f].face] = true;
        bool any = false;
        for (const std::uint32_t f : shells_.facets_of(shell)) {
            const SideLight& light = light_of_face_[scene_.facets[f].face];
            const bool known = encloses || emitter_side_[s] ||
                               (disordered_ && sum_of(light) < few_rays) ||
                               falls_on_backs(light, disordered_ ? the_greater_part : nearly_all);
            if (stays_[scene_.facets[f].face] || !known)
                continue;
            (clear ? looks_away_ : in_doubt_)[scene_.facets[f].face] = true;
            any = clear;
        }
        result_.mixed += any;
    }

    /// Returns the number of marked faces and the groups they are in.
    [[nodiscard]] std::pair<std::size_t, std::vector<std::uint32_t>>
    count(const std::vector<bool>& marked) const {
        std::vector<bool> listed(scene_.groups.size(), false);
        for (const Facet& facet : scene_.facets)
            if (marked[facet.face])
                listed[facet.group] = true;
        std::vector<std::uint32_t> groups;
        for (std::uint32_t g = 0; g < listed.size(); ++g)
            if (listed[g])
                groups.push_back(g);
        return {static_cast<std::size_t>(std::ranges::count(marked, true)), groups};
    }

    const Scene& scene_;
    const Mesh& mesh_;
    const Tracer& tracer_;
    Shells shells_;
    Targets targets_;
    std::vector<std::optional<EmitterSide>> emitter_side_; ///< sides by shell
    std::vector<bool> emits_;                              ///< marks by shell
    std::vector<SideLight> light_;                         ///< light by facet
    std::vector<SideLight> light_of_face_;
    double all_light_ = 0;
    bool reversed_ = false, disordered_ = false; ///< the file: the second follows from the first
    std::vector<bool> looks_away_, in_doubt_, stays_; ///< marks by face
    Orientation result_;
};

} // namespace

Orientation find_orientation(const Mesh& mesh, const Tracer& tracer) {
    const auto emits = [&](const Facet& facet) {
        const Material& material = mesh.scene().materials[facet.material];
        const Vec3& e = material.emission;
        return !material.is_far && e.r + e.g + e.b > 0;
    };
    if (std::ranges::any_of(mesh.scene().facets, emits) || !point_emitters_of(mesh.scene()).empty())
        return OrientationSearch(mesh, tracer).find();
    Orientation unknown;
    unknown.clashing_edges = find_shells(mesh.scene()).clashing_edges;
    return unknown;
}

Orientation find_orientation(const Scene& scene) {
    if (scene.facets.empty())
        return {};
    const Mesh mesh = layered_mesh(scene);
    const MadeTracer made = make_tracer(mesh);
    Orientation found = find_orientation(mesh, *made.tracer);
    if (found.faces == 0)
        found.light = find_light_shares(mesh, *made.tracer);
    return found;
}

void turn_faces(Scene& scene, const Orientation& orientation) {
    if (orientation.looks_away.empty())
        return;
    const auto turn = [](auto& corners, bool is_triangle) {
        auto& v = corners;
        v = is_triangle ? std::array{v[0], v[2], v[1], v[1]} : std::array{v[0], v[3], v[2], v[1]};
    };
    SceneTextures* const textures = scene.varying ? &own_textures_of(scene) : nullptr;
    for (std::size_t f = 0; f < scene.facets.size(); ++f) {
        Facet& facet = scene.facets[f];
        if (!orientation.looks_away[facet.face])
            continue;
        const bool is_triangle = facet.is_triangle();
        turn(facet.vertex, is_triangle);
        if (!textures)
            continue;
        for (std::vector<Texcoords>& of_facets : textures->texcoords)
            turn(of_facets[f], is_triangle);
        if (!textures->tints.empty())
            turn(textures->tints[f], is_triangle);
    }
}

} // namespace hemilux
