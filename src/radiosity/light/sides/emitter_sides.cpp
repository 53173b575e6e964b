#include "radiosity/light/sides/emitter_sides.h"

#include "radiosity/light/sides/light_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

constexpr std::uint32_t rays_a_side = 128;
constexpr double nothing = 0.01, something = 0.05; ///< shares of the rays
constexpr double hardly_any = 0.1;                 ///< share of what the other side sees
constexpr double much_nearer = 1.0 / 8;
constexpr double near = 1.0 / 3, contact = 1.0 / 10; ///< shares of an emitter's size

/// The surfaces that the rays of one side hit.
struct View {
    double others = 0;             ///< other shells, as a share of the rays
    double dark = 0;               ///< what does not shine itself, of any shell
    std::vector<double> distances; ///< distances to what is dark
    /// Returns the median of the distances; infinite if there is none.
    [[nodiscard]] double median() {
        if (distances.empty())
            return std::numeric_limits<double>::infinity();
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::ranges::nth_element(distances, middle);
        return *middle;
    }
};

class EmittingShell {
  public:
    EmittingShell(const Mesh& mesh, const Tracer& tracer, const Targets& targets,
                  const Shells& shells, std::uint32_t shell)
        : mesh_(mesh), tracer_(tracer), targets_(targets), shells_(shells), shell_(shell) {
        for (const std::uint32_t f : shells.facets_of(shells.all[shell]))
            if (power_of(mesh, f) > 0) {
                facets_.push_back(f);
                areas_.push_back(mesh.shape_of(f).area());
                area_ += areas_.back();
            }
    }

    [[nodiscard]] std::optional<EmitterSide> side() const {
        const Shell& shell = shells_.all[shell_];
        View front = look(false, false), back = look(true, false);
        if (shell.closed && std::max(front.others, back.others) < nothing && lies_alone())
            return EmitterSide{shell.outwards > 0, true};
        const double ahead = front.median(), behind = back.median();
        // A side must be nearer than a share of this reach to be a wall at once.
        const double reach =
            shell.closed ? std::numeric_limits<double>::infinity() : std::sqrt(area_);
        if (const auto only = only_one(front, back))
            return EmitterSide{*only, (*only ? behind : ahead) > contact * reach || shell.closed};
        const double nearer = std::min(ahead, behind);
        if (!(nearer < much_nearer * std::max(ahead, behind)) || !(nearer < near * reach))
            return std::nullopt;
        return EmitterSide{ahead < behind, shell.closed || nearer < contact * reach};
    }

  private:
    /// Returns whether rays that are sent to other surfaces miss them, so that these are not only
    /// small from here.
    [[nodiscard]] bool lies_alone() const {
        return std::max(look(false, true).others, look(true, true).others) < nothing;
    }
    /// Returns whether it is the back that alone lies before something; empty if neither side alone
    /// does.
    [[nodiscard]] std::optional<bool> only_one(const View& front, const View& back) const {
        if (const double dark = std::max(front.dark, back.dark); dark > something)
            return only_one(front.dark, back.dark);
        if (const auto far = only_one(look(false, true).dark, look(true, true).dark))
            return far;
        return only_one(front.others, back.others);
    }
    static std::optional<bool> only_one(double front, double back) {
        if (std::max(front, back) <= something ||
            std::min(front, back) >= hardly_any * std::max(front, back))
            return std::nullopt;
        return back > front;
    }

    [[nodiscard]] View look(bool back, bool aimed) const {
        View view;
        Rng rng(hash_words({shell_, std::uint64_t{back}}));
        const std::vector<std::uint32_t> shares = shares_of(areas_, rays_a_side);
        for (std::size_t k = 0; k < facets_.size(); ++k)
            for (std::uint32_t i = 0; i < shares[k]; ++i) {
                const FacetSide side{facets_[k], back != shells_.against[facets_[k]]};
                const std::optional<Ray> ray =
                    aimed ? targets_.ray_from(side, rng) : diffuse_ray(mesh_, side, rng);
                if (const auto hit = ray ? tracer_.closest(*ray) : std::nullopt)
                    add(*hit, view);
            }
        return view;
    }
    void add(const Hit& hit, View& view) const {
        view.others += shells_.of[hit.facet] != shell_ ? 1.0 / rays_a_side : 0;
        if (power_of(mesh_, hit.facet) > 0)
            return;
        view.dark += 1.0 / rays_a_side;
        view.distances.push_back(hit.t);
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    const Targets& targets_;
    const Shells& shells_;
    std::uint32_t shell_;
    std::vector<std::uint32_t> facets_; ///< facets that emit
    std::vector<double> areas_;
    double area_ = 0;
};

} // namespace

std::optional<EmitterSide> find_emitter_side(const Mesh& mesh, const Tracer& tracer,
                                             const Targets& targets, const Shells& shells,
                                             std::uint32_t shell) {
    return EmittingShell(mesh, tracer, targets, shells, shell).side();
}

} // namespace hemilux
