#pragma once
// Decides when a run ends.

#include <cstdint>
#include <limits>
#include <optional>

namespace hemilux {

/// The first rule that is met ends the run. With none given, `default_steps` does.
struct StopRule {
    std::optional<std::uint32_t> steps = {};
    std::optional<double> seconds = {}; ///< time of the run [s]
    std::optional<double> error = {};   ///< estimated relative error [-], e.g. 0.01
    /// The number of rays in all after which no further step is begun: where light is rare an error
    /// may be out of reach.
    std::optional<std::uint64_t> rays = {};
    /// The time [s] after which a run ends that has taken `steps_of_patience` and has learned
    /// nothing: its error is still unknown.
    std::optional<double> patience = {};
    static constexpr std::uint32_t steps_of_patience = 3;
    static constexpr std::uint32_t default_steps = 16;

    /// Returns the number of steps that will be taken, as far as that is known: more where the time
    /// ends the run, 0 where the error does.
    [[nodiscard]] std::uint32_t expected_steps() const {
        return steps.value_or(seconds ? std::numeric_limits<std::uint32_t>::max() : 0);
    }
};

} // namespace hemilux
