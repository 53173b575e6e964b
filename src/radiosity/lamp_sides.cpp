#include "radiosity/lamp_sides.h"

#include "radiosity/light_paths.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

constexpr std::uint32_t rays_a_side = 128;
constexpr double nothing = 0.01, something = 0.05; ///< of the rays
constexpr double much_nearer = 1.0 / 8, at_once = 1.0 / 3;

/// What the rays of one side strike, as shares of them.
struct View {
    double others = 0;              ///< other shells
    double dark = 0;                ///< what does not shine itself, of any shell
    std::vector<double> distances;  ///< to what is dark
    [[nodiscard]] double median() { // of the distances
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        return *middle;
    }
};

struct Views {
    View front, back;
    double size; ///< of the emitting part, a length
};

std::optional<bool> only_one(double front, double back) {
    if (front < nothing && back > something)
        return true;
    if (back < nothing && front > something)
        return false;
    return std::nullopt;
}

std::optional<bool> judge(Views& views, const Shell& shell) {
    auto& [front, back, size] = views;
    if (std::max(front.dark, back.dark) > something) {
        if (const auto side = only_one(front.dark, back.dark))
            return side;
    } else
        return only_one(front.others, back.others);
    if (front.distances.empty() || back.distances.empty())
        return std::nullopt;
    const double ahead = front.median(), behind = back.median();
    const double reach = shell.closed ? std::max(ahead, behind) : at_once * size;
    if (ahead < much_nearer * behind && ahead < reach)
        return true;
    if (behind < much_nearer * ahead && behind < reach)
        return false;
    return std::nullopt;
}

class Lamp {
  public:
    Lamp(const Mesh& mesh, const Tracer& tracer, const Shells& shells,
         const std::vector<std::uint32_t>& shell_of, std::uint32_t shell)
        : mesh_(mesh), tracer_(tracer), shells_(shells), shell_of_(shell_of), shell_(shell) {
        for (const std::uint32_t f : shells.facets_of(shells.all[shell]))
            if (power_of(mesh, f) > 0) {
                facets_.push_back(f);
                areas_.push_back(mesh.whole_side(f, false).area);
                area_ += areas_.back();
            }
    }
    [[nodiscard]] bool shines() const { return !facets_.empty(); }
    [[nodiscard]] Views look() const { return {look(false), look(true), std::sqrt(area_)}; }

  private:
    [[nodiscard]] View look(bool back) const {
        View view;
        Rng rng(hash_words({shell_, std::uint64_t{back}}));
        const std::vector<std::uint32_t> shares = shares_of(areas_, rays_a_side);
        for (std::size_t k = 0; k < facets_.size(); ++k)
            for (std::uint32_t ray = 0; ray < shares[k]; ++ray)
                add(diffuse_ray(mesh_, {facets_[k], back != shells_.against[facets_[k]]}, rng),
                    view);
        return view;
    }
    void add(const Ray& ray, View& view) const {
        const std::optional<Hit> hit = tracer_.closest(ray);
        if (!hit)
            return;
        if (shell_of_[hit->facet] != shell_)
            view.others += 1.0 / rays_a_side;
        if (power_of(mesh_, hit->facet) > 0)
            return;
        view.dark += 1.0 / rays_a_side;
        view.distances.push_back(hit->t);
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    const Shells& shells_;
    const std::vector<std::uint32_t>& shell_of_;
    std::uint32_t shell_;
    std::vector<std::uint32_t> facets_; ///< that emit
    std::vector<double> areas_;
    double area_ = 0;
};

} // namespace

std::optional<bool> shines_to_backs(const Mesh& mesh, const Tracer& tracer, const Shells& shells,
                                    const std::vector<std::uint32_t>& shell_of,
                                    std::uint32_t shell) {
    const Lamp lamp(mesh, tracer, shells, shell_of, shell);
    if (!lamp.shines())
        return std::nullopt;
    Views views = lamp.look();
    const Shell& form = shells.all[shell];
    if (form.closed && views.front.others < nothing && views.back.others < nothing)
        return signed_volume(mesh, shells, form) > 0;
    return judge(views, form);
}

} // namespace hemilux
