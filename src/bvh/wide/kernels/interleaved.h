// Many independent rays in turn, a step of each: while one waits for memory or for a chain of
// operations, the others go on. Steps through nodes and through leaves are done in turns, and what
// follows from them in loops of its own. So the processor can foresee the branches, and finds many
// states within its window. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned rays_in_flight = 48;

/// A ray on its way.
struct alignas(64) RayState {
    SlabRay slabs;
    const FloatRay* ray;
    std::uint32_t index; ///< index of the ray in the stream
    std::uint32_t next;  ///< node or leaf to be visited; no_facet: the ray is done
    float t_max;         ///< shrinks
    Stack stack;
    alignas(64) char unused; ///< a line of the cache

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
/// With an even number of lines the states would crowd in a few sets of the cache.
static_assert(sizeof(RayState) / 64 % 2 == 1);

/// Returns where a node or leaf lies, without a branch on which of the two it is.
inline const char* place_of(const Tree& tree, std::uint32_t child) {
    const char* const base[2] = {reinterpret_cast<const char*>(tree.nodes),
                                 reinterpret_cast<const char*>(tree.leaves)};
    constexpr unsigned long size[2] = {sizeof(Node), sizeof(Leaf)};
    const unsigned is_leaf = child >> 31;
    return base[is_leaf] + size[is_leaf] * (child & ~flag);
}

/// A list of ray states by what they do next.
struct Queue {
    RayState* state[rays_in_flight];
    unsigned size = 0;
    void add_if(bool is_mine, RayState* w) {
        state[size] = w;
        size += is_mine;
    }
    /// Empties the queue; returns how many states it held. They may still be read one after the
    /// other, as long as no more are added than have been read.
    unsigned empty() {
        const unsigned held = size;
        size = 0;
        return held;
    }
};

/// All states, by what they do next.
struct Queues {
    const Tree& tree;
    Queue nodes, leaves, idle;

    void add(RayState& state) {
        const std::uint32_t next = state.next;
        const bool node = (next & flag) == 0, done = next == no_facet;
        if (tree.large) {
            const char* place = place_of(tree, done ? tree.root : next);
            for (unsigned line = 0; line < sizeof(Node); line += 64)
                __builtin_prefetch(place + line);
            __builtin_prefetch(place + (node ? 0 : sizeof(Leaf) - 64));
        }
        nodes.add_if(node, &state);
        leaves.add_if(!node && !done, &state);
        idle.add_if(done, &state);
    }
};

/// Sends rays through the tree. begin(state) makes it the next ray and returns false when there is
/// none. on_leaf(state, leaf) may shrink state.t_max and returns true when the ray is done.
template <Rays rays, class Begin, class OnLeaf>
inline void traverse_interleaved(const Tree& tree, const Begin& begin, const OnLeaf& on_leaf) {
    RayState states[rays_in_flight];
    Queues queues{tree, {}, {}, {}};
    for (RayState& state : states)
        queues.idle.add_if(true, &state);
    for (;;) {
        const unsigned idle = queues.idle.empty();
        for (unsigned i = 0; i < idle; ++i)
            if (RayState& state = *queues.idle.state[i]; begin(state))
                queues.add(state);
        if (queues.nodes.size + queues.leaves.size == 0)
            return;
        for (unsigned i = 0; i < queues.nodes.size; ++i) {
            RayState& state = *queues.nodes.state[i];
            visit_node<rays>(tree.nodes[state.next], state.slabs, state.t_max, state.stack);
        }
        const unsigned at_nodes = queues.nodes.empty();
        for (unsigned i = 0; i < at_nodes; ++i) {
            RayState& state = *queues.nodes.state[i];
            state.next = state.stack.pop();
            queues.add(state);
        }
        if (queues.nodes.size > queues.leaves.size)
            continue;
        for (unsigned i = 0; i < queues.leaves.size; ++i) {
            RayState& state = *queues.leaves.state[i];
            if (on_leaf(state, tree.leaves[state.next & ~flag]))
                state.stack.clear();
        }
        const unsigned at_leaves = queues.leaves.empty();
        for (unsigned i = 0; i < at_leaves; ++i) {
            RayState& state = *queues.leaves.state[i];
            state.pop_before_end<rays>();
            queues.add(state);
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

    bool operator()(RayState& state) const {
        if (started == count)
            return false;
        state.take(rays[started], started, nearest[started].high, root);
        ++started;
        return true;
    }
};

inline void closest_stream(const Tree& tree, const FloatRay* rays, unsigned count, Nearest* nearest,
                           const ExactTest& exact) {
    unsigned started = 0;
    traverse_interleaved<Rays::stop>(tree, FromArray{rays, count, nearest, tree.root, started},
                                     [&](RayState& state, const Leaf& leaf) {
                                         closest_in(leaf, *state.ray, state.index,
                                                    nearest[state.index], exact);
                                         state.t_max = nearest[state.index].high;
                                         return false;
                                     });
}

inline void occluded_stream(const Tree& tree, const FloatRay* rays, unsigned count,
                            const Nearest* t, const std::uint32_t* targets, std::uint8_t* blocked,
                            const ExactTest& exact) {
    for (unsigned k = 0; k < count; ++k)
        blocked[k] = 0;
    unsigned started = 0;
    traverse_interleaved<Rays::pierce>(tree, FromArray{rays, count, t, tree.root, started},
                                       [&](RayState& state, const Leaf& leaf) {
                                           const unsigned k = state.index;
                                           blocked[k] = blocks(leaf, *state.ray, k, t[k].low,
                                                               t[k].high, targets[k], exact);
                                           return blocked[k] != 0;
                                       });
}

inline void count_stream(const Tree& tree, const FloatRay* rays, unsigned count, const Nearest* t,
                         std::uint32_t* pierced, const ExactTest& exact) {
    for (unsigned k = 0; k < count; ++k)
        pierced[k] = 0;
    unsigned started = 0;
    traverse_interleaved<Rays::pierce>(tree, FromArray{rays, count, t, tree.root, started},
                                       [&](RayState& state, const Leaf& leaf) {
                                           const unsigned k = state.index;
                                           pierced[k] += count_in(leaf, *state.ray, k, t[k].low,
                                                                  t[k].high, exact);
                                           return false;
                                       });
}

} // namespace hemilux::wide::HEMILUX_KERNELS
