#include "radiosity/energy_closing.h"

#include "geometry/compensated_sum.h"
#include "radiosity/solve_error.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The share of the emitted power within which it must be known how much is lost.
constexpr double surely_lost = 1e-3;

using Sum = CompensatedSum<Vec3>;

/// What becomes of some of the light, by rays.
struct Fate {
    Sum sent, escaped, left_behind; ///< left_behind: fell on backs of faces

    void add(const Vec3& power, const LostShare& lost) {
        sent += power;
        escaped += lost.escaped * power;
        left_behind += lost.absorbed * power;
    }
    [[nodiscard]] double lost(int c) const { return escaped.value()[c] + left_behind.value()[c]; }
};

double lost_in_all(const LostShare& lost) { return lost.escaped + lost.absorbed; }

/// Variance of what is lost of the light that leaves a patch.
Vec3 uncertainty(const Vec3& leaving, const LostShare& share, double rays) {
    const double lost = lost_in_all(share);
    return leaving * leaving * (lost * (1 - lost) / rays);
}

/// Sums over all patches.
struct Flows {
    Fate emitted, reflected;
    Sum absorbed;
    Vec3 uncertain = Vec3(0.0); ///< variance of what is lost

    Flows(const Transport& t, std::span<const Vec3> incident) {
        for (std::size_t i = 0; i < incident.size(); ++i) {
            const Vec3 emission = t.area[i] * t.emission[i], here = t.area[i] * incident[i];
            const Vec3 reflection = t.reflectance[i] * here;
            if (emission != Vec3(0.0))
                emitted.add(emission, t.lost[i]);
            reflected.add(reflection, t.lost[i]);
            absorbed += (1.0 - t.reflectance[i]) * here;
            if (t.rays[i] > 0)
                uncertain += uncertainty(emission + reflection, t.lost[i], t.rays[i]);
        }
    }
};

/// In one channel, that all which was emitted and not lost is absorbed, or reflected and lost.
double scale_of(const Flows& flows, int c) {
    const double absorbed = flows.absorbed.value()[c], emitted = flows.emitted.sent.value()[c];
    const double used = absorbed + flows.reflected.lost(c);
    if (!(used > 0))
        return 1;
    // Nothing may arrive that was not sent.
    const bool sure = std::sqrt(flows.uncertain[c]) < surely_lost * emitted;
    return sure || emitted < absorbed ? (emitted - flows.emitted.lost(c)) / used : 1;
}

} // namespace

void scale_direct_light(const Transport& t, std::span<Vec3> direct) {
    Fate emitted;
    Sum arrived;
    Vec3 uncertain(0.0);
    for (std::size_t i = 0; i < direct.size(); ++i) {
        arrived += t.area[i] * direct[i];
        const Vec3 power = t.area[i] * t.emission[i];
        if (power == Vec3(0.0))
            continue;
        emitted.add(power, t.lost[i]);
        uncertain += uncertainty(power, t.lost[i], std::max(t.rays[i], 1.0));
    }
    for (int c = 0; c < 3; ++c) {
        const double sent = emitted.sent.value()[c], there = arrived.value()[c];
        if (there > 0 && std::sqrt(uncertain[c]) < surely_lost * sent)
            for (Vec3& incident : direct)
                incident[c] *= (sent - emitted.lost(c)) / there;
    }
}

EnergyBalance close_energy(const Transport& transport, std::span<Vec3> incident) {
    const Flows flows(transport, incident);
    const Vec3 scale(scale_of(flows, 0), scale_of(flows, 1), scale_of(flows, 2));
    for (Vec3& arriving : incident)
        arriving *= scale;
    EnergyBalance energy;
    energy.emitted = flows.emitted.sent.value();
    energy.absorbed = scale * flows.absorbed.value();
    energy.escaped = flows.emitted.escaped.value() + scale * flows.reflected.escaped.value();
    for (int c = 0; c < 3; ++c) {
        const double by_rays = flows.emitted.lost(c) + scale[c] * flows.reflected.lost(c);
        // What is emitted is absorbed in the end or lost on the way.
        const double lost =
            scale[c] == 1 && by_rays > 0 ? energy.emitted[c] - energy.absorbed[c] : by_rays;
        const double share = by_rays > 0 ? energy.escaped[c] / by_rays : 0;
        energy.escaped[c] = share * lost;
        energy.absorbed[c] += (1 - share) * lost;
    }
    return energy;
}

void require_more_rays(bool may_have_more) {
    if (!may_have_more)
        throw SolveError("there is no solution: as far as all rays tell, light cannot leave the "
                         "scene and nothing absorbs it",
                         0);
}

} // namespace hemilux
