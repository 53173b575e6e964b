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

/// Sums over all patches.
struct Flows {
    Sum emitted, absorbed, left_behind; ///< left_behind: fell on backs of faces, by rays
    Sum escaped;                        ///< by rays
    Sum kept;                           ///< of the emission what was not lost
    Sum used;      ///< of what arrived what is absorbed there, or reflected and lost
    Sum uncertain; ///< variance of what is lost

    Flows(const Transport& t, std::span<const Vec3> incident) {
        for (std::size_t i = 0; i < incident.size(); ++i) {
            const Vec3 emission = t.area[i] * t.emission[i], here = t.area[i] * incident[i];
            const Vec3 leaving = emission + t.reflectance[i] * here;
            const double lost = t.lost[i].escaped + t.lost[i].absorbed;
            emitted += emission;
            absorbed += (1.0 - t.reflectance[i]) * here;
            left_behind += t.lost[i].absorbed * leaving;
            escaped += t.lost[i].escaped * leaving;
            kept += (1 - lost) * emission;
            used += (1.0 - t.reflectance[i] + lost * t.reflectance[i]) * here;
            if (t.rays[i] > 0)
                uncertain += leaving * leaving * (lost * (1 - lost) / t.rays[i]);
        }
    }
};

/// In one channel.
double scale_of(const Flows& flows, int c) {
    const double used = flows.used.value()[c], emitted = flows.emitted.value()[c];
    if (!(used > 0))
        return 1;
    // Nothing may arrive that was not sent.
    const double lost = emitted - flows.absorbed.value()[c];
    const bool sure = std::sqrt(flows.uncertain.value()[c]) < surely_lost * emitted;
    return sure || lost < 0 ? flows.kept.value()[c] / used : 1;
}

} // namespace

void scale_direct_light(const Transport& t, std::span<Vec3> direct) {
    Sum sent, arrived, all_sent, uncertain;
    for (std::size_t i = 0; i < direct.size(); ++i) {
        const Vec3 power = t.area[i] * t.emission[i];
        const double lost = t.lost[i].escaped + t.lost[i].absorbed;
        all_sent += power;
        sent += (1 - lost) * power;
        arrived += t.area[i] * direct[i];
        uncertain += power * power * (lost * (1 - lost) / std::max(t.rays[i], 1.0));
    }
    for (int c = 0; c < 3; ++c)
        if (arrived.value()[c] > 0 &&
            std::sqrt(uncertain.value()[c]) < surely_lost * all_sent.value()[c])
            for (Vec3& incident : direct)
                incident[c] *= sent.value()[c] / arrived.value()[c];
}

EnergyBalance close_energy(const Transport& transport, std::span<Vec3> incident) {
    const Flows found(transport, incident);
    const Vec3 scale(scale_of(found, 0), scale_of(found, 1), scale_of(found, 2));
    for (Vec3& arriving : incident)
        arriving *= scale;
    const Flows flows(transport, incident);
    EnergyBalance energy{flows.emitted.value(), flows.absorbed.value(), flows.escaped.value(),
                         Vec3(0.0)};
    const Vec3 behind = flows.left_behind.value();
    for (int c = 0; c < 3; ++c) {
        const double by_rays = energy.escaped[c] + behind[c];
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
