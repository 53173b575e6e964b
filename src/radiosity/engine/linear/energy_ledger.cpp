#include "radiosity/engine/linear/energy_ledger.h"

#include "geometry/compensated_sum.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// How much is lost must be known within this share of the power that is used.
constexpr double surely_lost = 1e-3;

using Sum = CompensatedSum<Vec3>;

/// The fate of some of the light, by rays.
struct Ledger {
    Sum sent, escaped, left_behind; ///< left_behind: fell on backs of faces

    void add(const Vec3& power, const EscapeFraction& lost) {
        sent += power;
        escaped += lost.escaped * power;
        left_behind += lost.absorbed * power;
    }
    [[nodiscard]] double lost(int c) const { return escaped.value()[c] + left_behind.value()[c]; }
};

/// Returns the variance of a share of which `count` of `rays` were counted, before which all shares
/// were alike. This is that of the Beta distribution with count + 1 and rays - count + 1.
double variance_of_share(double count, double rays) {
    const double all = rays + 2;
    return (count + 1) * (rays - count + 1) / (all * all * (all + 1));
}

/// Returns the share of rays that are lost, among all rays of patches that light leaves.
double prior_loss(const Transport& t, std::span<const Vec3> incident) {
    double lost = 0, rays = 0;
    for (std::size_t i = 0; i < t.rays.size(); ++i) {
        if (t.emission[i] + t.reflectance[i] * incident[i] == Vec3(0.0))
            continue;
        lost += t.rays[i] * t.lost[i].sum();
        rays += t.rays[i];
    }
    return rays > 0 ? lost / rays : 0;
}

/// Sums over all patches.
struct EnergySums {
    Ledger emitted, reflected;
    Sum absorbed;

    EnergySums(const Transport& t, std::span<const Vec3> incident) {
        emitted.sent += t.sent_by_points;
        emitted.escaped += t.escaped_of_points;
        emitted.left_behind += t.left_behind_of_points;
        for (std::size_t i = 0; i < incident.size(); ++i) {
            const Vec3 emission = t.area[i] * t.emission[i], here = t.area[i] * incident[i];
            if (emission != Vec3(0.0))
                emitted.add(emission, t.lost[i]);
            reflected.add(t.reflectance[i] * here, t.lost[i]);
            absorbed += (1.0 - t.reflectance[i]) * here;
        }
    }
};

/// Returns the variance of the power that is lost. Each patch counts as if one more ray had met
/// what rays meet on average.
Vec3 variance_of_losses(const Transport& t, std::span<const Vec3> incident) {
    const double prior = prior_loss(t, incident);
    Vec3 variance(0.0);
    for (std::size_t i = 0; i < incident.size() && !t.closed; ++i) {
        if (!(t.rays[i] > 0))
            continue;
        const Vec3 leaving = t.area[i] * (t.emission[i] + t.reflectance[i] * incident[i]);
        const double share = (t.rays[i] * t.lost[i].sum() + prior) / (t.rays[i] + 1);
        variance += leaving * leaving * (share * (1 - share) / t.rays[i]);
    }
    return variance;
}

/// Returns the scale of one channel so that all that was emitted and not lost is absorbed, or
/// reflected and lost.
double scale_of(const EnergySums& sums, double variance, int c) {
    const double absorbed = sums.absorbed.value()[c], emitted = sums.emitted.sent.value()[c];
    const double used = absorbed + sums.reflected.lost(c);
    if (!(used > 0))
        return 1;
    // Nothing may arrive that was not sent.
    const bool sure = std::sqrt(variance) < surely_lost * std::min(emitted, used);
    return sure || emitted < absorbed ? (emitted - sums.emitted.lost(c)) / used : 1;
}

} // namespace

Vec3 power_arriving(const Transport& t, std::span<const Vec3> direct) {
    Sum power;
    for (std::size_t i = 0; i < direct.size(); ++i)
        power += t.area[i] * direct[i];
    return power.value();
}

void scale_direct_light(const Transport& t, const Vec3& variance, std::span<Vec3> direct) {
    Ledger emitted;
    Vec3 variance_of_lost(0.0);
    for (std::size_t i = 0; i < direct.size(); ++i) {
        const Vec3 power = t.area[i] * t.emission[i];
        if (power == Vec3(0.0))
            continue;
        emitted.add(power, t.lost[i]);
        if (!t.closed)
            variance_of_lost +=
                power * power * variance_of_share(t.rays[i] * t.lost[i].sum(), t.rays[i]);
    }
    const Vec3 arriving = power_arriving(t, direct);
    Vec3 scale(1.0);
    for (int c = 0; c < 3; ++c) {
        const double both = variance[c] + variance_of_lost[c];
        if (!(arriving[c] > 0))
            continue;
        const double sent = emitted.sent.value()[c];
        const double share = both > 0 ? variance[c] / both : 0;
        const double known = sent - emitted.lost(c);
        const double power = arriving[c] + share * (known - arriving[c]);
        scale[c] = std::min(power, sent) / arriving[c];
    }
    for (Vec3& incident : direct)
        incident *= scale;
}

EnergyBalance balance_energy(const Transport& transport, std::span<const Vec3> incident) {
    const EnergySums sums(transport, incident);
    EnergyBalance energy;
    energy.emitted = sums.emitted.sent.value();
    energy.absorbed = sums.absorbed.value();
    for (int c = 0; c < 3; ++c) {
        const double escaped = sums.emitted.escaped.value()[c] + sums.reflected.escaped.value()[c];
        const double by_rays = sums.emitted.lost(c) + sums.reflected.lost(c);
        // Where light finds no end the balance stays open, see SearchForWayOut::is_drained.
        const bool ends = by_rays > 0 || energy.absorbed[c] > energy.emitted[c] / 2;
        const double lost = ends ? energy.emitted[c] - energy.absorbed[c] : 0;
        energy.escaped[c] = by_rays > 0 ? escaped / by_rays * lost : 0;
        energy.absorbed[c] += lost - energy.escaped[c];
    }
    return energy;
}

EnergyBalance close_energy(const Transport& transport, std::span<Vec3> incident) {
    const EnergySums sums(transport, incident);
    const Vec3 variance = variance_of_losses(transport, incident);
    Vec3 scale;
    for (int c = 0; c < 3; ++c)
        scale[c] = scale_of(sums, variance[c], c);
    for (Vec3& arriving : incident)
        arriving *= scale;
    return balance_energy(transport, incident);
}

/// Sets the limit. As many rays as are asked for of each patch are traced whatever it is.
SearchForWayOut::SearchForWayOut(const SolverInput& input) {
    constexpr double least = 5e7, times = 4;
    most_ = std::max(least, times * input.options.rays * double(input.mesh.patches().size()));
    for (std::uint32_t i = 0; i < input.mesh.patches().size(); ++i) {
        const Vec3& rho = input.mesh.material(i).reflectance;
        perfect_ = perfect_ || std::max({rho.x, rho.y, rho.z}) >= 1;
    }
}

void SearchForWayOut::go_on(std::uint64_t traced, bool may_have_more) {
    const bool more_than_before = !traced_ || traced > *traced_;
    traced_ = traced;
    if (!may_have_more || !more_than_before || double(traced) > most_)
        throw SolveError("after " + std::to_string(traced) +
                             " rays, independent parts of them have not seen where light leaves "
                             "the scene or is absorbed: the opening is small. A larger --rays "
                             "looks for it with more at once",
                         0);
}

} // namespace hemilux
