#pragma once
// Holds the light that is solved for: of each of its independent batches of rays, and of all
// together. Where rays had to be forgotten for want of memory (--memory), what they showed is kept
// as a generation. The light is the mean of the generations.

#include "radiosity/paper/solution/solution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class StateReader;
class StateWriter;

class BatchLight {
  public:
    static constexpr unsigned batches = 4;

    explicit BatchLight(std::size_t patches) : solved_(batches + 1, Light(patches)) {}

    /// The light that one batch has found.
    struct Light {
        explicit Light(std::size_t patches) : incident(patches, Vec3(0.0)) {}
        std::vector<Vec3> incident; ///< arrives at each patch [W/m2]
        EnergyBalance energy;       ///< local units
    };
    /// Returns the light by the rays of the present generation: of each batch, then of all
    /// together.
    [[nodiscard]] std::vector<Light>& solved() { return solved_; }

    /// Returns the mean over the generations [W/m2].
    [[nodiscard]] Vec3 incident(std::size_t batch, std::size_t patch) const {
        const Vec3& now = solved_[batch].incident[patch];
        return before_.empty() ? now : (before_[batch].incident[patch] + now) / generations();
    }
    /// Returns how far each of the batches is off their mean [W/m2].
    [[nodiscard]] std::array<Vec3, batches> deviations(std::size_t patch) const {
        std::array<Vec3, batches> off;
        Vec3 mean(0.0);
        for (std::size_t s = 0; s < batches; ++s)
            mean += (off[s] = incident(s, patch)) / double(batches);
        for (Vec3& each : off)
            each -= mean;
        return off;
    }
    /// Returns the mean over the generations of what is absorbed and escapes, of all batches
    /// together.
    [[nodiscard]] EnergyBalance energy() const;

    [[nodiscard]] double generations() const { return static_cast<double>(generation_ + 1); }
    /// Returns the number of the generation, from 0.
    [[nodiscard]] std::uint64_t generation() const { return generation_; }
    /// Begins a generation: the light that was solved last counts as one more.
    void begin_generation();

    void save(StateWriter& state) const;
    /// Loads a state; throws StateError for what save() cannot have written.
    void load(StateReader& state);

  private:
    std::vector<Light> solved_;
    std::vector<Light> before_; ///< sums over the generations that ended, if any
    std::uint64_t generation_ = 0;
};

} // namespace hemilux
