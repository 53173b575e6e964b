#pragma once
// What a run is for: a part of the scene whose light is to be right.

#include "bvh/tracer.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/views/camera.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

class Mesh;

/// A picture that a run is for.
struct TargetPicture {
    Camera camera;
    PixelSize size;
};

/// A place on a face of the scene that looks along the normal [scene units].
struct TargetPoint {
    Vec3 position, normal;
};

/// All of these together; without any, all patches count alike.
struct RunTarget {
    std::optional<TargetPicture> picture;
    std::vector<std::uint32_t> groups; ///< Facet::group
    std::vector<TargetPoint> points;

    [[nodiscard]] bool is_empty() const { return !picture && groups.empty() && points.empty(); }
};

/// Returns the first point that lies on no face; empty where all of them lie on one.
[[nodiscard]] std::optional<std::size_t> point_off_faces(const RunTarget& target, const Mesh& mesh,
                                                         const Tracer& tracer);

/// Returns the weights by patch (Solution::weight) for the patches as they are; empty where all
/// count alike. Points on no face have none. The result is the same for any number of threads.
[[nodiscard]] std::vector<double> target_weights(const RunTarget& target, const Mesh& mesh,
                                                 const Tracer& tracer, unsigned threads);

/// Returns whether anything that has a weight reflects; true without weights.
[[nodiscard]] bool reflects(const Mesh& mesh, const std::vector<double>& weights);

} // namespace hemilux
