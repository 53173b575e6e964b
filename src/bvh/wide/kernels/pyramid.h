// A pyramid around rays from one origin, and boxes against it: eight at once.
// No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

inline V3<F16> load16(const float (&p)[3][packet_size]) {
    return {F16::load(p[0]), F16::load(p[1]), F16::load(p[2])};
}

/// Four planes through the origin that hold all rays between them. If the rays go too far apart,
/// all boxes lie within, but not those of absent children, which are infinitely far away.
struct Pyramid {
    float normal[4][3];     ///< outward
    unsigned nearest[4][3]; ///< which planes of a box meet in the corner that is farthest inward
    unsigned octant;        ///< of the mean direction

    explicit Pyramid(const Packet& packet) {
        const V3<F16> d = load16(packet.direction);
        float axis[3] = {total(d.x), total(d.y), total(d.z)}, x[3], y[3];
        octant = octant_of(axis);
        for (unsigned k = 0; k < 4; ++k)
            for (unsigned i = 0; i < 3; ++i)
                set(k, i, 0);
        if (!(length(axis) > 1))
            return;
        scale(axis, 1 / length(axis));
        across(axis, x, y);
        const F16 forward = dot(d, V3<F16>::splat(axis));
        constexpr float least_forward = 0.15f;
        if (!(lowest(forward) > least_forward))
            return;
        set_planes(0, axis, x, dot(d, V3<F16>::splat(x)) / forward);
        set_planes(2, axis, y, dot(d, V3<F16>::splat(y)) / forward);
    }

  private:
    /// slope_low <= p.side / p.axis <= slope_high, as two planes.
    void set_planes(unsigned first, const float* axis, const float* side, F16 slope) {
        const float low = lowest(slope), high = -lowest(F16::splat(0) - slope);
        for (unsigned i = 0; i < 3; ++i) {
            set(first, i, side[i] - high * axis[i]);
            set(first + 1, i, low * axis[i] - side[i]);
        }
    }
    /// Never quite zero: infinity times it is to be infinity.
    void set(unsigned k, unsigned i, float n) {
        normal[k][i] = n < 0 ? n - 1e-20f : n + 1e-20f;
        nearest[k][i] = 2 * i + (n < 0);
    }
    /// Two directions that make a frame with the axis (Duff et al. 2017).
    static void across(const float* n, float* x, float* y) {
        const float sign = n[2] < 0 ? -1.0f : 1.0f, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
        x[0] = 1 + sign * n[0] * n[0] * a;
        x[1] = sign * b;
        x[2] = -sign * n[0];
        y[0] = b;
        y[1] = sign + n[1] * n[1] * a;
        y[2] = -n[1];
    }
    static float total(F16 v) {
        alignas(64) float lane[packet_size];
        v.store(lane);
        const F4 sum =
            F4::load(lane) + F4::load(lane + 4) + F4::load(lane + 8) + F4::load(lane + 12);
        return (sum.v[0] + sum.v[1]) + (sum.v[2] + sum.v[3]);
    }
    static float length(const float* v) {
        return __builtin_sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    static void scale(float* v, float by) {
        for (unsigned i = 0; i < 3; ++i)
            v[i] *= by;
    }
};

/// Boxes relative to the packet's origin.
struct RelativeBoxes {
    F8 plane[6];

    RelativeBoxes(const Node& node, const float* origin) {
        for (unsigned p = 0; p < 6; ++p)
            plane[p] = F8::load(node.plane[p]) - F8::splat(origin[p / 2]);
    }
    /// By how much each box lies outside the pyramid.
    [[nodiscard]] F8 outside(const Pyramid& pyramid) const {
        const auto beyond = [&](unsigned k) {
            return plane[pyramid.nearest[k][0]] * F8::splat(pyramid.normal[k][0]) +
                   plane[pyramid.nearest[k][1]] * F8::splat(pyramid.normal[k][1]) +
                   plane[pyramid.nearest[k][2]] * F8::splat(pyramid.normal[k][2]);
        };
        return max(max(beyond(0), beyond(1)), max(beyond(2), beyond(3)));
    }
};

} // namespace hemilux::wide::HEMILUX_KERNELS
