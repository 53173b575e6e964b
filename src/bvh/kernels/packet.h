// Sixteen rays from one origin at once. Eight boxes are held against the pyramid around the rays;
// what is left of them, nearest first, one box against sixteen rays. Where few rays are left, they
// go on one by one. With a shared origin a triangle's test is three dot products with the ray's
// direction. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned few = 4; ///< rays that go on one by one

inline unsigned count_bits(Bits bits) { return static_cast<unsigned>(__builtin_popcount(bits)); }

/// Four planes through the origin that hold all rays between them, none if the rays do not all run
/// forward along one axis.
struct Pyramid {
    unsigned axis = 3, side[2];
    float slope_low[2], slope_high[2]; ///< of the side axes over the main one
    bool forward;

    explicit Pyramid(const Packet& packet) {
        V3<F16> d = load16(packet.direction);
        const F16 component[3] = {d.x, d.y, d.z};
        float best = 0.2f;
        for (unsigned i = 0; i < 3; ++i) {
            const float least = lowest_lane(component[i]), most = highest_lane(component[i]);
            const float safe = least > 0 ? least : -most;
            if (safe > best) {
                best = safe;
                axis = i;
                forward = least > 0;
            }
        }
        if (axis == 3)
            return;
        const F16 main = F16::splat(1) / component[axis];
        for (unsigned s = 0; s < 2; ++s) {
            side[s] = (axis + 1 + s) % 3;
            const F16 slope = component[side[s]] * main;
            slope_low[s] = lowest_lane(slope);
            slope_high[s] = highest_lane(slope);
        }
    }

    static V3<F16> load16(const float (&p)[3][16]) {
        return {F16::load(p[0]), F16::load(p[1]), F16::load(p[2])};
    }
    static float lowest_lane(F16 v) {
        alignas(64) float lane[16];
        v.store(lane);
        float least = lane[0];
        for (unsigned i = 1; i < 16; ++i)
            least = lane[i] < least ? lane[i] : least;
        return least;
    }
    static float highest_lane(F16 v) { return -lowest_lane(F16::splat(0) - v); }
};

/// Boxes relative to the packet's origin.
struct RelativeBoxes {
    F8 plane[6];

    RelativeBoxes(const Node& node, const float* origin) {
        for (unsigned p = 0; p < 6; ++p)
            plane[p] = F8::load(node.plane[p]) - F8::splat(origin[p / 2]);
    }
    /// By how much each box lies outside the pyramid; absent boxes lie infinitely far outside.
    [[nodiscard]] F8 outside(const Pyramid& pyramid, F8 square_distance) const {
        const F8 absence = square_distance - F8::splat(1e30f);
        if (pyramid.axis == 3)
            return absence;
        const F8 low = plane[2 * pyramid.axis], high = plane[2 * pyramid.axis + 1];
        const F8 zero = F8::splat(0);
        F8 out = pyramid.forward ? zero - high : low;
        for (unsigned s = 0; s < 2; ++s) {
            const F8 l = plane[2 * pyramid.side[s]], h = plane[2 * pyramid.side[s] + 1];
            const F8 slope_low = F8::splat(pyramid.slope_low[s]);
            const F8 slope_high = F8::splat(pyramid.slope_high[s]);
            // Inside, slope_low * main <= side <= slope_high * main, turned round when backward.
            const F8 a = pyramid.forward ? slope_high : slope_low;
            const F8 b = pyramid.forward ? slope_low : slope_high;
            out = max(out, l - max(a * low, a * high));
            out = max(out, min(b * low, b * high) - h);
        }
        return max(out, absence); // in this order: out is NaN for absent boxes
    }
    /// The square of each box's distance from the origin: absent boxes are infinitely far.
    [[nodiscard]] F8 distance() const {
        F8 sum = F8::splat(0);
        for (unsigned p = 0; p < 6; p += 2) {
            const F8 d = max(max(plane[p], F8::splat(0) - plane[p + 1]), F8::splat(0));
            sum = sum + d * d;
        }
        return sum;
    }
};

/// The lanes that meet one child's box before they end; where, in `enter`.
inline Bits meet_box(const Node& node, unsigned lane, const Packet& packet, F16& enter) {
    enter = F16::splat(0);
    F16 leave = F16::load(packet.high);
    for (unsigned i = 0; i < 3; ++i) {
        const F16 inverse = F16::load(packet.inverse[i]);
        const F16 a = F16::splat(node.plane[2 * i][lane] - packet.origin[i]) * inverse;
        const F16 b = F16::splat(node.plane[2 * i + 1][lane] - packet.origin[i]) * inverse;
        enter = max(enter, min(a, b));
        leave = min(leave, max(a, b));
    }
    return less_equal(enter, leave * F16::splat(slab_slack));
}

