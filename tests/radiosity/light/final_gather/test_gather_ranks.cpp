// Gathers that several ranks share: the same bytes as by one.
#include "parallel/workers.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/light/light_error/division_error.h"
#include "support/catch.h"
#include "support/rank_threads.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <vector>

using namespace hemilux;
using test::Model;

namespace {

constexpr MeshOptions divided{.max_edge = .4};

} // namespace

TEST_CASE("Ranks share the gathers that find how far light is off within patches") {
    const Model model(test::room_with_block(), divided);
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {.rays = 64}, test::steps(1));
    const auto find = [&](const StopFlag& flag) {
        return division_error(model.mesh, model.bvh, solution, {.max_rays = 200'000}, Workers(2),
                              flag);
    };
    const DivisionError alone = find(StopFlag());
    std::vector<DivisionError> found(2);
    std::vector<std::uint64_t> rays(2);
    run_as_ranks(2, [&](const Ranks& ranks) {
        StopFlag flag;
        const SharedStop shared(flag, ranks);
        found[ranks.index()] = find(flag);
        rays[ranks.index()] = ranks.work().rays;
    });
    for (std::size_t r = 0; r < 2; ++r) {
        CHECK(found[r].error == alone.error);
        CHECK(found[r].uncertainty == alone.uncertainty);
        CHECK(found[r].points == alone.points);
        CHECK(found[r].rays == alone.rays);
        CHECK(3 * rays[r] > rays[0] + rays[1]); // about a half
    }
    CHECK(rays[0] + rays[1] < alone.rays); // the walks are each rank's own
}

TEST_CASE("What a gather finds is known to all ranks") {
    const Model model(test::room_with_block(), divided);
    const std::vector<Vec3> light(model.mesh.patches().size(), Vec3(1.0));
    const PointsOverSurface surface(model.mesh, {});
    const auto gather_on = [&](const Ranks& ranks) {
        StopFlag flag;
        const SharedStop shared(flag, ranks);
        FinalGather gather(model.mesh, model.bvh, std::span<const Vec3>(light));
        return gather_over(surface, gather, 100, 2, 7, Workers(1), flag).irradiance;
    };
    const std::vector<Vec3> alone = gather_on(one_rank());
    std::vector<std::vector<Vec3>> found(3);
    run_as_ranks(3, [&](const Ranks& ranks) { found[ranks.index()] = gather_on(ranks); });
    for (std::size_t r = 0; r < 3; ++r)
        CHECK((found[r] == alone));
}
