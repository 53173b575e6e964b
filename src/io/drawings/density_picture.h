#pragma once
// A number per patch in false colour, seen through a camera.

#include "radiosity/answers/pictures/render.h"

#include <string>

namespace hemilux {

/// Draws each patch in the colour of its number, from 0 to the largest of all, on a white
/// background, with a colour bar below. The picture is for write_png with exposure 1. `numbers` has
/// one number per patch, none negative.
[[nodiscard]] Image density_picture(const Mesh& mesh, const Tracer& tracer,
                                    std::span<const double> numbers, const std::string& caption,
                                    const Camera& camera, const RenderOptions& options);

} // namespace hemilux
