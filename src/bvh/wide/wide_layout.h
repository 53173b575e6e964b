#pragma once
// The memory layout of the wide tree and of what its kernels take. Plain data only: this header is
// compiled with several instruction sets, so it may define no function that the linker could merge.
//
// The kernels see the scene in floats, scaled into [-1,1]^3, and only *filter*: with bounds on
// every rounding error they say "certainly missed", "certainly hit" or "uncertain". What is
// uncertain is decided in doubles by the same code as in the scalar BVH. So all engines,
// instruction sets and forms of a question give the same answers to the last bit, and the filter's
// arithmetic is free.

#include <cstdint>

namespace hemilux::wide {

/// The kernels' error bound (kernels/conservative_test.h) is the first times E (|A| + E + the
/// second (|A| + |O|)). E is the largest component of a triangle's edges, A is its corner as seen
/// from the ray's origin O. So a scene that is a hundredth of its bounds, as a sun or a sky makes
/// it, is seen as sharply as any.
inline constexpr float error_share = 80 * 0x1p-24f, error_offset = 0.15f;

inline constexpr unsigned width = 8;
inline constexpr std::uint32_t no_facet = 0xffffffffu;
inline constexpr std::uint32_t flag = 0x80000000u; ///< child: a leaf; slot: second half of a quad

/// An inner node. Planes are ordered low x, high x, low y, high y, low z, high z. An absent child's
/// box is inverted, so that nothing meets it. The others are in the order of their surfaces, the
/// largest last.
struct alignas(64) Node {
    float plane[6][width];
    std::uint32_t child[width]; ///< index of a node, or of a leaf with `flag`
    /// The children for each octant of directions (bit i: component i is negative), four bits each,
    /// the one to be visited last in the lowest.
    std::uint32_t order[width];
};

/// Up to eight triangles: one corner and the two edges from it. Unused slots have edges of zero,
/// which no ray strikes; slots with edges of NaN are always uncertain.
struct alignas(64) Leaf {
    float corner[3][width], edge1[3][width], edge2[3][width];
    std::uint32_t slot[width]; ///< facet, with `flag` for the second half of a quad
};

struct Tree {
    const Node* nodes; ///< the first is the root
    const Leaf* leaves;
    bool large; ///< does not fit the cache of a core, so what is needed next is fetched ahead
};

/// The depth of the deepest tree that the builder makes, and the most entries that a depth-first
/// walk through it can have pending.
inline constexpr unsigned max_depth = 40;
inline constexpr unsigned stack_size = (width - 1) * max_depth + 1;

/// A ray as the box tests see it: a plane p is met at p * inverse + offset.
struct SlabRay {
    using Byte = unsigned char; // so that a state's head fits a line of the cache

    float inverse[3], offset[3]; ///< never infinite
    Byte octant;                 ///< bit i: component i of the direction is negative
    Byte near[3], far[3];        ///< places in a node of the planes met first and last
};

/// A ray as the kernels see it: |component of direction| <= 1 and the largest at least 1/2.
struct FloatRay {
    SlabRay slabs;
    float origin[3], direction[3];
    float reach;                 ///< bounds the components of the origin and of what it may be off
    float t_min_low, t_min_high; ///< certain bounds
    std::uint32_t from;
};

/// No ray meets anything at this distance in scaled units or farther.
inline constexpr float farthest = 16;

/// Certain bounds of the nearest distance so far, in scaled units, and the slot that it belongs to.
struct Nearest {
    float low, high;
    std::uint32_t slot;
    std::uint32_t front;
};

/// The slot that a ray hits first; no_facet: none.
struct FirstHit {
    std::uint32_t slot, front;
};

/// The rays of a query, and what decides in doubles what the kernels are uncertain of. `ray` counts
/// within the query.
struct RayQuery {
    void* query;
    /// Sets a ray and the bounds of its farthest distance; returns false if it hits nothing or if
    /// it is one that the kernels cannot trace.
    bool (*load)(void* query, unsigned ray, FloatRay&, Nearest& end);
    /// Updates `nearest` with a slot that may be hit.
    void (*closer)(void* query, unsigned ray, std::uint32_t slot, Nearest& nearest);
    /// Return whether a slot is hit (inclusive edges), and whether it counts (half-open edges).
    bool (*hits)(void* query, unsigned ray, std::uint32_t slot);
    bool (*counts)(void* query, unsigned ray, std::uint32_t slot);
};

/// The kernels of one instruction set. Those of one ray take it loaded; the streams load `count`
/// rays themselves, answer for ray k in element k, and leave what belongs to others as it is.
struct Kernels {
    void (*closest)(const Tree&, const FloatRay&, Nearest&, const RayQuery&);
    bool (*occluded)(const Tree&, const FloatRay&, const Nearest& end, std::uint32_t target,
                     const RayQuery&);
    std::uint32_t (*count)(const Tree&, const FloatRay&, const Nearest& end, const RayQuery&);
    void (*closest_stream)(const Tree&, const RayQuery&, unsigned count, FirstHit*);
    /// blocked[k] becomes 1 where anything but targets[k] is hit.
    void (*occluded_stream)(const Tree&, const RayQuery&, unsigned count,
                            const std::uint32_t* targets, std::uint8_t* blocked);
    /// pierced[k] grows by the number of facets on the ray.
    void (*count_stream)(const Tree&, const RayQuery&, unsigned count, std::uint32_t* pierced);
};

} // namespace hemilux::wide
