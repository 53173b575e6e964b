#pragma once
// A solver that keeps its rays can light the scene by other emitters.

#include "geometry/vector.h"
#include "radiosity/paper/solution/solution.h"

#include <memory>
#include <optional>
#include <vector>

namespace hemilux {

class Mesh;
class Workers;

/// The light of a mesh by patch, as in Solution.
struct Relit {
    std::vector<Vec3> radiosity, standard_error; ///< [W/m2]
    std::vector<Slope> slope = {};
};

class Relighting {
  public:
    virtual ~Relighting() = default;
    /// Returns the light of `mesh`, which is the solver's but that some of what emits there is dark
    /// here, and has another material. Random rays are those that the solver has traced; rays to
    /// small emitters are new, `share` of as many as it has traced. Returns nothing where it was
    /// interrupted.
    [[nodiscard]] virtual std::optional<Relit> light_of(const Mesh& mesh, double share,
                                                        const Workers& workers) const = 0;
};

/// A solver that can do so.
class KeepsRays {
  public:
    virtual ~KeepsRays() = default;
    /// Prepares what all emitters have in common. The solver must outlive the result and not go on.
    [[nodiscard]] virtual std::unique_ptr<Relighting> relighting(const Workers& workers) const = 0;
};

} // namespace hemilux
