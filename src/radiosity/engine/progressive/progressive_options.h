#pragma once
// Defines the options of the method `progressive`.

namespace hemilux {

struct ProgressiveOptions {
    /// Adds to the solution shown an estimate of the light that is still unshot (Cohen et al.
    /// 1988). It makes early pictures brighter and is gone at the end.
    bool ambient = false;
    /// Patches also shoot what they will probably receive later, and take back what was too much
    /// (Feda and Purgathofer 1992). This takes fewer shots in bright rooms.
    bool overshoot = false;
};

} // namespace hemilux
