// Sixteen rays from one origin go through the tree together: of a node's eight boxes those that
// reach into the pyramid around the rays, and each of these exactly against the sixteen. Where few
// rays are left, they leave the packet. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

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

/// Works out what the box tests need. False if a direction is not of about unit length, so that the
/// sieve's bounds do not hold; NaN is not.
inline bool set_slabs(Packet& packet) {
    const F16 least = F16::splat(1e-18f); // no plane then gives 0 times infinity
    F16 longest = F16::splat(0), sum = longest;
    for (unsigned i = 0; i < 3; ++i) {
        const F16 d = F16::load(packet.direction[i]);
        longest = max(longest, abs(d));
        sum = sum + d;
        const F16 inverse = F16::splat(1) / select(less(abs(d), least), least, d);
        inverse.store(packet.inverse[i]);
        (F16::splat(-packet.origin[i]) * inverse).store(packet.offset[i]);
    }
    const Bits fit = less_equal(F16::splat(0.25f), longest) &
                     less_equal(longest, F16::splat(1.001f)) & less_equal(abs(sum), F16::splat(4));
    return fit == (Bits{1} << packet_size) - 1;
}

/// All packets of a bundle.
inline bool set_slabs(Packet* packets, unsigned rays) {
    bool fit = true;
    for (unsigned first = 0; first < rays; first += packet_size)
        fit &= set_slabs(packets[first / packet_size]);
    return fit;
}

/// Sends a packet through the tree: on_leaf(leaf, lanes); on_few(child, lanes, enter) for subtrees.
/// Where hits stop rays, a ray that has left gets all that follows as errands, to be done
/// when the hits of its first ones are known.
template <Rays rays, class OnLeaf, class OnFew>
inline void walk_packet(const Tree& tree, const Packet& packet, OnLeaf&& on_leaf, OnFew&& on_few) {
    if (tree.root & flag)
        return on_leaf(tree.leaves[tree.root & ~flag], packet.lanes);
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
        if (!(child & flag) && count_bits(lanes & ~alone) <= tree.few)
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

} // namespace hemilux::wide::HEMILUX_KERNELS
