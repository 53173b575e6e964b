#include "radiosity/research/guiding/hemisphere_importance.h"

#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>

namespace hemilux {
namespace {

/// Light that is too much or too little is not spread evenly, which makes its square larger. With
/// 1, a room of reflectance .99 loses some hundredths outside of its details.
constexpr double weight_of_energy = 2;

/// The number of hits that the importance of the parent counts for.
constexpr double hits_of_parent = 4;

} // namespace

HemisphereImportance::HemisphereImportance(const Hemisphere& hemisphere, std::size_t patches)
    : hemisphere_(hemisphere), first_leaf_(Hemisphere::cells_up_to(hemisphere.depth() - 1)),
      leaves_(hemisphere.cells().size() - first_leaf_), known_(patches * leaves_),
      pending_(known_.size()) {
    for (const Hemisphere::Cell& cell : hemisphere.cells())
        shares_.push_back(cell.projected_solid_angle / std::numbers::pi);
}

void HemisphereImportance::commit(double factor) {
    for (std::size_t k = 0; k < known_.size(); ++k)
        known_[k] += {pending_[k].sum * static_cast<float>(factor), pending_[k].hits};
    drop_pending();
}

void HemisphereImportance::drop_pending() { std::ranges::fill(pending_, Known{}); }

double HemisphereImportance::sum_of(std::uint32_t patch) const {
    double sum = 0;
    for (std::size_t t = 0; t < leaves_; ++t)
        sum += static_cast<double>(known_[patch * leaves_ + t].sum);
    return sum;
}

/// Sums from the leaves to the roots.
void HemisphereImportance::collect(std::uint32_t patch, std::vector<Known>& tree) const {
    const auto& cells = hemisphere_.cells();
    tree.assign(cells.size(), {});
    for (std::size_t t = 0; t < leaves_; ++t)
        tree[first_leaf_ + t] = known_[patch * leaves_ + t];
    for (std::size_t c = first_leaf_; c-- > 0;)
        for (std::size_t child = cells[c].first_child; child < cells[c].first_child + 4u; ++child)
            tree[c] += tree[child];
}

void HemisphereImportance::estimate(std::uint32_t patch, double scale, double prior_mean,
                                    std::span<double> importance) const {
    thread_local std::vector<Known> tree; // by cell
    thread_local std::vector<double> mean;
    collect(patch, tree);
    mean.resize(tree.size());
    const auto estimate_of = [&](const Known& known, double share, double parent) {
        const double own = static_cast<double>(known.sum) * scale / share, hits = known.hits;
        return parent + (own - parent) * hits / (hits + hits_of_parent);
    };
    Known whole;
    for (std::size_t root = 0; root < 4; ++root)
        whole += tree[root];
    const double of_patch = estimate_of(whole, 1, prior_mean);
    for (std::size_t root = 0; root < 4; ++root)
        mean[root] = estimate_of(tree[root], shares_[root], of_patch);
    for (std::size_t c = 0; c < first_leaf_; ++c) {
        const std::size_t first = hemisphere_.cells()[c].first_child;
        for (std::size_t child = first; child < first + 4; ++child)
            mean[child] = estimate_of(tree[child], shares_[child], mean[c]);
    }
    std::copy(mean.begin() + static_cast<std::ptrdiff_t>(first_leaf_), mean.end(),
              importance.begin());
}

void HemisphereImportance::save(StateWriter& state) const {
    state.add(std::uint64_t{known_.size()});
    for (const Known& known : known_)
        state.add(std::uint64_t{std::bit_cast<std::uint32_t>(known.sum)} << 32 |
                  std::bit_cast<std::uint32_t>(known.hits));
}

void HemisphereImportance::load(StateReader& state) {
    if (state.whole() != known_.size())
        throw StateError("the number of triangles is not that of the patches");
    for (Known& known : known_) {
        const std::uint64_t word = state.whole();
        known.sum = std::bit_cast<float>(static_cast<std::uint32_t>(word >> 32));
        known.hits = std::bit_cast<float>(static_cast<std::uint32_t>(word));
        constexpr float most = std::numeric_limits<float>::max();
        if (!(known.sum >= 0 && known.sum <= most && known.hits >= 0 && known.hits <= most))
            throw StateError("a sum over hits is not finite, or negative");
    }
}

double importance_of_energy(const Mesh& mesh, std::span<const Vec3> radiosity) {
    double shot = 0, reflected = 0, emitted = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const double area = mesh.patches()[i].area;
        const Material& material = mesh.material(i);
        shot += area * mean_of_channels(radiosity[i]);
        reflected += area * mean_of_channels(radiosity[i] * material.reflectance);
        emitted += area * mean_of_channels(material.emission);
    }
    if (!(emitted > 0) || !(shot > 0))
        return 0;
    const double onward = reflected / shot * (shot / emitted);
    return weight_of_energy * onward * onward / static_cast<double>(radiosity.size());
}

} // namespace hemilux
