// Sixteen rays from one origin at once. Eight boxes are held against the pyramid around the rays;
// what is left of them, nearest first, one box against sixteen rays. Where few rays are left, they
// go on one by one. With a shared origin a triangle's test is three dot products with the ray's
// direction. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned few = 3;          ///< rays that leave the packet
inline constexpr unsigned few_in_leaf = 12; ///< rays that are held against eight triangles at once

inline unsigned count_bits(Bits bits) { return static_cast<unsigned>(__builtin_popcount(bits)); }

inline V3<F16> load16(const float (&p)[3][packet_size]) {
    return {F16::load(p[0]), F16::load(p[1]), F16::load(p[2])};
}

/// Four planes through the origin that hold all rays between them. If the rays go too far apart,
/// all boxes lie within, but not those of absent children, which are infinitely far away.
struct Pyramid {
    float normal[4][3];     ///< outward
    unsigned nearest[4][3]; ///< which planes of a box meet in the corner that is farthest inward
    unsigned octant;        ///< of the mean direction

    explicit Pyramid(const Packet& packet) {
        const V3<F16> d = load16(packet.direction);
        float axis[3] = {total(d.x), total(d.y), total(d.z)}, x[3], y[3];
        octant = octant_of(axis);
        for (unsigned k = 0; k < 4; ++k)
            for (unsigned i = 0; i < 3; ++i)
                set(k, i, 0);
        if (!(length(axis) > 1))
            return;
        scale(axis, 1 / length(axis));
        across(axis, x, y);
        const F16 forward = dot(d, V3<F16>::splat(axis));
        constexpr float least_forward = 0.15f;
        if (!(lowest(forward) > least_forward))
            return;
        set_planes(0, axis, x, dot(d, V3<F16>::splat(x)) / forward);
        set_planes(2, axis, y, dot(d, V3<F16>::splat(y)) / forward);
    }

  private:
    /// slope_low <= p.side / p.axis <= slope_high, as two planes.
    void set_planes(unsigned first, const float* axis, const float* side, F16 slope) {
        const float low = lowest(slope), high = -lowest(F16::splat(0) - slope);
        for (unsigned i = 0; i < 3; ++i) {
            set(first, i, side[i] - high * axis[i]);
            set(first + 1, i, low * axis[i] - side[i]);
        }
    }
    /// Never quite zero: infinity times it is to be infinity.
    void set(unsigned k, unsigned i, float n) {
        normal[k][i] = n < 0 ? n - 1e-20f : n + 1e-20f;
        nearest[k][i] = 2 * i + (n < 0);
    }
    /// Two directions that make a frame with the axis (Duff et al. 2017).
    static void across(const float* n, float* x, float* y) {
        const float sign = n[2] < 0 ? -1.0f : 1.0f, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
        x[0] = 1 + sign * n[0] * n[0] * a;
        x[1] = sign * b;
        x[2] = -sign * n[0];
        y[0] = b;
        y[1] = sign + n[1] * n[1] * a;
        y[2] = -n[1];
    }
    static float total(F16 v) {
        alignas(64) float lane[packet_size];
        v.store(lane);
        const F4 sum =
            F4::load(lane) + F4::load(lane + 4) + F4::load(lane + 8) + F4::load(lane + 12);
        return (sum.v[0] + sum.v[1]) + (sum.v[2] + sum.v[3]);
    }
    static float length(const float* v) {
        return __builtin_sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    static void scale(float* v, float by) {
        for (unsigned i = 0; i < 3; ++i)
            v[i] *= by;
    }
};

/// Boxes relative to the packet's origin.
struct RelativeBoxes {
    F8 plane[6];