/// What eight triangles have in common for all rays of the packet.
struct alignas(64) SharedLeaf {
    float u[3][width], w[3][width], d[3][width]; ///< normals: U, W, D are their dots with d
    float volume[width], error[width], size[width];

    SharedLeaf(const Leaf& leaf, const float* origin) {
        const V3<F8> a = load3(leaf.corner) - V3<F8>::splat(origin);
        const V3<F8> e1 = load3(leaf.edge1), e2 = load3(leaf.edge2);
        const F8 e = max(max_abs(e1), max_abs(e2));
        const V3<F8> n = cross(e1, e2);
        store3(cross(e2, a), u);
        store3(cross(a, e1), w);
        store3(n, d);
        dot(a, n).store(volume);
        error_bound(a, e).store(error);
        e.store(size);
    }
    static void store3(V3<F8> v, float (&to)[3][width]) {
        v.x.store(to[0]);
        v.y.store(to[1]);
        v.z.store(to[2]);
    }
    /// One triangle against all rays.
    [[nodiscard]] Sifted<F16> sift(unsigned k, const V3<F16>& direction) const {
        const auto along = [&](const float(&normal)[3][width]) {
            return dot(V3<F16>{F16::splat(normal[0][k]), F16::splat(normal[1][k]),
                               F16::splat(normal[2][k])},
                       direction);
        };
        return {along(u), along(w), along(d), F16::splat(error[k])};
    }
    /// All triangles against one ray.
    [[nodiscard]] Sifted<F8> sift(const float* direction) const {
        const V3<F8> along = V3<F8>::splat(direction);
        return {dot(load3(u), along), dot(load3(w), along), dot(load3(d), along), F8::load(error)};
    }
};

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

/// Children on the stack: which of which node, and whom they concern.
struct PacketStack {
    std::uint32_t place[stack_size + width]; ///< node * width + child
    float unused[stack_size + width];
    std::uint16_t lanes[stack_size + width];
    unsigned top = 0;

    void push(std::uint32_t node, const RelativeBoxes& boxes, const Pyramid& pyramid, Bits lanes_) {
        // Covers the roundings of the pyramid; the boxes are widened for those of the rays.
        constexpr float tolerance = 0x1p-18f;
        const F8 distance = boxes.distance();
        alignas(64) std::uint32_t names[width];
        for (unsigned c = 0; c < width; ++c)
            names[c] = node * width + c;
        const unsigned added = push_sorted(names, distance, boxes.outside(pyramid, distance),
                                           F8::splat(tolerance), place + top, unused + top);
        for (unsigned i = 0; i < width; ++i)
            lanes[top + i] = static_cast<std::uint16_t>(lanes_);
        top += added;
    }
};

/// Subtrees that single rays have still to visit, for each ray in order of distance.
struct Errands {
    static constexpr unsigned most = 24;
    std::uint32_t child[bundle_size][most];
    float enter[bundle_size][most];
    std::uint8_t count[bundle_size];
    FloatRay ray[bundle_size];

    explicit Errands(unsigned rays) {
        for (unsigned k = 0; k < rays; ++k)
            count[k] = 0;
    }
    /// false: there is no room.
    bool add(unsigned k, std::uint32_t subtree, float at) {
        if (count[k] == most)
            return false;
        child[k][count[k]] = subtree;
        enter[k][count[k]++] = at;
        return true;
    }
};

/// Sends a packet through the tree: on_leaf(leaf, lanes); on_few(child, lanes, enter) for subtrees.
template <class OnLeaf, class OnFew>
inline void walk_packet(const Tree& tree, const Packet& packet, OnLeaf&& on_leaf, OnFew&& on_few) {
    const Pyramid pyramid(packet);
    PacketStack stack;
    Bits alone = 0; // lanes that have left the packet
    stack.push(0, RelativeBoxes(tree.nodes[0], packet.origin), pyramid, packet.lanes);
    while (stack.top > 0) {
        const std::uint32_t place = stack.place[--stack.top];
        const Node& node = tree.nodes[place / width];
        F16 enter;
        Bits lanes = stack.lanes[stack.top] & meet_box(node, place % width, packet, enter);
        if (!lanes)
            continue;
        const std::uint32_t child = node.child[place % width];
        Bits leaving = lanes & alone;
        if (!(child & flag) && count_bits(lanes & ~alone) <= few)
            leaving = lanes;
        if (leaving) {
            on_few(child, leaving, enter);
            alone |= leaving;
            lanes &= ~leaving;
            if (!lanes)
                continue;
        }
        if (child & flag)
            on_leaf(tree.leaves[child & ~flag], lanes);
        else
            stack.push(child, RelativeBoxes(tree.nodes[child], packet.origin), pyramid, lanes);
    }
}

