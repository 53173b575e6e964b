// Bundles: rays from one origin, in packets as long as they keep together, then in a wave.
// No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

/// The nearest of the packet's lanes one by one, as the single kernels and the judge see them.
struct LaneNearest {
    Packet& packet;
    unsigned lane;
    Nearest nearest;

    LaneNearest(Packet& of, unsigned lane_)
        : packet(of),
          lane(lane_), nearest{of.low[lane], of.high[lane], of.slot[lane], of.front[lane]} {}
    ~LaneNearest() {
        packet.low[lane] = nearest.low;
        packet.high[lane] = nearest.high;
        packet.slot[lane] = nearest.slot;
        packet.front[lane] = nearest.front;
    }
};

/// One triangle that some lanes may strike, against the nearest of each.
inline void consider_lanes(const Leaf& leaf, const SharedLeaf& shared, unsigned k,
                           const Sifted<F16>& sifted, Bits maybe, unsigned first, Packet& packet,
                           const Judge& judge) {
    const Interval<F16> t(sifted, F16::splat(shared.volume[k]), F16::splat(shared.size[k]));
    const F16 low = F16::load(packet.low), high = F16::load(packet.high);
    const Bits sure = maybe & t.known & sifted.inside() &
                      less(F16::splat(packet.t_min_high), t.low) & less(t.high, low);
    const Bits out = t.known & (less(high, t.low) | less(t.high, F16::splat(packet.t_min_low)));
    select(sure, t.low, low).store(packet.low);
    select(sure, t.high, high).store(packet.high);
    const std::uint32_t slot = leaf.slot[k];
    const Bits front = sifted.front();
    for (Bits left = sure; left; left &= left - 1) {
        const unsigned lane = first_of(left);
        packet.slot[lane] = slot;
        packet.front[lane] = front >> lane & 1;
    }
    for (Bits left = maybe & ~sure & ~out; left; left &= left - 1) {
        LaneNearest own(packet, first_of(left));
        if (own.nearest.slot == no_facet || ((slot ^ own.nearest.slot) & ~flag) != 0)
            judge.closer(judge.query, first + own.lane, slot, own.nearest);
    }
}

/// One triangle that some lanes may strike: who pierces it.
inline void count_lanes(const Leaf& leaf, const SharedLeaf& shared, unsigned k,
                        const Sifted<F16>& sifted, Bits maybe, unsigned first, Packet& packet,
                        const Judge& judge) {
    const Interval<F16> t(sifted, F16::splat(shared.volume[k]), F16::splat(shared.size[k]));
    const Bits sure =
        maybe & t.known & sifted.inside() & less(F16::splat(packet.t_min_high), t.low);
    const Bits out = t.known & less(t.high, F16::splat(packet.t_min_low));
    for (Bits left = maybe & ~out; left; left &= left - 1) {
        const unsigned lane = first_of(left);
        packet.slot[lane] +=
            (sure >> lane & 1) != 0 || judge.counts(judge.query, first + lane, leaf.slot[k]);
    }
}

/// The nearest facet of each ray of up to bundle_size in packets.
inline bool closest_bundle(const Tree& tree, Packet* packets, unsigned number, const Judge& judge) {
    if (!set_slabs(packets, number))
        return false;
    Errands errands(number);
    for (unsigned first = 0; first < number; first += packet_size) {
        Packet& packet = packets[first / packet_size];
        walk_packet<Rays::stop>(
            tree, packet,
            [&](const Leaf& leaf, Bits lanes) {
                const SharedLeaf shared(leaf, packet.origin);
                if (count_bits(lanes) <= few_in_leaf)
                    return sift_lanes(
                        shared, packet, lanes,
                        [&](unsigned lane, const Sifted<F8>& sifted, const Interval<F8>& t) {
                            LaneNearest own(packet, lane);
                            settle(leaf, sifted, t, lane_of(packet, lane), first + lane,
                                   own.nearest, judge);
                        });
                sift_packet(leaf, shared, packet, lanes,
                            [&](unsigned k, const Sifted<F16>& sifted, Bits maybe) {
                                consider_lanes(leaf, shared, k, sifted, maybe, first, packet,
                                               judge);
                            });
            },
            [&](std::uint32_t child, Bits lanes, F16 enter) {
                send_on_errand(errands, first, child, lanes, enter, [&](unsigned lane) {
                    LaneNearest own(packet, lane);
                    closest_from(tree, child, lane_of(packet, lane), first + lane, own.nearest,
                                 judge);
                });
            });
    }
    unsigned started = 0;
    wave<Rays::stop>(tree, FromErrands<Rays::stop>{errands, packets, number, started},
                     [&](Walker& walker, const Leaf& leaf) {
                         const unsigned k = walker.index;
                         LaneNearest own(packets[k / packet_size], k % packet_size);
                         closest_in(leaf, *walker.ray, k, own.nearest, judge);
                         walker.t_max = own.nearest.high;
                         return false;
                     });
    return true;
}

/// How many facets each ray pierces, added to Packet::slot.
inline bool count_bundle(const Tree& tree, Packet* packets, unsigned number, const Judge& judge) {
    constexpr float infinity = __builtin_inff();
    if (!set_slabs(packets, number))
        return false;
    Errands errands(number);
    for (unsigned first = 0; first < number; first += packet_size) {
        Packet& packet = packets[first / packet_size];
        walk_packet<Rays::pierce>(
            tree, packet,
            [&](const Leaf& leaf, Bits lanes) {
                const SharedLeaf shared(leaf, packet.origin);
                if (count_bits(lanes) <= few_in_leaf)
                    return sift_lanes(
                        shared, packet, lanes,
                        [&](unsigned lane, const Sifted<F8>& sifted, const Interval<F8>& t) {
                            const Verdict verdict(leaf, sifted, t, lane_of(packet, lane), infinity,
                                                  infinity);
                            packet.slot[lane] += count_of(verdict, leaf, first + lane, judge);
                        });
                sift_packet(leaf, shared, packet, lanes,
                            [&](unsigned k, const Sifted<F16>& sifted, Bits maybe) {
                                count_lanes(leaf, shared, k, sifted, maybe, first, packet, judge);
                            });
            },
            [&](std::uint32_t child, Bits lanes, F16 enter) {
                send_on_errand(errands, first, child, lanes, enter, [&](unsigned lane) {
                    packet.slot[lane] += count_from(tree, child, lane_of(packet, lane),
                                                    first + lane, infinity, infinity, judge);
                });
            });
    }
    unsigned started = 0;
    wave<Rays::pierce>(tree, FromErrands<Rays::pierce>{errands, packets, number, started},
                       [&](Walker& walker, const Leaf& leaf) {
                           const unsigned k = walker.index;
                           packets[k / packet_size].slot[k % packet_size] +=
                               count_in(leaf, *walker.ray, k, infinity, infinity, judge);
                           return false;
                       });
    return true;
}

} // namespace hemilux::wide::HEMILUX_KERNELS
