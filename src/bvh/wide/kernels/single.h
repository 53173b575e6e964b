// Kernels for one ray at a time: eight boxes against the ray, eight triangles against the ray. No
// #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

/// This factor covers the relative rounding errors of a slab test.
inline constexpr float slab_slack = 1 + 0x1p-20f;

/// The ray as the box tests take it: a plane p is met at p * inverse + offset.
struct SlabRay {
    using Byte = unsigned char; // so that a state's head fits a line of the cache

    float inverse[3], offset[3];
    Byte octant, near[3], far[3]; ///< places in a node of the planes met first and last

    void set(const FloatRay& ray) {
        octant = static_cast<Byte>(octant_of(ray.inverse));
        for (unsigned i = 0; i < 3; ++i) {
            inverse[i] = ray.inverse[i];
            offset[i] = -ray.origin[i] * ray.inverse[i];
            near[i] = static_cast<Byte>(width * (2 * i + (ray.inverse[i] < 0)));
            far[i] = near[i] ^ width;
        }
    }
};

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
    SlabRay slabs;
    slabs.set(ray);
    Stack stack;
    stack.clear();
    for (std::uint32_t now = tree.root; now != no_facet;) {
        if ((now & flag) == 0) {
            visit_node<rays>(tree.nodes[now], slabs, t_max, stack);
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
    V3 a, e1, e2;
    F8 e;
    EdgeFunctions edges;

    LeafTest(const Leaf& leaf, const FloatRay& ray)
        : a(load3(leaf.corner) - V3::splat(ray.origin)), e1(load3(leaf.edge1)),
          e2(load3(leaf.edge2)), e(max(max_abs(e1), max_abs(e2))), edges(edge_functions(ray)) {}

    [[nodiscard]] Interval interval() const { return {edges, dot(a, cross(e1, e2)), e}; }

  private:
    [[nodiscard]] EdgeFunctions edge_functions(const FloatRay& ray) const {
        const V3 d = V3::splat(ray.direction);
        const V3 q = cross(a, d); // U = e2.(A x d), W = -e1.(A x d)
        return {dot(e2, q), F8::splat(0) - dot(e1, q), dot(d, cross(e1, e2)),
                error_bound(a, e, reach(ray))};
    }
    /// Returns the largest component of the origin and what a ray from far away, which begins where
    /// it enters the bounds, may be off by more.
    [[nodiscard]] static float reach(const FloatRay& ray) {
        constexpr float entered = 0.003f;
        const float x = __builtin_fabsf(ray.origin[0]), y = __builtin_fabsf(ray.origin[1]),
                    z = __builtin_fabsf(ray.origin[2]);
        const float xy = x > y ? x : y;
        return entered + (xy > z ? xy : z);
    }
};

/// The slots of a leaf that a ray strikes before it ends, certainly or perhaps. Its end is known to
/// lie between `low` and `high`.
struct HitMask {
    Bits certain, uncertain;

    HitMask(const Leaf& leaf, const EdgeFunctions& edges, const Interval& t, const FloatRay& ray,
            float low, float high) {
        const Bits out =
            t.known & (less(F8::splat(high), t.low) | less(t.high, F8::splat(ray.t_min_low)));
        const Bits candidates = edges.may_hit() & ~out & ~equal(leaf.slot, flag, ray.from);
        certain = candidates & t.known & edges.inside() & less(F8::splat(ray.t_min_high), t.low) &
                  less(t.high, F8::splat(low));
        uncertain = candidates & ~certain;
    }
};

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
inline void consider(const HitMask& mask, const Candidates& candidates, Bits known, unsigned index,
                     Nearest& nearest, const ExactTest& exact) {
    for (Bits left = mask.certain | mask.uncertain; left; left &= left - 1) {
        const unsigned k = first_of(left);
        const Nearest at = candidates[k];
        if ((known >> k & 1) != 0 && at.low > nearest.high)
            continue;
        if ((mask.certain >> k & 1) != 0 && at.high < nearest.low)
            nearest = at;
        else if (nearest.slot == no_facet || ((at.slot ^ nearest.slot) & ~flag) != 0)
            exact.closer(exact.query, index, at.slot, nearest);
    }
}

/// Compares a leaf with the nearest hit so far. Nearly always one slot or none is nearer, and
/// certainly so. That case needs no branch, which the processor could not foresee.
[[gnu::always_inline]] inline void closest_in(const Leaf& leaf, const FloatRay& ray, unsigned index,
                                              Nearest& nearest, const ExactTest& exact) {
    const LeafTest test(leaf, ray);
    const Interval t = test.interval();
    const HitMask mask(leaf, test.edges, t, ray, nearest.low, nearest.high);
    const Candidates candidates(leaf, test.edges, t, nearest);
    if (mask.uncertain | (mask.certain & (mask.certain - 1))) [[unlikely]]
        consider(mask, candidates, t.known, index, nearest, exact);
    else
        nearest = candidates[first_of(mask.certain | Bits{1} << width)];
}

inline void closest(const Tree& tree, const FloatRay& ray, unsigned index, Nearest& nearest,
                    const ExactTest& exact) {
    walk<Rays::stop>(tree, ray, nearest.high, [&](const Leaf& leaf) {
        closest_in(leaf, ray, index, nearest, exact);
        return false;
    });
}

/// Returns whether anything in a leaf but `target` is hit before t.
inline bool blocks(const Leaf& leaf, const FloatRay& ray, unsigned index, float t_low, float t_high,
                   std::uint32_t target, const ExactTest& exact) {
    const LeafTest test(leaf, ray);
    const HitMask mask(leaf, test.edges, test.interval(), ray, t_low, t_high);
    const Bits others = ~equal(leaf.slot, flag, target);
    if (mask.certain & others)
        return true;
    for (Bits left = mask.uncertain & others; left; left &= left - 1)
        if (exact.hits(exact.query, index, leaf.slot[first_of(left)]))
            return true;
    return false;
}

inline bool occluded(const Tree& tree, const FloatRay& ray, unsigned index, float t_low,
                     float t_high, std::uint32_t target, const ExactTest& exact) {
    bool blocked = false;
    walk<Rays::pierce>(tree, ray, t_high, [&](const Leaf& leaf) {
        blocked = blocks(leaf, ray, index, t_low, t_high, target, exact);
        return blocked;
    });
    return blocked;
}

/// Returns how many facets of a leaf are pierced.
inline std::uint32_t count_in(const Leaf& leaf, const FloatRay& ray, unsigned index, float t_low,
                              float t_high, const ExactTest& exact) {
    const LeafTest test(leaf, ray);
    const HitMask mask(leaf, test.edges, test.interval(), ray, t_low, t_high);
    std::uint32_t pierced = count_bits(mask.certain);
    for (Bits left = mask.uncertain; left; left &= left - 1)
        pierced += exact.counts(exact.query, index, leaf.slot[first_of(left)]);
    return pierced;
}

inline std::uint32_t count(const Tree& tree, const FloatRay& ray, unsigned index, float t_low,
                           float t_high, const ExactTest& exact) {
    std::uint32_t pierced = 0;
    walk<Rays::pierce>(tree, ray, t_high, [&](const Leaf& leaf) {
        pierced += count_in(leaf, ray, index, t_low, t_high, exact);
        return false;
    });
    return pierced;
}

} // namespace hemilux::wide::HEMILUX_KERNELS
