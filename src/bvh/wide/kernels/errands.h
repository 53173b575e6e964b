// What is left to be done for single rays when they have left their packet: subtrees, which a wave
// visits afterwards. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

/// The ray of one lane, as the kernels for single rays take it.
inline FloatRay lane_of(const Packet& packet, unsigned lane) {
    FloatRay ray;
    for (unsigned i = 0; i < 3; ++i) {
        ray.origin[i] = packet.origin[i];
        ray.direction[i] = packet.direction[i][lane];
        ray.inverse[i] = packet.inverse[i][lane];
    }
    ray.t_min_low = packet.t_min_low;
    ray.t_min_high = packet.t_min_high;
    ray.from = packet.from;
    return ray;
}

/// Subtrees that single rays have still to visit, for each ray in order of distance.
struct Errands {
    std::uint32_t child[bundle_size][most_errands];
    float enter[bundle_size][most_errands];
    std::uint8_t count[bundle_size];
    FloatRay ray[bundle_size];

    explicit Errands(unsigned rays) {
        for (unsigned k = 0; k < rays; ++k)
            count[k] = 0;
    }
    /// false: there is no room.
    bool add(unsigned k, std::uint32_t subtree, float at) {
        if (count[k] == most_errands)
            return false;
        child[k][count[k]] = subtree;
        enter[k][count[k]++] = at;
        return true;
    }
};

/// Notes the subtree for each of the lanes; immediately(k, lane) where there is no room.
template <class Immediately>
inline void send_on_errand(Errands& errands, unsigned first, std::uint32_t child, Bits lanes,
                           F16 enter, const Immediately& immediately) {
    alignas(64) float at[packet_size];
    enter.store(at);
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = first_of(lanes);
        if (!errands.add(first + lane, child, at[lane]))
            immediately(lane);
    }
}

/// Begins the rays that have errands, each with all of them on its stack.
template <Rays rays>
struct FromErrands {
    Errands& errands;
    const Packet* packets;
    unsigned count;
    unsigned& started;

    bool operator()(Walker& walker) const {
        for (; started < count; ++started) {
            const unsigned k = started, n = errands.count[k];
            if (n == 0)
                continue;
            const Packet& packet = packets[k / packet_size];
            errands.ray[k] = lane_of(packet, k % packet_size);
            walker.take(errands.ray[k], k, packet.high[k % packet_size], 0);
            const float limit = walker.t_max * slab_slack;
            for (unsigned i = n; i-- > 0;)
                walker.stack.push_if(errands.enter[k][i] <= limit, errands.child[k][i],
                                     errands.enter[k][i]);
            walker.next = walker.stack.pop();
            if (walker.next != no_facet) {
                ++started;
                return true;
            }
        }
        return false;
    }
};

} // namespace hemilux::wide::HEMILUX_KERNELS
