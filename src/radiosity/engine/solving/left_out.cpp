#include "radiosity/engine/solving/left_out.h"

#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/transport_figures.h"
#include "radiosity/paper/scene/needs.h"
#include "radiosity/paper/solution/solution.h"

#include <array>

namespace hemilux {
namespace {

std::string patches(std::size_t n) { return std::to_string(n) + (n == 1 ? " patch" : " patches"); }

void add_channels(const Needs& needs, std::vector<LeftOut>& list) {
    int dark = 0, alike = 0;
    for (const int c : {0, 1, 2})
        if (!needs.solves(c))
            ++(needs.channel[static_cast<std::size_t>(c)] == Needs::dark ? dark : alike);
    const auto add = [&](int number, const char* why) {
        constexpr std::array<const char*, 4> of_three{"", "one of three ", "two of three ",
                                                      "all three "};
        const std::string count = of_three[static_cast<std::size_t>(number)];
        if (number > 0)
            list.push_back({count + "colour channels", why, count + "linear systems"});
    };
    add(alike, alike == 2 ? "all reflectances and emissions are grey"
                          : "all reflectances and emissions are those of another channel");
    add(dark, "nothing is emitted there");
}

void add_idle_patches(const Needs& needs, const MethodWork& work, std::vector<LeftOut>& list) {
    const bool hemispheres = work.densities && needs.visibility;
    if (!hemispheres && !work.pairs)
        return;
    const std::string rays = !hemispheres ? "rays"
                             : work.pairs ? "rays and densities"
                                          : "densities";
    const std::string what = rays + " of ", saved = "their " + rays;
    if (needs.black > 0)
        list.push_back({what + patches(needs.black), "they neither emit nor reflect", saved});
    if (needs.unlit > 0)
        list.push_back({what + patches(needs.unlit), "no light can reach them", saved});
}

std::vector<LeftOut> left_out_of(const Needs& needs, const MethodWork& work) {
    std::vector<LeftOut> list;
    if (work.linear_systems)
        add_channels(needs, list);
    if (!needs.visibility && work.densities)
        list.push_back(
            {"densities", "in a convex enclosure all are 1", "all density rays and bytes"});
    if (!needs.visibility && work.pairs)
        list.push_back({"tests of visibility", "nothing stands in a convex enclosure",
                        "all rays between two patches"});
    if (!needs.bounces && work.passes)
        list.push_back({"all passes but the first", "nothing reflects that light reaches",
                        "all steps but one, and the search for their length"});
    add_idle_patches(needs, work, list);
    return list;
}

} // namespace

std::vector<LeftOut> left_out(const Needs& needs) {
    return left_out_of(needs,
                       {.densities = true, .pairs = true, .linear_systems = true, .passes = true});
}

std::vector<LeftOut> left_out(const Needs& needs, const MethodWork& work,
                              const Solution& solution) {
    std::vector<LeftOut> list = left_out_of(needs, work);
    const std::uint64_t unlit = solution.figures.value(transport_figures::unlit);
    if (unlit > 0 && unlit < solution.radiosity.size())
        list.push_back({"rays of " + patches(unlit) + " after the first step",
                        "no path to them from an emitter was found",
                        "their rays at random, and most of their shadow rays"});
    const std::uint64_t unneeded = solution.figures.value(transport_figures::unneeded);
    if (unneeded > 0)
        list.push_back({"rays of " + patches(unneeded) + " after the first step",
                        "no path from them to what --for names was found",
                        "their rays at random and their shadow rays"});
    if (solution.rays_density_spared > 0)
        list.push_back({"densities below triangles that are not divided",
                        "their mean density is not above the threshold",
                        std::to_string(solution.rays_density_spared) +
                            (solution.rays_density_spared == 1 ? " density ray" : " density rays") +
                            ", and as many bytes"});
    return list;
}

} // namespace hemilux