/// Notes the subtree for each of the lanes; immediately(k, lane) where there is no room.
template <class Immediately>
inline void send_on_errand(Errands& errands, unsigned first, std::uint32_t child, Bits lanes,
                           F16 enter, const Immediately& immediately) {
    alignas(64) float at[packet_size];
    enter.store(at);
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = lowest(lanes);
        if (!errands.add(first + lane, child, at[lane]))
            immediately(lane);
    }
}

/// Begins the rays that have errands, each with all of them on its stack.
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
            walker.take(errands.ray[k], k, packet.high[k % packet_size]);
            for (unsigned i = n; i-- > 0;)
                walker.stack.push_one(errands.child[k][i], errands.enter[k][i]);
            if (walker.pop()) {
                ++started;
                return true;
            }
        }
        return false;
    }
};

/// The triangles of a leaf, each with the lanes that may strike it: visit(k, sifted, lanes).
template <class Visit>
inline void sift_packet(const Leaf& leaf, const SharedLeaf& shared, const Packet& packet,
                        Bits lanes, Visit&& visit) {
    const V3<F16> direction = Pyramid::load16(packet.direction);
    Bits maybe[width], hit = 0;
    for (unsigned k = 0; k < width; ++k) {
        maybe[k] = shared.sift(k, direction).maybe() & lanes;
        hit |= Bits{maybe[k] != 0} << k;
    }
    for (; hit; hit &= hit - 1) {
        const unsigned k = lowest(hit);
        if ((leaf.slot[k] & ~flag) != packet.from)
            visit(k, shared.sift(k, direction), maybe[k]);
    }
}

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
        const unsigned lane = lowest(left);
        packet.slot[lane] = slot;
        packet.front[lane] = front >> lane & 1;
    }
    for (Bits left = maybe & ~sure & ~out; left; left &= left - 1) {
        LaneNearest own(packet, lowest(left));
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
        const unsigned lane = lowest(left);
        packet.slot[lane] +=
            (sure >> lane & 1) != 0 || judge.counts(judge.query, first + lane, leaf.slot[k]);
    }
}

/// The nearest facet of each ray of up to bundle_size in packets.
inline void closest_bundle(const Tree& tree, Packet* packets, unsigned rays, const Judge& judge) {
    Errands errands(rays);
    for (unsigned first = 0; first < rays; first += packet_size) {
        Packet& packet = packets[first / packet_size];
        walk_packet(
            tree, packet,
            [&](const Leaf& leaf, Bits lanes) {
                const SharedLeaf shared(leaf, packet.origin);
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
    wave(tree, FromErrands{errands, packets, rays, started}, [&](Walker& walker, const Leaf& leaf) {
        const unsigned k = walker.index;
        LaneNearest own(packets[k / packet_size], k % packet_size);
        closest_in(leaf, *walker.ray, k, own.nearest, judge);
        walker.t_max = own.nearest.high;
        return false;
    });
}

/// How many facets each ray pierces, added to Packet::slot.
inline void count_bundle(const Tree& tree, Packet* packets, unsigned rays, const Judge& judge) {
    constexpr float infinity = __builtin_inff();
    Errands errands(rays);
    for (unsigned first = 0; first < rays; first += packet_size) {
        Packet& packet = packets[first / packet_size];
        walk_packet(
            tree, packet,
            [&](const Leaf& leaf, Bits lanes) {
                const SharedLeaf shared(leaf, packet.origin);
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
    wave(tree, FromErrands{errands, packets, rays, started}, [&](Walker& walker, const Leaf& leaf) {
        const unsigned k = walker.index;
        packets[k / packet_size].slot[k % packet_size] +=
            count_in(leaf, *walker.ray, k, infinity, infinity, judge);
        return false;
    });
}

} // namespace hemilux::wide::HEMILUX_KERNELS
