// Many independent rays in turn, a step of each: while one waits for memory or for a chain of
// operations, the others go on. Steps through nodes and through leaves are done in turns, so that
// the processor can foresee the branches. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned wave_size = 32;

/// A ray on its way.
struct alignas(64) Walker {
    SlabRay slabs;
    const FloatRay* ray;
    std::uint32_t index; ///< of the ray in the stream
    std::uint32_t next;  ///< node or leaf to be visited
    float t_max;         ///< shrinks
    Stack stack;

    void take(const FloatRay& of, std::uint32_t index_, float t_max_, std::uint32_t root) {
        ray = &of;
        slabs.set(of);
        index = index_;
        next = root;
        t_max = t_max_;
        stack.clear();
    }
    template <Rays rays>
    bool pop() {
        return stack.pop<rays>(t_max * slab_slack, next);
    }
};

/// Where a node or leaf lies, without a branch on which it is.
inline const char* place_of(const Tree& tree, std::uint32_t child) {
    const char* const base[2] = {reinterpret_cast<const char*>(tree.nodes),
                                 reinterpret_cast<const char*>(tree.leaves)};
    constexpr unsigned long size[2] = {sizeof(Node), sizeof(Leaf)};
    const unsigned is_leaf = child >> 31;
    return base[is_leaf] + size[is_leaf] * (child & ~flag);
}

/// Walkers by what they do next.
struct Queue {
    Walker* walker[wave_size];
    unsigned size = 0;
    void add_if(bool is_mine, Walker* w) {
        walker[size] = w;
        size += is_mine;
    }
};

/// Sends rays through the tree. begin(walker) makes it the next ray and returns false when there is
/// none; on_leaf(walker, leaf) may shrink walker.t_max and returns true when the ray is done.
template <Rays rays, class Begin, class OnLeaf>
inline void wave(const Tree& tree, const Begin& begin, const OnLeaf& on_leaf) {
    Walker walkers[wave_size];
    Queue nodes, leaves;
    // Puts a walker into the queue of its next visit, or lets it begin with the next ray.
    const auto send_on = [&](Walker& walker, bool more, Queue& to_nodes) {
        if (!more && !begin(walker))
            return;
        const bool leaf = (walker.next & flag) != 0;
        if (tree.large) { // not in a function of its own: g++ 12 takes that for one without effect
            const char* place = place_of(tree, walker.next);
            for (unsigned line = 0; line < sizeof(Leaf); line += 64)
                __builtin_prefetch(place + line);
        }
        to_nodes.add_if(!leaf, &walker);
        leaves.add_if(leaf, &walker);
    };
    for (Walker& walker : walkers)
        send_on(walker, false, nodes);
    while (nodes.size + leaves.size > 0) {
        Queue again;
        for (unsigned i = 0; i < nodes.size; ++i) {
            Walker& walker = *nodes.walker[i];
            visit_node<rays>(tree.nodes[walker.next], walker.slabs, walker.t_max, walker.stack);
            send_on(walker, walker.pop<rays>(), again);
        }
        nodes = again;
        if (nodes.size > leaves.size)
            continue;
        const Queue visited = leaves;
        leaves.size = 0;
        for (unsigned i = 0; i < visited.size; ++i) {
            Walker& walker = *visited.walker[i];
            const bool done = on_leaf(walker, tree.leaves[walker.next & ~flag]);
            send_on(walker, !done && walker.pop<rays>(), nodes);
        }
    }
}

/// Begins one ray of an array after the other, at the root.
struct FromArray {
    const FloatRay* rays;
    unsigned count;
    const Nearest* nearest;
    std::uint32_t root;
    unsigned& started;

    bool operator()(Walker& walker) const {
        if (started == count)
            return false;
        walker.take(rays[started], started, nearest[started].high, root);
        ++started;
        return true;
    }
};

/// A leaf against one ray of many.
inline void closest_in(const Leaf& leaf, const FloatRay& ray, unsigned index, Nearest& nearest,
                       const Judge& judge) {
    sift_leaf(leaf, ray,
              [&](std::uint32_t slot, float low, float high, bool known, bool inside, bool front) {
                  consider(slot, low, high, known, inside, front, ray, index, nearest, judge);
                  return false;
              });
}

inline void closest_stream(const Tree& tree, const FloatRay* rays, unsigned count, Nearest* nearest,
                           const Judge& judge) {
    unsigned started = 0;
    wave<Rays::stop>(tree, FromArray{rays, count, nearest, tree.root, started},
                     [&](Walker& walker, const Leaf& leaf) {
                         closest_in(leaf, *walker.ray, walker.index, nearest[walker.index], judge);
                         walker.t_max = nearest[walker.index].high;
                         return false;
                     });
}

inline void occluded_stream(const Tree& tree, const FloatRay* rays, unsigned count,
                            const Nearest* t, const std::uint32_t* targets, std::uint8_t* blocked,
                            const Judge& judge) {
    for (unsigned k = 0; k < count; ++k)
        blocked[k] = 0;
    unsigned started = 0;
    wave<Rays::stop>(
        tree, FromArray{rays, count, t, tree.root, started}, [&](Walker& walker, const Leaf& leaf) {
            const unsigned k = walker.index;
            blocked[k] = blocks(leaf, *walker.ray, k, t[k].low, t[k].high, targets[k], judge);
            return blocked[k] != 0;
        });
}

} // namespace hemilux::wide::HEMILUX_KERNELS
