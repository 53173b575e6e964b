#pragma once
// This chooses a camera for any scene. It looks into an open box through its opening, at a closed
// room from within, and at an object from outside; and it looks at what the light falls on.

#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/answers/views/up_axis.h"

namespace hemilux {

/// What an automatic camera is chosen for.
struct ViewWish {
    double aspect = 4.0 / 3.0;        ///< width over height of the picture
    std::optional<int> up = {};       ///< axis that points up; empty: guess_up() chooses it
    std::optional<int> usual_up = {}; ///< guess_up(): what is customary in files of this kind
    unsigned threads = 0;             ///< 0: one per core. The camera does not depend on it
};

struct AutomaticView {
    Camera camera;
    double lit = 0; ///< share of the picture [-] that shows light of the level most light has
};

/// Tries many places and directions with a few rays each, and chooses the one that shows the most
/// lit surface, of the most kinds. What emitters emit does not count as lit. Where hardly any view
/// from within shows lit walls all around, or a sun or sky lights most of the outside, the scene is
/// a thing and is seen from outside.
/// `radiosity` [W/m2] has one value per patch. The same arguments give the same view.
[[nodiscard]] AutomaticView automatic_view(const Mesh& mesh, const Tracer& tracer,
                                           std::span<const Vec3> radiosity,
                                           const ViewWish& wish = {});

/// Returns the camera of that view.
[[nodiscard]] Camera automatic_camera(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const Vec3> radiosity, double aspect = 4.0 / 3.0,
                                      std::optional<int> up = {}, unsigned threads = 0);

} // namespace hemilux
