#include "radiosity/research/hierarchy/links.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/engine/factors/pairs/point_to_patch.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/rays/shadow_rays.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

using Node = PatchTree::Node;

/// The most links that are made, however much light they carry: with its factors in eight batches a
/// link takes some 100 bytes.
constexpr std::size_t max_links = 4'000'000;

/// The largest factor of a link. A larger one changes too much within a node, whatever the light.
/// Where surfaces nearly touch, one patch sees another alone, and the mean over its node hardly
/// sees it.
constexpr double max_factor = .1;

/// An area that exceeds another by less than this factor counts as equal.
constexpr double rounding = 1 + 1e-6;

/// Returns how far `other` may rise above the plane of `plane`.
double height_over(const Node& plane, const Node& other) {
    const double cosine = glm::dot(plane.normal, other.normal);
    return glm::dot(plane.normal, other.centre - plane.centre) +
           other.radius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

} // namespace

double rough_factor(const Node& to, const Node& from) {
    const Vec3 off = to.centre - from.centre;
    const double both = to.radius + from.radius;
    const double apart = std::sqrt(std::max(glm::dot(off, off) - both * both, 0.0));
    const auto cosine = [apart](double height) { return std::clamp(height, 0.0, apart) / apart; };
    if (!(apart > 0)) // they may touch
        return 1;
    return cosine(height_over(to, from)) * cosine(height_over(from, to)) * from.area /
           (std::numbers::pi * apart * apart + from.area);
}

Links::Links(const Mesh& mesh, const PatchTree& tree) : mesh_(mesh), tree_(tree) {
    for (const std::uint32_t to : tree.roots())
        for (const std::uint32_t from : tree.roots())
            if (const Link link{to, from}; to != from && may_see(link)) {
                if (links_.size() == max_links)
                    throw SolveError(
                        "the faces lie in " + std::to_string(tree.roots().size()) +
                            " planes, each of which is linked with all that it may see: more "
                            "than " +
                            std::to_string(max_links) +
                            " links; --method stored-transport needs none",
                        0);
                links_.push_back(link);
            }
}

bool Links::may_see(const Link& link) const {
    const Node &to = tree_[link.to], &from = tree_[link.from];
    if (!(to.area > 0 && from.area > 0))
        return false;
    if (to.is_patch() && from.is_patch())
        return hemilux::may_see(mesh_.patches()[tree_.patch(to)],
                                mesh_.patches()[tree_.patch(from)]);
    constexpr double min_height = 1e-12; // no more than patches need
    return height_over(to, from) > min_height && height_over(from, to) > min_height;
}

bool Links::are_whole() const {
    return std::ranges::all_of(links_, [this](const Link& link) {
        return tree_[link.to].is_patch() && tree_[link.from].is_patch();
    });
}

Refinement Links::refine(std::span<const double> light, std::span<const double> reflectance,
                         double max_power) {
    std::vector<double> brightness(tree_.nodes().size()), rho(tree_.nodes().size());
    tree_.pull(light, brightness);
    tree_.pull(reflectance, rho);
    std::vector<Link> fine, open;
    bool divided = false;
    for (const Link& coarse : links_) {
        open.push_back(coarse);
        while (!open.empty()) {
            const Link link = open.back();
            open.pop_back();
            const Node &to = tree_[link.to], &from = tree_[link.from];
            if (!may_see(link))
                continue;
            const double power =
                rough_factor(to, from) * brightness[link.from] * to.area * rho[link.to];
            const bool whole = to.is_patch() && from.is_patch();
            const double factor = std::max(rough_factor(to, from), rough_factor(from, to));
            const bool is_fine = power <= max_power && factor <= max_factor;
            if (whole || is_fine) {
                fine.push_back(link);
                continue;
            }
            if (fine.size() + open.size() > max_links)
                return Refinement::too_many_links;
            divided = true;
            if (from.is_patch() || (!to.is_patch() && to.area > rounding * from.area)) {
                open.push_back({to.child + 1, link.from});
                open.push_back({to.child, link.from});
            } else {
                open.push_back({link.to, from.child + 1});
                open.push_back({link.to, from.child});
            }
        }
    }
    links_ = std::move(fine);
    return divided ? Refinement::done : Refinement::not_needed;
}

namespace {

/// Looks along links, whose rays are traced many at a time.
class LinkLooks {
  public:
    LinkLooks(const Mesh& mesh, const Tracer& tracer, const PatchTree& tree)
        : mesh_(mesh), tracer_(tracer), tree_(tree) {}

    /// Adds `weight` times the factor from a pair of points to `sum`, in finish() at the latest.
    void add(const Link& link, std::array<double, 4> u, double weight, double& sum) {
        const Node& from = tree_[link.from];
        const Patch& receiver = mesh_.patches()[tree_.sample(tree_[link.to], u[0])];
        const Patch& source = mesh_.patches()[tree_.sample(from, u[2])];
        Ray ray{};
        const double factor = look_at(receiver, PolygonSampler(receiver.shape), source,
                                      PolygonSampler(source.shape), u, everywhere, ray);
        if (!(factor > 0))
            return;
        rays_.add(ray, source.facet, {weight * factor * (from.area / source.area), &sum});
        if (rays_.size() == rays_at_a_time)
            finish();
    }
    void finish() {
        traced_ += rays_.trace(tracer_, [](const Term& term, double share) {
            if (share > 0)
                *term.sum += share * term.factor;
        });
    }
    [[nodiscard]] std::uint64_t traced() const { return traced_; }

  private:
    struct Term {
        double factor;
        double* sum;
    };
    const Mesh& mesh_;
    const Tracer& tracer_;
    const PatchTree& tree_;
    ShadowRays<Term> rays_;
    std::uint64_t traced_ = 0;
};

} // namespace

LinkFactors::LinkFactors(const Mesh& mesh, const Tracer& tracer, const PatchTree& tree,
                         const Links& links, std::span<const std::uint32_t> points,
                         std::uint64_t seed, const Workers& workers, Monitor& monitor)
    : tree_(tree), links_(links), factors_(links.all().size()) {
    constexpr std::size_t links_per_chunk = 256;
    std::atomic<std::uint64_t> rays{0};
    workers.for_chunks(factors_.size(), links_per_chunk, [&](std::size_t begin, std::size_t end) {
        LinkLooks looks(mesh, tracer, tree);
        for (std::size_t l = begin; l < end && !monitor.interrupted; ++l) {
            const Link& link = links.all()[l];
            SobolBlocks<4> sobol(hash_words({seed, link.to, link.from}));
            for (std::uint32_t k = 0; k < points[l]; ++k)
                looks.add(link, sobol.at(k), 1.0 / points[l], factors_[l]);
        }
        looks.finish();
        rays += looks.traced();
        monitor.rays += looks.traced();
    });
    rays_ = rays;
}

void LinkFactors::multiply(std::span<const double> x, std::span<double> y) const {
    std::vector<double> light(tree_.nodes().size()), arriving(tree_.nodes().size());
    tree_.pull(x, light);
    const auto links = links_.all();
    for (std::size_t l = 0; l < links.size(); ++l)
        arriving[links[l].to] += factors_[l] * light[links[l].from];
    tree_.push(arriving, y);
}

} // namespace hemilux
