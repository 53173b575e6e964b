// One ray at a time: eight boxes against the ray, eight triangles against the ray.
// No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

/// Covers the relative rounding errors of a slab test.
inline constexpr float slab_slack = 1 + 0x1p-20f;

/// The ray as the box tests take it: a plane p is met at p * inverse + offset.
struct SlabRay {
    float inverse[3], offset[3];
    unsigned octant;
    unsigned near[3], far[3]; ///< where in a node the planes lie that are met first and last

    void set(const FloatRay& ray) {
        octant = octant_of(ray.inverse);
        for (unsigned i = 0; i < 3; ++i) {
            inverse[i] = ray.inverse[i];
            offset[i] = -ray.origin[i] * ray.inverse[i];
            near[i] = width * (2 * i + (ray.inverse[i] < 0));
            far[i] = near[i] ^ width;
        }
    }
};

/// Pushes the children met before t_max.
template <Rays rays>
inline void visit_node(const Node& node, const SlabRay& ray, float t_max, Stack& stack) {
    const auto met_at = [&](const unsigned* place, unsigned axis) {
        return F8::load(node.plane[0] + place[axis]) * F8::splat(ray.inverse[axis]) +
               F8::splat(ray.offset[axis]);
    };
    const F8 enter =
        max(max(met_at(ray.near, 0), met_at(ray.near, 1)), max(met_at(ray.near, 2), F8::splat(0)));
    const F8 leave =
        min(min(met_at(ray.far, 0), met_at(ray.far, 1)), min(met_at(ray.far, 2), F8::splat(t_max)));
    stack.push<rays>(node, ray.octant, enter, leave * F8::splat(slab_slack));
}

/// Depth-first from `root`; leaf(const Leaf&) returns true to stop; t_max may shrink meanwhile.
template <Rays rays, class OnLeaf>
inline void walk(const Tree& tree, std::uint32_t root, const FloatRay& ray, const float& t_max,
                 OnLeaf&& on_leaf) {
    SlabRay slabs;
    slabs.set(ray);
    Stack stack;
    stack.clear();
    std::uint32_t now = root;
    do {
        if ((now & flag) == 0)
            visit_node<rays>(tree.nodes[now], slabs, t_max, stack);
        else if (on_leaf(tree.leaves[now & ~flag]))
            return;
    } while (stack.pop<rays>(t_max * slab_slack, now));
}

inline V3<F8> load3(const float (&p)[3][width]) {
    return {F8::load(p[0]), F8::load(p[1]), F8::load(p[2])};
}

/// A leaf's triangles against one ray.
struct LeafTest {
    V3<F8> a, e1, e2;
    F8 e;
    Sifted<F8> sifted;

    LeafTest(const Leaf& leaf, const FloatRay& ray)
        : a(load3(leaf.corner) - V3<F8>::splat(ray.origin)), e1(load3(leaf.edge1)),
          e2(load3(leaf.edge2)), e(max(max_abs(e1), max_abs(e2))), sifted(sift(ray)) {}

    [[nodiscard]] Interval<F8> interval() const { return {sifted, dot(a, cross(e1, e2)), e}; }

  private:
    [[nodiscard]] Sifted<F8> sift(const FloatRay& ray) const {
        const V3<F8> d = V3<F8>::splat(ray.direction);
        const V3<F8> q = cross(a, d); // U = e2.(A x d), W = -e1.(A x d)
        return {dot(e2, q), F8::splat(0) - dot(e1, q), dot(d, cross(e1, e2)), error_bound(a, e)};
    }
};

/// The slots in `maybe`, one by one: visit(slot, low, high, known, inside, front), true to stop.
/// `known`: low and high bound t; `inside`: the ray surely passes within the edges.
template <class Visit>
inline void visit_slots(const Leaf& leaf, const Sifted<F8>& sifted, const Interval<F8>& t,
                        Bits maybe, std::uint32_t from, Visit&& visit) {
    const Bits inside = sifted.inside(), front = sifted.front();
    alignas(64) float low[width], high[width];
    t.low.store(low);
    t.high.store(high);
    for (; maybe; maybe &= maybe - 1) {
        const unsigned k = first_of(maybe);
        const Bits bit = Bits{1} << k;
        if ((leaf.slot[k] & ~flag) != from)
            if (visit(leaf.slot[k], low[k], high[k], (t.known & bit) != 0, (inside & bit) != 0,
                      (front & bit) != 0))
                return;
    }
}

