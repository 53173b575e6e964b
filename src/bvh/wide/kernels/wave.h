// Many independent rays in turn, a step of each: while one waits for memory or for a chain of
// operations, the others go on. Steps through nodes and through leaves are done in turns, and what
// follows from them in loops of its own: so the processor can foresee the branches, and finds many
// walkers within its window. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned wave_size = 48;

/// A ray on its way.
struct alignas(64) Walker {
    SlabRay slabs;
    const FloatRay* ray;
    std::uint32_t index; ///< of the ray in the stream
    std::uint32_t next;  ///< node or leaf to be visited; no_facet: the ray is done
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
    void pop_before_end() {
        next = stack.pop_before<rays>(t_max * slab_slack);
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
    /// Empties the queue; returns how many it held. They may still be read one after the other
    /// while no more than have been read are added.
    unsigned empty() {
        const unsigned held = size;
        size = 0;
        return held;
    }
};

/// All walkers, by what they do next.
struct Queues {
    const Tree& tree;
    Queue nodes, leaves, idle;

    void add(Walker& walker) {
        const std::uint32_t next = walker.next;
        const bool node = (next & flag) == 0, done = next == no_facet;
        if (tree.large) {
            const char* place = place_of(tree, done ? tree.root : next);
            for (unsigned line = 0; line < sizeof(Node); line += 64)
                __builtin_prefetch(place + line);
            __builtin_prefetch(place + (node ? 0 : sizeof(Leaf) - 64));
        }
        nodes.add_if(node, &walker);
        leaves.add_if(!node && !done, &walker);
        idle.add_if(done, &walker);
    }
};

/// Sends rays through the tree. begin(walker) makes it the next ray and returns false when there is
/// none; on_leaf(walker, leaf) may shrink walker.t_max and returns true when the ray is done.
template <Rays rays, class Begin, class OnLeaf>
inline void wave(const Tree& tree, const Begin& begin, const OnLeaf& on_leaf) {
    Walker walkers[wave_size];
    Queues queues{tree, {}, {}, {}};
    for (Walker& walker : walkers)
        queues.idle.add_if(true, &walker);
    for (;;) {
        const unsigned idle = queues.idle.empty();
        for (unsigned i = 0; i < idle; ++i)
            if (Walker& walker = *queues.idle.walker[i]; begin(walker))
                queues.add(walker);
        if (queues.nodes.size + queues.leaves.size == 0)
            return;
        for (unsigned i = 0; i < queues.nodes.size; ++i) {
            Walker& walker = *queues.nodes.walker[i];
            visit_node<rays>(tree.nodes[walker.next], walker.slabs, walker.t_max, walker.stack);
        }
        const unsigned at_nodes = queues.nodes.empty();
        for (unsigned i = 0; i < at_nodes; ++i) {
            Walker& walker = *queues.nodes.walker[i];
            walker.next = walker.stack.pop();
            queues.add(walker);
        }
        if (queues.nodes.size > queues.leaves.size)
            continue;
        for (unsigned i = 0; i < queues.leaves.size; ++i) {
            Walker& walker = *queues.leaves.walker[i];
            if (on_leaf(walker, tree.leaves[walker.next & ~flag]))
                walker.stack.clear();
        }
        const unsigned at_leaves = queues.leaves.empty();
        for (unsigned i = 0; i < at_leaves; ++i) {
            Walker& walker = *queues.leaves.walker[i];
            walker.pop_before_end<rays>();
            queues.add(walker);
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
    wave<Rays::pierce>(
        tree, FromArray{rays, count, t, tree.root, started}, [&](Walker& walker, const Leaf& leaf) {
            const unsigned k = walker.index;
            blocked[k] = blocks(leaf, *walker.ray, k, t[k].low, t[k].high, targets[k], judge);
            return blocked[k] != 0;
        });
}

} // namespace hemilux::wide::HEMILUX_KERNELS
