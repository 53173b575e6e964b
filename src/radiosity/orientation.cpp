#include "radiosity/orientation.h"

#include "radiosity/lamp_sides.h"
#include "radiosity/light_paths.h"
#include "radiosity/lit_sides.h"
#include "radiosity/make_tracer.h"
#include "radiosity/needs.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Shares of light that fall on backs. Of a shell:
constexpr double hardly_any = 0.02;
constexpr double enough_closed = 0.9, enough_open = 0.98;
/// Of the scene: from here on small open shells are turned too; from here on the file is taken to
/// be inside out, if this holds without the shell in question, and more light on the backs than on
/// the fronts is enough.
constexpr double much = 0.3, most = 0.5;
/// What makes a shell a small one: its part of the light of the scene, or of
/// what is emitted.
constexpr double small_part = 1.0 / 400;
/// A few: that part of a shell's area.
constexpr double few_faces = 0.05;

struct ShellLight {
    double front = 0, back = 0;
    void add(const SideLight& light, bool reversed) {
        front += light[reversed];
        back += light[!reversed];
    }
    [[nodiscard]] double all() const { return front + back; }
};

class Judge {
  public:
    Judge(const Scene& scene, unsigned threads)
        : scene_(scene), shells_(find_shells(scene)), mesh_(scene),
          made_(make_tracer(mesh_, needs_tree(mesh_), threads)), shell_of_(scene.facets.size()) {
        for (std::uint32_t s = 0; s < shells_.all.size(); ++s)
            for (const std::uint32_t f : shells_.facets_of(shells_.all[s]))
                shell_of_[f] = s;
    }

    Orientation find() {
        find_lamps();
        sum_light();
        result_.looks_away.assign(scene_.faces, false);
        result_.clashing_edges = shells_.clashing_edges;
        result_.light = find_light_shares(mesh_, *made_.tracer);
        for (std::uint32_t s = 0; s < shells_.all.size(); ++s)
            judge(s);
        count_faces();
        return std::move(result_);
    }

  private:
    void find_lamps() {
        lamp_.resize(shells_.all.size());
        std::vector<double> power(shells_.all.size(), 0.0);
        double all = 0, wrong = 0;
        for (std::uint32_t s = 0; s < shells_.all.size(); ++s) {
            for (const std::uint32_t f : shells_.facets_of(shells_.all[s]))
                power[s] += power_of(mesh_, f);
            if (shells_.all[s].orientable && power[s] > 0)
                lamp_[s] = shines_to_backs(mesh_, *made_.tracer, shells_, shell_of_, s);
            all += power[s];
            wrong += lamp_[s].value_or(false) ? power[s] : 0;
        }
        for (std::uint32_t s = 0; s < shells_.all.size(); ++s)
            if (wrong < much * all && power[s] < small_part * all)
                lamp_[s].reset();
        for (const double p : power)
            emits_.push_back(p > 0);
    }

    /// Light is found by facet and judged by face: the facets of a face are turned together.
    void sum_light() {
        std::vector<bool> shines_back(scene_.facets.size(), false);
        for (std::uint32_t f = 0; f < shines_back.size(); ++f)
            if (shells_.all[shell_of_[f]].orientable)
                shines_back[f] = shells_.against[f] != lamp_[shell_of_[f]].value_or(false);
        light_ = light_on_sides(mesh_, *made_.tracer, shells_, shines_back);
        for (const SideLight& light : light_)
            all_light_.add(light, false);
        light_of_face_.assign(scene_.faces, SideLight{});
        for (std::uint32_t f = 0; f < light_.size(); ++f)
            for (const std::size_t side : {0u, 1u})
                light_of_face_[scene_.facets[f].face][side] += light_[f][side];
    }

    [[nodiscard]] ShellLight light_of(const Shell& shell, bool agreed) const {
        ShellLight light;
        for (const std::uint32_t f : shells_.facets_of(shell))
            light.add(light_[f], agreed && shells_.against[f]);
        return light;
    }

    void judge(std::uint32_t s) {
        const Shell& shell = shells_.all[s];
        const ShellLight light = light_of(shell, false);
        if (!shell.orientable)
            ++result_.one_sided;
        else if (shell.consistent)
            judge_consistent(s, light);
        else if (lamp_[s] || encloses(shell) || matters(light))
            turn_some(s);
    }

    /// Whether an open shell is worth the risk to turn what is meant to be as it is.
    [[nodiscard]] bool matters(const ShellLight& light) const {
        return light.back > hardly_any * light.all() &&
               (all_light_.back >= much * all_light_.all() ||
                light.back >= small_part * all_light_.all());
    }

