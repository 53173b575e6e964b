// What a library above the engine may add, and that the engine is whole without it.
#include "parallel/workers.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/paper/solving/mean_of_steps.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/targets.h"

#include <array>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

/// Replaces what was added until the end of a test.
class Added {
  public:
    explicit Added(const Additions& added) { add_to_engine(added); }
    ~Added() { add_to_engine(before_); }
    Added(const Added&) = delete;
    Added& operator=(const Added&) = delete;

  private:
    Additions before_ = additions();
};

class WholeHemisphere final : public Strategy {
  public:
    Allocation allocate(std::uint32_t, AllocatedCells& memory) const override {
        memory.clear();
        memory.add(whole_hemisphere, 1);
        return memory.view();
    }
};

std::unique_ptr<Strategy> make_whole(const SolverInput&, const Hemisphere&, const Workers&) {
    return std::make_unique<WholeHemisphere>();
}

/// The same density everywhere.
class Even final : public LeafDensities {
  public:
    void leaves(std::uint32_t, std::vector<DensityLeaf>& result) const override {
        result = {{0, 1}, {1, 1}, {2, 1}, {3, 1}};
    }
    [[nodiscard]] std::uint64_t bytes() const override { return 7; }
};

std::unique_ptr<LeafDensities> make_even(const SolverInput&, const Hemisphere&, const Workers&) {
    return std::make_unique<Even>();
}

const Guide whole_guide{.name = "whole",
                        .place = 1,
                        .strategy = make_whole,
                        .bytes = [](int, double patches) { return 3 * patches; }};
const Guide even_guide{.name = "even",
                       .place = 2,
                       .densities = make_even,
                       .bytes = [](int depth, double) { return double(depth); }};
constexpr std::array<const Guide*, 2> guides{&whole_guide, &even_guide};

/// Gives the patches of odd numbers twice as many rays.
class OddFirst final : public Aimer {
  public:
    explicit OddFirst(const SolverInput& input) : patches_(input.mesh.patches().size()) {}
    bool shoot_pilot(const StepTask&, StepResult& pilot, MeanOfSteps& mean) override {
        pilot.shot = mean.emitted();
        pilot.rays = 1;
        for (std::size_t i = 0; i < patches_; ++i)
            mean.aimed.push_back(i % 2 == 0 ? .5 : 1);
        return true;
    }
    [[nodiscard]] const SeparateRays* separate_rays() const override { return nullptr; }
    void save(StateWriter& state, const MeanOfSteps& mean) const override {
        state.add(std::span<const double>(mean.aimed));
    }
    void load(StateReader& state, MeanOfSteps& mean) override {
        mean.aimed.resize(patches_);
        state.get(std::span(mean.aimed));
    }

  private:
    std::size_t patches_;
};

std::unique_ptr<Aimer> make_odd_first(const SolverInput& input, bool) {
    return std::make_unique<OddFirst>(input);
}

const Method& hemisphere() { return *find_method("hemisphere"); }

} // namespace

TEST_CASE("Without additions the engine is whole: no guides to choose from, no rays aimed") {
    const Added nothing({});
    CHECK(hemisphere().own_options().empty());
    CHECK(hemisphere().implied_by() ==
          std::vector<std::string>{"--depth", "--threshold", "--literal"});
    for (const Method* const method : methods())
        if (method->strategy)
            CHECK_FALSE(method->takes_target());
    const Model model(test::two_rooms());
    SolveOptions options{.rays = 8, .threads = 1};
    const Solution all = test::solve(model, hemisphere(), options, test::steps(2));
    const Solution aimed =
        test::solve_for(model, hemisphere(), test::first_room(model.mesh), options, test::steps(2));
    CHECK(aimed.radiosity == all.radiosity); // the target changes how errors count, no more
}

TEST_CASE("Guides that are added are values of --guide, and guide the method hemisphere") {
    const Added both({.guides = guides});
    const std::vector<MethodOption> options = hemisphere().own_options();
    REQUIRE(options.size() == 1);
    CHECK(options[0].name == "--guide");
    CHECK(options[0].values == std::vector<std::string>{"density", "whole", "even"});
    CHECK(hemisphere().implied_by() ==
          std::vector<std::string>{"--depth", "--threshold", "--guide", "--literal"});
    const Model model(test::room_with_block());
    SolveOptions chosen{.rays = 8, .depth = 0, .threads = 1};
    CHECK(options[0].get(chosen) == "density");
    CHECK_FALSE(options[0].set(chosen, "none"));
    REQUIRE(options[0].set(chosen, "whole"));
    CHECK(options[0].get(chosen) == "whole");
    CHECK(hemisphere().bytes(chosen, 5) == 15);
    const Solution whole = test::solve(model, hemisphere(), chosen, test::steps(2));
    CHECK(whole.radiosity ==
          test::solve(model, *find_method("progressive-monte-carlo"), chosen, test::steps(2))
              .radiosity);
    REQUIRE(options[0].set(chosen, "even"));
    const Solution evenly = test::solve(model, hemisphere(), chosen, test::steps(2));
    CHECK(evenly.bytes_density == 7);
    CHECK(evenly.radiosity != whole.radiosity);
    REQUIRE(options[0].set(chosen, "density"));
    CHECK(guide_of(chosen) == nullptr);
}

TEST_CASE("An aimer that is added allocates the rays of steps, and its state is saved") {
    const Added aimer({.make_aimer = make_odd_first});
    const Model model(test::two_rooms());
    const std::vector<double> target = test::first_room(model.mesh);
    SolveOptions options{.rays = 8, .threads = 1};
    const Method& method = *find_method("progressive-monte-carlo");
    CHECK(method.takes_target());
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor, everything_needed, target};
    const auto first = method.make(input), second = method.make(input);
    run(*first, input, test::steps(2));
    test::hand_over(*first, *second);
    REQUIRE(first->step());
    REQUIRE(second->step());
    CHECK(first->solution().radiosity == second->solution().radiosity);
    CHECK(first->solution().radiosity !=
          test::solve(model, method, options, test::steps(3)).radiosity);
}
