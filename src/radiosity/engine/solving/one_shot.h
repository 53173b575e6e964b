#pragma once
// Defines --one-shot, of the methods whose light comes shot by shot.

#include "radiosity/engine/solving/method_option.h"

namespace hemilux {

struct OneShotOptions {
    /// With it a step is one shot, and the run ends when all light is shot. Else a step has as many
    /// shots as use up its rays, or is a whole solution.
    bool one_shot = false;
};

[[nodiscard]] inline bool is_one_shot(const SolveOptions& options) {
    return own_options<OneShotOptions>(options).one_shot;
}

[[nodiscard]] inline MethodOption one_shot_option() {
    MethodOption option =
        flag_option("--one-shot", "a step is one shot", &OneShotOptions::one_shot);
    option.on_page = option.resumable = false;
    return option;
}

} // namespace hemilux
