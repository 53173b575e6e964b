// Kernels for one ray at a time: eight boxes against the ray, eight triangles against the ray. No
// #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

/// This factor covers the relative rounding errors of a slab test.
inline constexpr float slab_slack = 1 + 0x1p-20f;

/// Pushes the children met before t_max.
template <Rays rays>
inline void visit_node(const Node& node, const SlabRay& ray, float t_max, Stack& stack) {
    const auto met_at = [&](const SlabRay::Byte* place, unsigned axis) {
        return F8::load(node.plane[0] + place[axis]) * F8::splat(ray.inverse[axis]) +
               F8::splat(ray.offset[axis]);
    };
    const F8 enter =
        max(max(met_at(ray.near, 0), met_at(ray.near, 1)), max(met_at(ray.near, 2), F8::splat(0)));
    const F8 leave =
        min(min(met_at(ray.far, 0), met_at(ray.far, 1)), min(met_at(ray.far, 2), F8::splat(t_max)));
    stack.push<rays>(node, ray.octant, enter, leave * F8::splat(slab_slack));
}

/// Walks the tree depth-first. leaf(const Leaf&) returns true to stop. t_max may shrink meanwhile,
/// where rays are stopped.
template <Rays rays, class OnLeaf>
inline void walk(const Tree& tree, const FloatRay& ray, const float& t_max, OnLeaf&& on_leaf) {
    Stack stack;
    stack.clear();
    for (std::uint32_t now = 0; now != no_facet;) {
        if ((now & flag) == 0) {
            visit_node<rays>(tree.nodes[now], ray.slabs, t_max, stack);
            now = stack.pop();
        } else {
            if (on_leaf(tree.leaves[now & ~flag]))
                return;
            now = stack.pop_before<rays>(t_max * slab_slack);
        }
    }
}

inline V3 load3(const float (&p)[3][width]) {
    return {F8::load(p[0]), F8::load(p[1]), F8::load(p[2])};
}

/// The test of a leaf's triangles against one ray.
struct LeafTest {
    V3 a, e1, e2, normal;
    F8 e;
    EdgeFunctions edges;

    LeafTest(const Leaf& leaf, const FloatRay& ray)
        : a(load3(leaf.corner) - V3::splat(ray.origin)), e1(load3(leaf.edge1)),
          e2(load3(leaf.edge2)), normal(cross(e1, e2)), e(max(max_abs(e1), max_abs(e2))),
          edges(edge_functions(ray)) {}

    [[nodiscard]] Interval interval() const { return {edges, dot(a, normal), e}; }
    [[nodiscard]] Span span_before(const FloatRay& ray, const Nearest& end) const {
        return HEMILUX_KERNELS::span_before(edges, dot(a, normal), e, ray, end);
    }

  private:
    [[nodiscard]] EdgeFunctions edge_functions(const FloatRay& ray) const {
        const V3 d = V3::splat(ray.direction);
        const V3 q = cross(a, d); // U = e2.(A x d), W = -e1.(A x d)
        return {dot(e2, q), F8::splat(0) - dot(e1, q), dot(d, normal),
                error_bound(a, e, ray.reach)};
    }
};

/// The slots of a leaf that a ray strikes between its start and its end, certainly or perhaps.
/// Those of `excepted` facets are left out.
struct HitMask {
    Bits certain, uncertain;

    HitMask() = default;
    HitMask(const EdgeFunctions& edges, const Span& span, Lanes excepted) {
        constexpr Bits all = (Bits{1} << width) - 1;
        const Lanes sure = edges.inside() & span.within;
        certain = bits(without(sure, excepted));
        uncertain = bits(sure | edges.outside() | span.beyond | excepted) ^ all;
    }
};

inline Lanes slots_of(std::uint32_t facet, const Leaf& leaf) {
    return equal(leaf.slot, flag, facet);
}

/// The bounds of t for each slot of a leaf, and what to take where no slot is nearer.
struct Candidates {
    alignas(64) float low[2 * width], high[2 * width];
    alignas(64) std::uint32_t slot[2 * width];
    Bits front;