    void judge_consistent(std::uint32_t s, const ShellLight& light) {
        const Shell& shell = shells_.all[s];
        const double others = all_light_.all() - light.all();
        const bool inside_out_file = others > 0 && all_light_.back - light.back >= most * others;
        const double enough = inside_out_file ? 0.5 : (shell.closed ? enough_closed : enough_open);
        const bool dark_front = light.all() > 0 && light.back >= enough * light.all() &&
                                (shell.closed || matters(light));
        const bool is_lamp = emits_[s];
        if (!lamp_[s].value_or(dark_front && !is_lamp))
            return;
        for (const std::uint32_t f : shells_.facets_of(shell))
            turn(f);
        ++(is_lamp ? result_.lamps : shell.closed ? result_.inside_out : result_.from_behind);
    }

    /// A closed shell that is no folded sheet: its facets cannot be meant to disagree.
    [[nodiscard]] bool encloses(const Shell& shell) const {
        constexpr double flat = 1e-6;
        double area = 0;
        for (const std::uint32_t f : shells_.facets_of(shell))
            area += mesh_.whole_side(f, false).area;
        return shell.closed &&
               std::abs(signed_volume(mesh_, shells_, shell)) > flat * std::pow(area, 1.5);
    }

    /// Whether the majority of an inconsistent shell looks away. Without light, a closed one is
    /// taken for a thing, not for a room.
    [[nodiscard]] bool majority_away(std::uint32_t s) const {
        const Shell& shell = shells_.all[s];
        const ShellLight light = light_of(shell, true);
        if (lamp_[s])
            return *lamp_[s];
        return light.all() > 0 ? light.back > light.front
                               : signed_volume(mesh_, shells_, shell) < 0;
    }

    /// Whether so much of a shell disagrees that light need not confirm each face. A few faces may
    /// only seem to, as where a tile is folded over its own edge.
    [[nodiscard]] bool disagrees_widely(const Shell& shell) const {
        double area = 0, against = 0;
        for (const std::uint32_t f : shells_.facets_of(shell)) {
            const double own = mesh_.whole_side(f, false).area;
            area += own;
            against += shells_.against[f] ? own : 0;
        }
        return against > few_faces * area;
    }

    void turn_some(std::uint32_t s) {
        const Shell& shell = shells_.all[s];
        const bool away = majority_away(s), widely = disagrees_widely(shell);
        const bool certain = widely && encloses(shell);
        bool any = false;
        for (const std::uint32_t f : shells_.facets_of(shell)) {
            const auto& [front, back] = light_of_face_[scene_.facets[f].face];
            const bool may_turn = certain || back > front || (widely && back == front);
            if (shells_.against[f] == away || !may_turn)
                continue;
            turn(f);
            any = true;
        }
        result_.mixed += any;
    }

    void turn(std::uint32_t f) { result_.looks_away[scene_.facets[f].face] = true; }

    void count_faces() {
        result_.faces = static_cast<std::size_t>(std::ranges::count(result_.looks_away, true));
        std::vector<bool> listed(scene_.groups.size(), false);
        for (const Facet& facet : scene_.facets)
            if (result_.looks_away[facet.face])
                listed[facet.group] = true;
        for (std::uint32_t g = 0; g < listed.size(); ++g)
            if (listed[g])
                result_.groups.push_back(g);
        if (result_.faces == 0)
            result_.looks_away.clear();
    }

    const Scene& scene_;
    Shells shells_;
    Mesh mesh_;
    MadeTracer made_;
    std::vector<std::uint32_t> shell_of_;   ///< by facet
    std::vector<std::optional<bool>> lamp_; ///< by shell
    std::vector<bool> emits_;               ///< by shell
    std::vector<SideLight> light_;          ///< by facet
    std::vector<SideLight> light_of_face_;
    ShellLight all_light_; ///< as the file has it
    Orientation result_;
};

bool anything_emits(const Scene& scene) {
    return std::ranges::any_of(scene.facets, [&](const Facet& facet) {
        const Vec3& e = scene.materials[facet.material].emission;
        return e.r + e.g + e.b > 0;
    });
}

} // namespace

Orientation find_orientation(const Scene& scene, unsigned threads) {
    if (anything_emits(scene))
        return Judge(scene, threads).find();
    Orientation unknown;
    unknown.clashing_edges = find_shells(scene).clashing_edges;
    return unknown;
}

void turn_faces(Scene& scene, const Orientation& orientation) {
    if (orientation.looks_away.empty())
        return;
    for (Facet& facet : scene.facets)
        if (orientation.looks_away[facet.face]) {
            auto& v = facet.vertex;
            v = facet.is_triangle() ? decltype(facet.vertex){v[0], v[2], v[1], v[1]}
                                    : decltype(facet.vertex){v[0], v[3], v[2], v[1]};
        }
}

} // namespace hemilux
