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

    void start(const FloatRay& of, std::uint32_t index_, float t_max_) {
        ray = &of;
        slabs.set(of);
        index = index_;
        next = 0;
        t_max = t_max_;
        stack.clear();
    }
    bool pop() { return stack.pop(t_max * slab_slack, next); }
};

inline void prefetch(const Tree& tree, std::uint32_t child) {
    const char* at = child & flag ? reinterpret_cast<const char*>(tree.leaves + (child & ~flag))
                                  : reinterpret_cast<const char*>(tree.nodes + child);
    for (unsigned line = 0; line < sizeof(Leaf); line += 64)
        __builtin_prefetch(at + line);
}

/// Walkers by what they do next.
struct Queue {
    std::uint32_t walker[wave_size];
    unsigned size = 0;
    void add_if(bool is_mine, std::uint32_t w) {
        walker[size] = w;
        size += is_mine;
    }
};

/// Sends all rays through the tree. t_max(k) is where ray k ends; on_leaf(walker, leaf) may shrink
/// walker.t_max and returns true when the ray is done.
template <class TMax, class OnLeaf>
inline void wave(const Tree& tree, const FloatRay* rays, unsigned count, const TMax& t_max,
                 const OnLeaf& on_leaf) {
    Walker walkers[wave_size];
    Queue nodes, leaves;
    unsigned started = 0;
    // Puts a walker into the queue of its next visit, or lets it begin with the next ray.
    const auto send_on = [&](std::uint32_t w, bool more, Queue& to_nodes) {
        Walker& walker = walkers[w];
        if (!more) {
            if (started == count)
                return;
            walker.start(rays[started], started, t_max(started));
            ++started;
        }
        const bool leaf = (walker.next & flag) != 0;
        prefetch(tree, walker.next);
        to_nodes.add_if(!leaf, w);
        leaves.add_if(leaf, w);
    };
    for (std::uint32_t w = 0; w < wave_size; ++w)
        send_on(w, false, nodes);
    while (nodes.size + leaves.size > 0) {
        Queue again;
        for (unsigned i = 0; i < nodes.size; ++i) {
            Walker& walker = walkers[nodes.walker[i]];
            visit_node(tree.nodes[walker.next], walker.slabs, walker.t_max, walker.stack);
            send_on(nodes.walker[i], walker.pop(), again);
        }
        nodes = again;
        if (nodes.size > leaves.size)
            continue;
        const Queue visited = leaves;
        leaves.size = 0;
        for (unsigned i = 0; i < visited.size; ++i) {
            Walker& walker = walkers[visited.walker[i]];
            const bool done = on_leaf(walker, tree.leaves[walker.next & ~flag]);
            send_on(visited.walker[i], !done && walker.pop(), nodes);
        }
    }
}

inline void closest_stream(const Tree& tree, const FloatRay* rays, unsigned count, Nearest* nearest,
                           const Judge& judge) {
    wave(
        tree, rays, count, [&](unsigned k) { return nearest[k].high; },
        [&](Walker& walker, const Leaf& leaf) {
            const unsigned k = walker.index;
            sift_leaf(leaf, *walker.ray,
                      [&](std::uint32_t slot, float low, float high, bool known, bool inside,
                          bool front) {
                          consider(slot, low, high, known, inside, front, *walker.ray, k,
                                   nearest[k], judge);
                          return false;
                      });
            walker.t_max = nearest[k].high;
            return false;
        });
}

inline void occluded_stream(const Tree& tree, const FloatRay* rays, unsigned count,
                            const Nearest* t, const std::uint32_t* targets, std::uint8_t* blocked,
                            const Judge& judge) {
    for (unsigned k = 0; k < count; ++k)
        blocked[k] = 0;
    wave(
        tree, rays, count, [&](unsigned k) { return t[k].high; },
        [&](Walker& walker, const Leaf& leaf) {
            const unsigned k = walker.index;
            blocked[k] = blocks(leaf, *walker.ray, k, t[k].low, t[k].high, targets[k], judge);
            return blocked[k] != 0;
        });
}

} // namespace hemilux::wide::HEMILUX_KERNELS
