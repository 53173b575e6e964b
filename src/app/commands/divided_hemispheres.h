#pragma once
// The divided hemispheres of all patches, by the rules of either method that divides them.

#include "app/settings/settings.h"
#include "io/drawings/hemisphere_svg.h"
#include "radiosity/paper/solving/solver.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hemilux {

class DividedHemispheres {
  public:
    virtual ~DividedHemispheres() = default;
    /// Returns the number of parts of each patch; the technique of 1997 has a hemisphere over each.
    [[nodiscard]] virtual std::size_t parts() const { return 1; }
    [[nodiscard]] virtual std::vector<DrawnTriangle> triangles(std::uint32_t patch,
                                                               std::size_t part) const = 0;
    /// Returns the directions along which surfaces were counted.
    [[nodiscard]] virtual std::vector<CountedDirection> counted(std::uint32_t patch,
                                                                std::size_t part) const = 0;
    /// Returns the directions of about so many energy rays, as the method allocates them.
    [[nodiscard]] virtual std::vector<Vec3> rays(std::uint32_t patch, std::size_t part,
                                                 std::uint32_t number) const = 0;
    /// Returns the unit of densities.
    [[nodiscard]] virtual std::string unit() const { return "surfaces per ray"; }
    [[nodiscard]] virtual std::uint64_t density_rays() const = 0;
    [[nodiscard]] virtual std::uint64_t bytes() const = 0;
};

/// Counts the surfaces for all patches; mesh, tracer, settings and monitor outlive the result.
[[nodiscard]] std::unique_ptr<DividedHemispheres>
divide_hemispheres(const DensitySettings& settings, const Mesh& mesh, const Tracer& tracer,
                   Monitor& monitor);

} // namespace hemilux
