// Many independent rays in turn, a step of each: while one waits for memory or for a chain of
// operations, the others go on. Steps through nodes and through leaves are done in turns, and what
// follows from them in loops of its own. So the processor can foresee the branches, and finds many
// states within its window. No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned rays_in_flight = 48;

/// A ray on its way. What its steps through nodes need lies in one line of the cache.
struct alignas(64) RayState {
    std::uint32_t index;  ///< index of the ray in the stream
    std::uint32_t next;   ///< node or leaf to be visited; no_facet: the ray is done
    std::uint32_t target; ///< facet that does not stop it
    Nearest nearest;      ///< the end of the ray, which may come closer
    FloatRay ray;
    Stack stack;
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
            const char* place = place_of(tree, done ? 0 : next);
            for (unsigned line = 0; line < sizeof(Node); line += 64)
                __builtin_prefetch(place + line);
            __builtin_prefetch(place + (node ? 0 : sizeof(Leaf) - 64));
        }
        nodes.add_if(node, &state);
        leaves.add_if(!node && !done, &state);
        idle.add_if(done, &state);
    }
};

/// Sends the rays of a query through the tree. begin(state) completes the state of one that begins.
/// test(state, leaf) may bring its end closer, and returns what it found; then use(state, leaf,
/// found) returns true when the ray is done.
template <Rays rays, class Found, class Begin, class Test, class Use>
inline void traverse_interleaved(const Tree& tree, const RayQuery& query, unsigned count,
                                 const Begin& begin, const Test& test, const Use& use) {
    RayState states[rays_in_flight];
    Queues queues{tree, {}, {}, {}};
    for (RayState& state : states)
        queues.idle.add_if(true, &state);
    for (unsigned started = 0;;) {
        const unsigned idle = queues.idle.empty();
        for (unsigned i = 0; i < idle && started < count; ++started)
            if (RayState& state = *queues.idle.state[i];
                query.load(query.query, started, state.ray, state.nearest)) {
                state.index = started;
                state.next = 0; // the root
                state.stack.clear();
                begin(state);
                queues.add(state);
                ++i;
            }
        if (queues.nodes.size + queues.leaves.size == 0)
            return;
        for (unsigned i = 0; i < queues.nodes.size; ++i) {
            RayState& state = *queues.nodes.state[i];
            visit_node<rays>(tree.nodes[state.next], state.ray.slabs, state.nearest.high,
                             state.stack);
        }
        const unsigned at_nodes = queues.nodes.empty();
        for (unsigned i = 0; i < at_nodes; ++i) {
            RayState& state = *queues.nodes.state[i];
            state.next = state.stack.pop();
            queues.add(state);
        }
        if (queues.nodes.size > queues.leaves.size)
            continue;
        const auto leaf_of = [&](const RayState& state) -> const Leaf& {
            return tree.leaves[state.next & ~flag];
        };
        Found found[rays_in_flight];
        const unsigned at_leaves = queues.leaves.empty();
        for (unsigned i = 0; i < at_leaves; ++i) {
            RayState& state = *queues.leaves.state[i];
            found[i] = test(state, leaf_of(state));
        }
        for (unsigned i = 0; i < at_leaves; ++i) {
            RayState& state = *queues.leaves.state[i];
            const bool done = use(state, leaf_of(state), found[i]);
            const std::uint32_t next =
                state.stack.pop_before<rays>(state.nearest.high * slab_slack);
            state.next = done ? no_facet : next;
            queues.add(state);
        }
    }
}

inline void closest_stream(const Tree& tree, const RayQuery& query, unsigned count,
                           FirstHit* hits) {
    struct Nothing {};
    traverse_interleaved<Rays::stop, Nothing>(
        tree, query, count, [](RayState&) {},
        [&](RayState& state, const Leaf& leaf) {
            closest_in(leaf, state.ray, query, state.index, state.nearest);
            return Nothing{};
        },
        [&](RayState& state, const Leaf&, Nothing) {
            hits[state.index] = {state.nearest.slot, state.nearest.front};
            return false;
        });
}

inline void occluded_stream(const Tree& tree, const RayQuery& query, unsigned count,
                            const std::uint32_t* targets, std::uint8_t* blocked) {
    traverse_interleaved<Rays::pierce, HitMask>(
        tree, query, count, [&](RayState& state) { state.target = targets[state.index]; },
        [](RayState& state, const Leaf& leaf) {
            return hits_before(leaf, state.ray, state.nearest, state.target);
        },
        [&](RayState& state, const Leaf& leaf, const HitMask& mask) {
            return (blocked[state.index] = blocks(mask, leaf, query, state.index)) != 0;
        });
}

inline void count_stream(const Tree& tree, const RayQuery& query, unsigned count,
                         std::uint32_t* pierced) {
    traverse_interleaved<Rays::pierce, HitMask>(
        tree, query, count, [](RayState& state) { state.target = no_facet; },
        [](RayState& state, const Leaf& leaf) {
            return hits_before(leaf, state.ray, state.nearest, state.target);
        },
        [&](RayState& state, const Leaf& leaf, const HitMask& mask) {
            pierced[state.index] += count_in(mask, leaf, query, state.index);
            return false;
        });
}

} // namespace hemilux::wide::HEMILUX_KERNELS