    Candidates(const Leaf& leaf, const EdgeFunctions& edges, const Interval& t,
               const Nearest& otherwise)
        : front(edges.front() | otherwise.front << width) {
        t.low.store(low);
        t.high.store(high);
        __builtin_memcpy(slot, leaf.slot, sizeof leaf.slot);
        low[width] = otherwise.low;
        high[width] = otherwise.high;
        slot[width] = otherwise.slot;
    }
    [[nodiscard]] Nearest operator[](unsigned k) const {
        return {low[k], high[k], slot[k], front >> k & 1};
    }
};

/// Compares the slots of a leaf with the nearest hit so far, one after the other.
inline void consider(const HitMask& mask, const Candidates& candidates, Bits known,
                     const RayQuery& query, unsigned index, Nearest& nearest) {
    for (Bits left = mask.certain | mask.uncertain; left; left &= left - 1) {
        const unsigned k = first_of(left);
        const Nearest at = candidates[k];
        if ((known >> k & 1) != 0 && at.low > nearest.high)
            continue;
        if ((mask.certain >> k & 1) != 0 && at.high < nearest.low)
            nearest = at;
        else if (nearest.slot == no_facet || ((at.slot ^ nearest.slot) & ~flag) != 0)
            query.closer(query.query, index, at.slot, nearest);
    }
}

/// Compares a leaf with the nearest hit so far. Nearly always one slot or none is nearer, and
/// certainly so. That case needs no branch, which the processor could not foresee.
[[gnu::always_inline]] inline void closest_in(const Leaf& leaf, const FloatRay& ray,
                                              const RayQuery& query, unsigned index,
                                              Nearest& nearest) {
    const LeafTest test(leaf, ray);
    const Interval t = test.interval();
    const HitMask mask(test.edges, t.before(ray, nearest), slots_of(ray.from, leaf));
    const Candidates candidates(leaf, test.edges, t, nearest);
    if (mask.uncertain | (mask.certain & (mask.certain - 1))) [[unlikely]]
        consider(mask, candidates, bits(t.known), query, index, nearest);
    else
        nearest = candidates[first_of(mask.certain | Bits{1} << width)];
}

inline void closest(const Tree& tree, const FloatRay& ray, Nearest& nearest,
                    const RayQuery& query) {
    walk<Rays::stop>(tree, ray, nearest.high, [&](const Leaf& leaf) {
        closest_in(leaf, ray, query, 0, nearest);
        return false;
    });
}

/// Returns the slots of a leaf that are hit before the end, but for those of `target`.
[[gnu::always_inline]] inline HitMask hits_before(const Leaf& leaf, const FloatRay& ray,
                                                  const Nearest& end, std::uint32_t target) {
    const LeafTest test(leaf, ray);
    return {test.edges, test.span_before(ray, end),
            slots_of(ray.from, leaf) | slots_of(target, leaf)};
}

inline bool blocks(const HitMask& mask, const Leaf& leaf, const RayQuery& query, unsigned index) {
    bool blocked = mask.certain != 0;
    for (Bits left = blocked ? 0 : mask.uncertain; left && !blocked; left &= left - 1)
        blocked = query.hits(query.query, index, leaf.slot[first_of(left)]);
    return blocked;
}

inline bool occluded(const Tree& tree, const FloatRay& ray, const Nearest& end,
                     std::uint32_t target, const RayQuery& query) {
    bool blocked = false;
    walk<Rays::pierce>(tree, ray, end.high, [&](const Leaf& leaf) {
        blocked = blocks(hits_before(leaf, ray, end, target), leaf, query, 0);
        return blocked;
    });
    return blocked;
}

/// Returns how many facets are pierced, of those in a leaf.
inline std::uint32_t count_in(const HitMask& mask, const Leaf& leaf, const RayQuery& query,
                              unsigned index) {
    std::uint32_t pierced = count_bits(mask.certain);
    for (Bits left = mask.uncertain; left; left &= left - 1)
        pierced += query.counts(query.query, index, leaf.slot[first_of(left)]);
    return pierced;
}

inline std::uint32_t count(const Tree& tree, const FloatRay& ray, const Nearest& end,
                           const RayQuery& query) {
    std::uint32_t pierced = 0;
    walk<Rays::pierce>(tree, ray, end.high, [&](const Leaf& leaf) {
        pierced += count_in(hits_before(leaf, ray, end, no_facet), leaf, query, 0);
        return false;
    });
    return pierced;
}

} // namespace hemilux::wide::HEMILUX_KERNELS