/// The slots of a leaf that a ray may strike.
template <class Visit>
inline void sift_leaf(const Leaf& leaf, const FloatRay& ray, Visit&& visit) {
    const LeafTest test(leaf, ray);
    if (const Bits maybe = test.sifted.maybe())
        visit_slots(leaf, test.sifted, test.interval(), maybe, ray.from, visit);
}

/// A slot that may be struck against the nearest so far.
inline void consider(std::uint32_t slot, float low, float high, bool known, bool inside, bool front,
                     const FloatRay& ray, unsigned index, Nearest& nearest, const Judge& judge) {
    if (known && (low > nearest.high || high < ray.t_min_low))
        return;
    if (inside && known && low > ray.t_min_high && high < nearest.low)
        nearest = {low, high, slot, front};
    else if (nearest.slot == no_facet || ((slot ^ nearest.slot) & ~flag) != 0)
        judge.closer(judge.query, index, slot, nearest);
}

inline void closest_from(const Tree& tree, std::uint32_t root, const FloatRay& ray, unsigned index,
                         Nearest& nearest, const Judge& judge) {
    walk<Rays::stop>(tree, root, ray, nearest.high, [&](const Leaf& leaf) {
        sift_leaf(
            leaf, ray,
            [&](std::uint32_t slot, float low, float high, bool known, bool inside, bool front) {
                consider(slot, low, high, known, inside, front, ray, index, nearest, judge);
                return false;
            });
        return false;
    });
}

inline void closest(const Tree& tree, const FloatRay& ray, unsigned index, Nearest& nearest,
                    const Judge& judge) {
    closest_from(tree, tree.root, ray, index, nearest, judge);
}

/// Whether anything in a leaf but `target` is struck before t.
inline bool blocks(const Leaf& leaf, const FloatRay& ray, unsigned index, float t_low, float t_high,
                   std::uint32_t target, const Judge& judge) {
    bool blocked = false;
    sift_leaf(leaf, ray,
              [&](std::uint32_t slot, float low, float high, bool known, bool inside, bool) {
                  if ((slot & ~flag) == target || (known && (low > t_high || high < ray.t_min_low)))
                      return false;
                  blocked = (inside && known && low > ray.t_min_high && high < t_low) ||
                            judge.struck(judge.query, index, slot);
                  return blocked;
              });
    return blocked;
}

inline bool occluded(const Tree& tree, const FloatRay& ray, unsigned index, float t_low,
                     float t_high, std::uint32_t target, const Judge& judge) {
    bool blocked = false;
    walk<Rays::stop>(tree, tree.root, ray, t_high, [&](const Leaf& leaf) {
        blocked = blocks(leaf, ray, index, t_low, t_high, target, judge);
        return blocked;
    });
    return blocked;
}

/// Whether a slot that may be struck counts.
inline bool pierces(std::uint32_t slot, float low, float high, bool known, bool inside, bool,
                    const FloatRay& ray, unsigned index, float t_low, float t_high,
                    const Judge& judge) {
    if (known && (low > t_high || high < ray.t_min_low))
        return false;
    return (inside && known && low > ray.t_min_high && high < t_low) ||
           judge.counts(judge.query, index, slot);
}

/// How many facets of a leaf are pierced.
inline std::uint32_t count_in(const Leaf& leaf, const FloatRay& ray, unsigned index, float t_low,
                              float t_high, const Judge& judge) {
    std::uint32_t pierced = 0;
    sift_leaf(leaf, ray, [&](auto... told) {
        pierced += pierces(told..., ray, index, t_low, t_high, judge);
        return false;
    });
    return pierced;
}

inline std::uint32_t count_from(const Tree& tree, std::uint32_t root, const FloatRay& ray,
                                unsigned index, float t_low, float t_high, const Judge& judge) {
    std::uint32_t pierced = 0;
    walk<Rays::pierce>(tree, root, ray, t_high, [&](const Leaf& leaf) {
        pierced += count_in(leaf, ray, index, t_low, t_high, judge);
        return false;
    });
    return pierced;
}

inline std::uint32_t count(const Tree& tree, const FloatRay& ray, unsigned index, float t_low,
                           float t_high, const Judge& judge) {
    return count_from(tree, tree.root, ray, index, t_low, t_high, judge);
}

} // namespace hemilux::wide::HEMILUX_KERNELS
