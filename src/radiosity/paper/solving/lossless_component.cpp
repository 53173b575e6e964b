#include "radiosity/paper/solving/lossless_component.h"

#include "geometry/frame.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

/// The rays of each patch at first; they become four times as many whenever they find nothing.
constexpr double first_rays = 8;

class Search {
  public:
    Search(const SolverInput& input, double enough_rays, int channel)
        : input_(input), enough_rays_(enough_rays), channel_(channel),
          held_(input.mesh.patches().size()) {
        for (std::uint32_t i = 0; i < held_.size(); ++i)
            held_[i] = input.mesh.material(i).reflectance[channel] >= 1;
    }

    std::optional<LosslessComponent> run() {
        double since = 0; // rays since a way out was found
        for (double rays = first_rays; is_lit() && since < enough_rays_;) {
            const std::vector<std::uint32_t> shooters = held_and_emitters();
            const double most = enough_rays_ / static_cast<double>(shooters.size()) + 1;
            const double each = std::min(rays, std::max(most, first_rays));
            if (release(shooters, static_cast<std::size_t>(each))) {
                since = 0;
                rays = first_rays;
            } else {
                since += static_cast<double>(static_cast<std::size_t>(each) * shooters.size());
                rays *= 4;
            }
            if (input_.monitor.interrupted)
                return std::nullopt;
        }
        if (!is_lit())
            return std::nullopt;
        return LosslessComponent{channel_, lit_part(), static_cast<std::uint64_t>(since)};
    }

  private:
    [[nodiscard]] double emission(std::uint32_t patch) const {
        return input_.mesh.material(patch).emission[channel_];
    }
    [[nodiscard]] bool is_lit() const {
        for (std::uint32_t i = 0; i < held_.size(); ++i)
            if (held_[i] && emission(i) > 0)
                return true;
        return false;
    }
    [[nodiscard]] std::vector<std::uint32_t> held_and_emitters() const {
        std::vector<std::uint32_t> list;
        for (std::uint32_t i = 0; i < held_.size(); ++i)
            if (held_[i] || emission(i) > 0)
                list.push_back(i);
        return list;
    }

    /// Traces rays of all these patches. Returns whether they found a way out for some patch.
    bool release(const std::vector<std::uint32_t>& shooters, std::size_t rays) {
        ++round_;
        std::vector<std::vector<std::uint32_t>> freed(shooters.size());
        for (std::size_t k = 0; k < shooters.size() && !input_.monitor.interrupted; ++k)
            freed[k] = freed_by(shooters[k], rays);
        bool any = false;
        for (const std::vector<std::uint32_t>& list : freed)
            for (const std::uint32_t patch : list)
                any |= std::exchange(held_[patch], char{0}) != 0;
        return any;
    }

    /// Returns the patches that a shooter frees: those that are seen from where light gets out are
    /// those from which it does.
    [[nodiscard]] std::vector<std::uint32_t> freed_by(std::uint32_t shooter,
                                                      std::size_t rays) const {
        std::vector<std::uint32_t> freed;
        for (const std::uint32_t hit : receivers_of(shooter, rays)) {
            const bool held = hit < held_.size() && held_[hit];
            if (held_[shooter] && !held)
                return {shooter};
            if (!held_[shooter] && held)
                freed.push_back(hit);
        }
        return freed;
    }

    /// Returns the patches that rays hit; none where they leave the scene or hit a back.
    [[nodiscard]] std::vector<std::uint32_t> receivers_of(std::uint32_t shooter,
                                                          std::size_t rays) const {
        Rng rng(hash_words({input_.options.seed, round_, shooter}));
        const auto start = PatchStart::in_any_axes(input_.mesh, shooter);
        std::vector<std::uint32_t> receivers;
        for (std::size_t k = 0; k < rays; ++k) {
            const std::optional<Hit> hit = input_.tracer.closest(start.cosine_ray(rng));
            receivers.push_back(hit ? input_.mesh.patch_at(*hit) : none);
        }
        return receivers;
    }

    /// Returns the patches that are seen from the brightest emitter, directly or through others.
    [[nodiscard]] std::vector<std::uint32_t> lit_part() {
        constexpr std::size_t rays = 256;
        std::uint32_t brightest = 0;
        for (std::uint32_t i = 0; i < held_.size(); ++i)
            if (held_[i] && (!held_[brightest] || emission(i) > emission(brightest)))
                brightest = i;
        ++round_;
        std::vector<std::uint32_t> found{brightest};
        std::vector<char> seen(held_.size());
        seen[brightest] = true;
        for (std::size_t k = 0; k < found.size() && !input_.monitor.interrupted; ++k)
            for (const std::uint32_t hit : receivers_of(found[k], rays))
                if (hit < seen.size() && held_[hit] && !std::exchange(seen[hit], char{1}))
                    found.push_back(hit);
        std::sort(found.begin(), found.end());
        return found;
    }

    const SolverInput& input_;
    double enough_rays_;
    int channel_;
    std::vector<char> held_; ///< no way out is known
    std::uint64_t round_ = 0;
};

/// Returns whether the search would be the same in both channels.
bool alike(const Mesh& mesh, int a, int b) {
    const std::vector<Material>& materials = mesh.scene().materials;
    return std::all_of(materials.begin(), materials.end(), [&](const Material& m) {
        return (m.reflectance[a] >= 1) == (m.reflectance[b] >= 1) &&
               (m.emission[a] > 0) == (m.emission[b] > 0);
    });
}

} // namespace

std::optional<LosslessComponent> find_lossless_component(const SolverInput& input,
                                                         double enough_rays) {
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && alike(input.mesh, c, c - 1))
            continue;
        if (auto component = Search(input, enough_rays, c).run())
            return component;
    }
    return std::nullopt;
}

} // namespace hemilux
