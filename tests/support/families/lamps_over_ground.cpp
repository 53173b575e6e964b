// A square lamp over open ground. The ground does not see itself and the lamp is black, so the
// radiosity of the ground is rho F E with the form factor from each patch to the lamp: a closed
// form.

#include "support/families/builders.h"
#include "support/families/families.h"
#include "support/scenes.h"

#include <sstream>

namespace hemilux::test {
namespace {

constexpr std::uint32_t lamp = 1;

HardScene lamp_over_ground(double height, double width) {
    // Emission such that the irradiance below is about 1 for all heights.
    Scene scene = with_materials(
        {grey("ground", .5, 0), grey("lamp", 0, 3 + 3 * height * height / (width * width))});
    add_quad(scene, {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, 10, 10, 0);
    const double w = width / 2;
    add_polygon(scene, parallelogram({-w, height, -w}, {width, 0, 0}, {0, 0, width}), lamp);
    DenseSystem system(scene);
    const std::uint32_t n = facets_of(scene);
    system.add_open_pairs({0, n - 1}, {n - 1, n});
    return solved(std::move(scene), system, 1e-8, {Range{0, n - 1}.indices()});
}

} // namespace

Entries lamps_over_ground() {
    Entries entries;
    struct Size {
        double height, width;
    };
    for (const auto& [height, width] : std::initializer_list<Size>{{1, 1},
                                                                   {3, .3},
                                                                   {5, .3},
                                                                   {10, .3},
                                                                   {10, 1},
                                                                   {20, 1},
                                                                   {50, 1},
                                                                   {100, 1},
                                                                   {1e3, 1},
                                                                   {1e4, 1},
                                                                   {1e5, 1}}) {
        std::ostringstream name;
        name << "height " << height << " width " << width;
        entries.push_back(
            {"lamp", name.str(), [h = height, w = width] { return lamp_over_ground(h, w); }});
    }
    return entries;
}

} // namespace hemilux::test
