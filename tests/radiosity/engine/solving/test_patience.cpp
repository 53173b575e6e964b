// A run whose error stays unknown ends with its patience; one that learns goes on.
#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <limits>

using namespace hemilux;

namespace {

/// Takes steps that find nothing, until one of them does.
class BlindSolver final : public Solver {
  public:
    BlindSolver(const Mesh& mesh, std::uint32_t finds_at) : finds_at_(finds_at) {
        solution_.radiosity.assign(mesh.patches().size(), Vec3(1.0));
        solution_.standard_error.assign(mesh.patches().size(),
                                        Vec3(std::numeric_limits<double>::quiet_NaN()));
    }
    bool step() override {
        if (++solution_.steps >= finds_at_)
            solution_.standard_error.assign(solution_.standard_error.size(), Vec3(.1));
        return true;
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    std::uint32_t finds_at_;
    Solution solution_{};
};

std::uint32_t steps_of(std::uint32_t finds_at, const StopRule& stop) {
    const Mesh mesh(test::room_with_block());
    const WideBvh bvh(mesh.soup());
    const SolveOptions options;
    Monitor monitor;
    BlindSolver solver(mesh, finds_at);
    CHECK(run(solver, {mesh, bvh, options, monitor}, stop));
    CHECK_FALSE(bool(monitor.interrupted));
    return solver.solution().steps;
}

} // namespace

TEST_CASE("a run that learns nothing ends with its patience") {
    const StopRule stop{.steps = 100, .patience = 0};
    CHECK(steps_of(1000, stop) == StopRule::steps_of_patience + 1);
    CHECK(steps_of(2, stop) == 100);
    CHECK(steps_of(1000, {.steps = 100}) == 100);
}
