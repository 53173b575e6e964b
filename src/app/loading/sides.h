#pragma once
// --sides: faces that look away from the light are turned or reported. So a black picture with an
// error of 0 % does not pass for a result.

#include "app/settings/settings.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/light/sides/orientation.h"

#include <span>
#include <string>

namespace hemilux {

struct SidedMesh {
    Mesh mesh;
    MadeTracer made; ///< tracer of the mesh; empty with --sides both, which needs none
};

/// Divides the faces and turns them where --sides says so. Says on stderr what was turned, what
/// looks away all the same, or what emitters emit that shine to both sides. Throws as
/// divide_scene().
[[nodiscard]] SidedMesh divide_with_sides(Scene scene, const SceneSettings& settings,
                                          const SolveOptions& options, Verbosity verbosity);

/// Returns lines of `info`: names on the left, figures on the right. What is as it should be gets
/// no line.
[[nodiscard]] std::string describe(const Orientation& orientation, const Scene& scene, Sides sides);
/// Returns the same for emitters that shine to both sides.
[[nodiscard]] std::string describe_both_sides(const Scene& scene);

/// Returns the shares by what escaped in a run, so that all that is said of it agrees; what else is
/// lost fell on backs, or on faces that lie over others.
[[nodiscard]] LightShares as_in_ledger(LightShares light, const EnergyBalance& energy);

/// Returns words for a run whose light was lost: nothing is lit, or more than nine tenths of the
/// light fell on backs or escaped. They are empty for other runs.
[[nodiscard]] std::string lost_light_text(const Mesh& mesh, std::span<const Vec3> radiosity,
                                          const LightShares& light, Sides sides);

} // namespace hemilux