    RelativeBoxes(const Node& node, const float* origin) {
        for (unsigned p = 0; p < 6; ++p)
            plane[p] = F8::load(node.plane[p]) - F8::splat(origin[p / 2]);
    }
    /// By how much each box lies outside the pyramid.
    [[nodiscard]] F8 outside(const Pyramid& pyramid) const {
        const auto beyond = [&](unsigned k) {
            return plane[pyramid.nearest[k][0]] * F8::splat(pyramid.normal[k][0]) +
                   plane[pyramid.nearest[k][1]] * F8::splat(pyramid.normal[k][1]) +
                   plane[pyramid.nearest[k][2]] * F8::splat(pyramid.normal[k][2]);
        };
        return max(max(beyond(0), beyond(1)), max(beyond(2), beyond(3)));
    }
};

/// The lanes that meet one child's box before they end; where, in `enter`.
inline Bits meet_box(const Node& node, unsigned lane, const Packet& packet, F16& enter) {
    enter = F16::splat(0);
    F16 leave = F16::load(packet.high);
    for (unsigned i = 0; i < 3; ++i) {
        const F16 inverse = F16::load(packet.inverse[i]), offset = F16::load(packet.offset[i]);
        const F16 a = F16::splat(node.plane[2 * i][lane]) * inverse + offset;
        const F16 b = F16::splat(node.plane[2 * i + 1][lane]) * inverse + offset;
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

/// What remains to be visited by a packet, the nearest on top.
struct PacketStack {
    struct alignas(64) Entry {
        float enter[packet_size]; ///< of each lane
        std::uint32_t child;
        Bits lanes;
    };
    Entry entry[stack_size + 1];
    unsigned top = 0;

    /// Adds the children of a node that some of the lanes meet.
    void push(const Tree& tree, std::uint32_t index, const Packet& packet, const Pyramid& pyramid,
              Bits lanes) {
        // Covers the roundings of the pyramid; the boxes are widened for those of the rays.
        constexpr float tolerance = 0x1p-17f;
        alignas(64) static constexpr std::uint32_t names[width] = {0, 1, 2, 3, 4, 5, 6, 7};
        const Node& node = tree.nodes[index];
        const F8 outside = RelativeBoxes(node, packet.origin).outside(pyramid);
        const Ordering ordering(node, pyramid.octant, outside, F8::splat(tolerance));
        std::uint32_t child[width];
        ordering.store(names, child);
        const unsigned count = ordering.count();
        for (unsigned i = 0; i < count; ++i) {
            Entry& to = entry[top];
            F16 enter;
            to.lanes = lanes & meet_box(node, child[i], packet, enter);
            enter.store(to.enter);
            to.child = node.child[child[i]];
            top += to.lanes != 0;
        }
    }
};

/// Works out what the box tests need.
inline void set_slabs(Packet& packet) {
    const F16 least = F16::splat(1e-18f); // no plane then gives 0 times infinity
    for (unsigned i = 0; i < 3; ++i) {
        const F16 d = F16::load(packet.direction[i]);
        const F16 inverse = F16::splat(1) / select(less(abs(d), least), least, d);
        inverse.store(packet.inverse[i]);
        (F16::splat(-packet.origin[i]) * inverse).store(packet.offset[i]);
    }
}

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
/// Where hits stop rays, a ray that has left gets all that follows as errands, to be done
/// when the hits of its first ones are known.
template <Rays rays, class OnLeaf, class OnFew>
inline void walk_packet(const Tree& tree, const Packet& packet, OnLeaf&& on_leaf, OnFew&& on_few) {
    const Pyramid pyramid(packet);
    PacketStack stack;
    Bits alone = 0; // lanes that have left the packet
    stack.push(tree, 0, packet, pyramid, packet.lanes);
    while (stack.top > 0) {
        const PacketStack::Entry& entry = stack.entry[--stack.top];
        const F16 enter = F16::load(entry.enter);
        const F16 limit = F16::load(packet.high) * F16::splat(slab_slack);
        Bits lanes = entry.lanes & less_equal(enter, limit);
        if (!lanes)
            continue;
        const std::uint32_t child = entry.child;
        Bits leaving = lanes & alone;
        if (!(child & flag) && count_bits(lanes & ~alone) <= few)
            leaving = lanes;
        if (leaving) {
            on_few(child, leaving, enter);
            if (rays == Rays::stop)
                alone |= leaving;
            lanes &= ~leaving;
            if (!lanes)
                continue;
        }
        if (child & flag)
            on_leaf(tree.leaves[child & ~flag], lanes);
        else
            stack.push(tree, child, packet, pyramid, lanes);
    }
}

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
            walker.take(errands.ray[k], k, packet.high[k % packet_size]);
            for (unsigned i = n; i-- > 0;)
                walker.stack.push_one(errands.child[k][i], errands.enter[k][i]);
            if (walker.pop<rays>()) {
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
    const V3<F16> direction = load16(packet.direction);
    Bits maybe[width], hit = 0;
    for (unsigned k = 0; k < width; ++k) {
        maybe[k] = shared.sift(k, direction).maybe() & lanes;
        hit |= Bits{maybe[k] != 0} << k;
    }
    for (; hit; hit &= hit - 1) {
        const unsigned k = first_of(hit);
        if ((leaf.slot[k] & ~flag) != packet.from)
            visit(k, shared.sift(k, direction), maybe[k]);
    }
}

/// The same where few lanes are left: visit(lane, slot, low, high, known, inside, front).
template <class Visit>
inline void sift_lanes(const Leaf& leaf, const SharedLeaf& shared, const Packet& packet, Bits lanes,
                       Visit&& visit) {
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = first_of(lanes);
        const float direction[3] = {packet.direction[0][lane], packet.direction[1][lane],
                                    packet.direction[2][lane]};
        const Sifted<F8> sifted = shared.sift(direction);
        if (const Bits maybe = sifted.maybe())
            visit_slots(leaf, sifted,
                        Interval<F8>(sifted, F8::load(shared.volume), F8::load(shared.size)), maybe,
                        packet.from, [&](auto... told) { return visit(lane, told...); });
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
inline void closest_bundle(const Tree& tree, Packet* packets, unsigned number, const Judge& judge) {
    Errands errands(number);
    for (unsigned first = 0; first < number; first += packet_size) {
        Packet& packet = packets[first / packet_size];
        set_slabs(packet);
        walk_packet<Rays::stop>(
            tree, packet,
            [&](const Leaf& leaf, Bits lanes) {
                const SharedLeaf shared(leaf, packet.origin);
                if (count_bits(lanes) <= few_in_leaf)
                    return sift_lanes(leaf, shared, packet, lanes,
                                      [&](unsigned lane, auto... told) {
                                          LaneNearest own(packet, lane);
                                          consider(told..., lane_of(packet, lane), first + lane,
                                                   own.nearest, judge);
                                          return false;
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
}

/// How many facets each ray pierces, added to Packet::slot.
inline void count_bundle(const Tree& tree, Packet* packets, unsigned number, const Judge& judge) {
    constexpr float infinity = __builtin_inff();
    Errands errands(number);
    for (unsigned first = 0; first < number; first += packet_size) {
        Packet& packet = packets[first / packet_size];
        set_slabs(packet);
        walk_packet<Rays::pierce>(
            tree, packet,
            [&](const Leaf& leaf, Bits lanes) {
                const SharedLeaf shared(leaf, packet.origin);
                if (count_bits(lanes) <= few_in_leaf)
                    return sift_lanes(
                        leaf, shared, packet, lanes, [&](unsigned lane, auto... told) {
                            packet.slot[lane] += pierces(told..., lane_of(packet, lane),
                                                         first + lane, infinity, infinity, judge);
                            return false;
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
}

} // namespace hemilux::wide::HEMILUX_KERNELS
