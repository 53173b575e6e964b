#include "radiosity/light/sides/shells.h"

#include "geometry/polygon.h"
#include "radiosity/engine/needs/welded_edges.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Returns whether two facets run along their common edge in the same direction, and face the same
/// way. Then one lies on the other, as a face does that is there twice.
bool are_layers(const Scene& scene, const Edge& a, const Edge& b) {
    constexpr double parallel = 0.999; // cosine
    if (a.forward != b.forward)
        return false;
    const Vec3 n = polygon_of(scene.vertices, scene.facets[a.facet].vertex).area_vector();
    const Vec3 m = polygon_of(scene.vertices, scene.facets[b.facet].vertex).area_vector();
    return glm::dot(n, m) > parallel * glm::length(n) * glm::length(m);
}

struct Neighbour {
    std::uint32_t facet;
    bool agrees;
};

/// Lists up to four neighbours of each facet, and whether it has an edge where there is not exactly
/// one.
class Neighbours {
  public:
    Neighbours(const Scene& scene, Shells& shells)
        : list_(4 * scene.facets.size()), count_(scene.facets.size(), 0),
          border_(scene.facets.size(), false) {
        for_each_place(welded_edges(scene), [&](auto first, auto last) {
            if (last - first == 2 && first[0].facet != first[1].facet &&
                !are_layers(scene, first[0], first[1])) {
                const bool agrees = first[0].forward != first[1].forward;
                add(first[0].facet, {first[1].facet, agrees});
                add(first[1].facet, {first[0].facet, agrees});
                ++shells.shared_edges;
                shells.clashing_edges += !agrees;
            } else
                for (auto edge = first; edge != last; ++edge)
                    border_[edge->facet] = true;
        });
    }
    [[nodiscard]] std::span<const Neighbour> of(std::uint32_t facet) const {
        return std::span(list_).subspan(4 * std::size_t{facet}, count_[facet]);
    }
    [[nodiscard]] bool at_border(std::uint32_t facet) const { return border_[facet]; }

  private:
    void add(std::uint32_t facet, Neighbour neighbour) {
        list_[4 * std::size_t{facet} + count_[facet]++] = neighbour;
    }
    std::vector<Neighbour> list_;
    std::vector<std::uint8_t> count_;
    std::vector<bool> border_;
};

/// Fills a shell from a facet: each facet found is turned if it does not agree with the one before.
Shell fill_from(std::uint32_t start, const Neighbours& neighbours, std::vector<bool>& found,
                Shells& shells) {
    Shell shell{.begin = shells.facets.size(), .end = 0};
    found[start] = true;
    shells.facets.push_back(start);
    for (std::size_t k = shell.begin; k < shells.facets.size(); ++k) {
        const std::uint32_t f = shells.facets[k];
        shell.closed = shell.closed && !neighbours.at_border(f);
        for (const auto& [next, agrees] : neighbours.of(f)) {
            const bool against = shells.against[f] == agrees;
            shell.consistent = shell.consistent && agrees;
            if (found[next]) {
                shell.orientable = shell.orientable && shells.against[next] == against;
                continue;
            }
            found[next] = true;
            shells.against[next] = against;
            shells.facets.push_back(next);
        }
    }
    shell.end = shells.facets.size();
    return shell;
}

/// Measures a shell. The side of the larger area stays; of two equal ones that of the first facet.
void measure(const Scene& scene, Shell& shell, Shells& shells) {
    constexpr double flat = 1e-6;
    const Vec3 origin =
        polygon_of(scene.vertices, scene.facets[shells.facets[shell.begin]].vertex).centre();
    double turned = 0, kept = 0, volume = 0;
    for (const std::uint32_t f : shells.facets_of(shell)) {
        const Polygon shape = polygon_of(scene.vertices, scene.facets[f].vertex);
        const Vec3 area = shape.area_vector();
        const double cone = glm::dot(shape.centre() - origin, area) / 3;
        (shells.against[f] ? turned : kept) += glm::length(area);
        volume += shells.against[f] ? -cone : cone;
    }
    if (turned > kept) {
        for (const std::uint32_t f : shells.facets_of(shell))
            shells.against[f] = !shells.against[f];
        std::swap(turned, kept);
        volume = -volume;
    }
    shell.against = turned / (turned + kept);
    const double whole = turned + kept;
    if (shell.closed && std::abs(volume) > flat * whole * std::sqrt(whole))
        shell.outwards = volume > 0 ? 1 : -1;
}

} // namespace

Shells find_shells(const Scene& scene) {
    Shells shells;
    shells.against.assign(scene.facets.size(), false);
    shells.of.resize(scene.facets.size());
    shells.facets.reserve(scene.facets.size());
    const Neighbours neighbours(scene, shells);
    std::vector<bool> found(scene.facets.size(), false);
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        if (!found[f]) {
            Shell shell = fill_from(f, neighbours, found, shells);
            measure(scene, shell, shells);
            for (const std::uint32_t g : shells.facets_of(shell))
                shells.of[g] = static_cast<std::uint32_t>(shells.all.size());
            shells.all.push_back(shell);
        }
    return shells;
}

} // namespace hemilux
