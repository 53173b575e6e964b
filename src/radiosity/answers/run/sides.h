#pragma once
// Which sides of faces emit and reflect: faces that look away from the light are turned or
// reported.

#include "radiosity/answers/asked/watcher.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/light/sides/orientation.h"
#include "radiosity/paper/scene/mesh.h"

#include <string>

namespace hemilux {

/// The sides of faces that emit and reflect.
enum class Sides { automatic, front, both };

struct SidedMesh {
    Mesh mesh;
    MadeTracer made; ///< tracer of the mesh; empty with Sides::both, which needs none
};

/// Divides the faces and turns them where `sides` says so; `options` are two-sided with
/// Sides::both. The watcher is told what was turned, what looks away all the same, or what emitters
/// emit that shine to both sides. Throws as Mesh does.
[[nodiscard]] SidedMesh divide_with_sides(Scene scene, Sides sides, const MeshOptions& options,
                                          Watcher& watcher);

/// Returns "group shade", or "groups a, b, c, d and 5 more".
[[nodiscard]] std::string names_of_groups(const std::vector<std::uint32_t>& groups,
                                          const Scene& scene);
/// Returns "3 faces (group shade)" for those that are in doubt and stay as they are.
[[nodiscard]] std::string doubt_text(const Orientation& found, const Scene& scene);
/// Returns what emitters emit that shine to both sides; empty without any.
[[nodiscard]] std::string both_sides_text(const Scene& scene);

} // namespace hemilux
