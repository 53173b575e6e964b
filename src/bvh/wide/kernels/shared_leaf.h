// A leaf against rays from one origin: a triangle's test is three dot products with the direction.
// Either sixteen rays against one triangle, or eight triangles against one ray.
// No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline constexpr unsigned few_in_leaf = 8; ///< rays that are held against eight triangles at once

/// What eight triangles have in common for all rays of the packet.
struct alignas(64) SharedLeaf {
    float u[3][width], w[3][width], d[3][width]; ///< normals: U, W, D are their dots with d
    float volume[width], error[width], size[width];

    SharedLeaf(const Leaf& leaf, const float* origin) {
        const V3<F8> a = load3(leaf.corner) - V3<F8>::splat(origin);
        const V3<F8> e1 = load3(leaf.edge1), e2 = load3(leaf.edge2);
        const F8 e = max(max_abs(e1), max_abs(e2));
        const V3<F8> n = cross(e1, e2);
        store3(cross(e2, a), u);
        store3(cross(a, e1), w);
        store3(n, d);
        dot(a, n).store(volume);
        error_bound(a, e).store(error);
        e.store(size);
    }
    static void store3(V3<F8> v, float (&to)[3][width]) {
        v.x.store(to[0]);
        v.y.store(to[1]);
        v.z.store(to[2]);
    }
    /// One triangle against all rays.
    [[nodiscard]] Sifted<F16> sift(unsigned k, const V3<F16>& direction) const {
        const auto along = [&](const float(&normal)[3][width]) {
            return dot(V3<F16>{F16::splat(normal[0][k]), F16::splat(normal[1][k]),
                               F16::splat(normal[2][k])},
                       direction);
        };
        return {along(u), along(w), along(d), F16::splat(error[k])};
    }
    /// All triangles against one ray.
    [[nodiscard]] Sifted<F8> sift(const float* direction) const {
        const V3<F8> along = V3<F8>::splat(direction);
        return {dot(load3(u), along), dot(load3(w), along), dot(load3(d), along), F8::load(error)};
    }
};

/// The triangles of a leaf, each with the lanes that may strike it: visit(k, sifted, lanes).
template <class Visit>
inline void sift_packet(const Leaf& leaf, const SharedLeaf& shared, const Packet& packet,
                        Bits lanes, Visit&& visit) {
    const V3<F16> direction = load16(packet.direction);
    Bits maybe[width], hit = 0;
    for (unsigned k = 0; k < width; ++k) {
        maybe[k] = shared.sift(k, direction).maybe() & lanes;
        hit |= Bits{maybe[k] != 0} << k;
    }
    for (; hit; hit &= hit - 1) {
        const unsigned k = first_of(hit);
        if ((leaf.slot[k] & ~flag) != packet.from)
            visit(k, shared.sift(k, direction), maybe[k]);
    }
}

/// The same where few lanes are left: visit(lane, sifted, t).
template <class Visit>
inline void sift_lanes(const SharedLeaf& shared, const Packet& packet, Bits lanes, Visit&& visit) {
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = first_of(lanes);
        const float direction[3] = {packet.direction[0][lane], packet.direction[1][lane],
                                    packet.direction[2][lane]};
        const Sifted<F8> sifted = shared.sift(direction);
        visit(lane, sifted, Interval<F8>(sifted, F8::load(shared.volume), F8::load(shared.size)));
    }
}

} // namespace hemilux::wide::HEMILUX_KERNELS
