#include "radiosity/answers/vertices/baked_light.h"

#include "geometry/numeric.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {
namespace {

double shown_area(const Mesh& mesh, const Patch& patch) {
    return mesh.material(patch).is_far ? 0 : patch.area;
}

Vec3 mean_of_corners(const Polygon& shape, const std::array<std::uint32_t, 4>& classes,
                     std::span<const Vec3> of_class) {
    const auto corners = static_cast<std::size_t>(shape.size());
    Vec3 sum(0.0);
    for (std::size_t c = 0; c < corners; ++c)
        sum += of_class[classes[c]];
    return sum / static_cast<double>(corners);
}

} // namespace

const char* name_of(Bake bake) {
    switch (bake) {
    case Bake::radiosity:
        return "radiosity";
    case Bake::irradiance:
        return "irradiance";
    case Bake::indirect:
        break;
    }
    return "indirect";
}

Vec3 irradiance_of(const Material& material, const Vec3& radiosity) {
    return ratio_or_zero(radiosity - material.emission, material.reflectance);
}

std::vector<Vec3> baked_light(const Mesh& mesh, const CornerClasses& classes,
                              const PatchLight& light, Bake bake) {
    return smooth(mesh, classes, [&](std::uint32_t patch, const Vec3& corner) {
        const Vec3 radiosity = radiosity_at(mesh, light, patch, corner);
        return bake == Bake::radiosity ? radiosity : irradiance_of(mesh.material(patch), radiosity);
    });
}

/// Uses a picture of one row, whose pixels are places at equal distances of area.
double auto_exposure(const Mesh& mesh, const CornerClasses& classes,
                     std::span<const Vec3> of_class) {
    constexpr int places = 20'000;
    double area = 0, passed = 0;
    for (const Patch& patch : mesh.patches())
        area += shown_area(mesh, patch);
    Image row(places, 1);
    int next = 0;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        passed += shown_area(mesh, patch);
        for (; next < places && (next + .5) * area < passed * places; ++next)
            row.at(next, 0) = mean_of_corners(patch.shape, classes.of_patch[i], of_class);
    }
    return auto_exposure(row);
}

} // namespace hemilux
