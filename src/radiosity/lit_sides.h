#pragma once
// On which sides of the facets light arrives if all of them reflect half of it on both sides: a
// quick estimate, so that sides can be judged before they are known.

#include "radiosity/shells.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
class Tracer;

/// Light that arrives on a facet, front and back as the scene has them, in rays.
using SideLight = std::array<double, 2>;

/// By facet. `shines_back`: by facet, whether an emitting one shines to its back. Rays go from
/// emitters to surfaces; shells that few have reached look for lit surfaces by rays of their own.
[[nodiscard]] std::vector<SideLight> light_on_sides(const Mesh& mesh, const Tracer& tracer,
                                                    const Shells& shells,
                                                    const std::vector<bool>& shines_back);

} // namespace hemilux
