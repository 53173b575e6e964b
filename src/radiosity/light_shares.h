#pragma once
// Where emitted light ends, as far as faces and backs are concerned: a few thousand paths are
// enough to see that a room is black because its faces look away.

namespace hemilux {

class Mesh;
class Tracer;

/// Shares of the emitted light, all channels together; the rest is absorbed by fronts. 0 where
/// nothing emits.
struct LightShares {
    double backs = 0;   ///< falls on backs of one-sided faces, which absorb it
    double escaped = 0; ///< leaves the scene
};

/// By 4096 paths, so to within 1 % (one standard error: 0.8 %). Deterministic.
[[nodiscard]] LightShares find_light_shares(const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
