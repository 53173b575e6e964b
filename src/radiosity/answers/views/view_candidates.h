#pragma once
// Places from which a scene can be looked at, before it is known what they show.

#include "bvh/tracer.h"
#include "geometry/box.h"
#include "radiosity/answers/views/camera.h"

#include <span>
#include <vector>

namespace hemilux {

class Mesh;

enum class ViewKind : std::uint8_t {
    object, ///< from outside; everything is in the picture, or everything that is lit
    within, ///< from a place inside the scene's box
    facing  ///< from free space before a surface, at that surface
};

/// A camera in the local frame.
struct ViewCandidate {
    Camera camera;
    ViewKind kind;
    double taste; ///< preference for its direction [-]: things are best seen from a front corner
};

/// What candidates depend on, in the local frame.
struct ViewSubject {
    Box box;                              ///< what there is to see
    Box lit;                              ///< box of what is lit
    int up;                               ///< axis that points up
    double aspect;                        ///< width over height of the picture
    std::span<const std::uint32_t> front; ///< patches to look at from before them
};

/// Returns candidates of all kinds, in order of preference. The axes of a scene may be turned
/// together with `up`, with y to z, x to x and z to -y: then the cameras turn alike.
[[nodiscard]] std::vector<ViewCandidate> view_candidates(const Mesh& mesh, const Tracer& tracer,
                                                         const ViewSubject& subject);

} // namespace hemilux
