// The checks of a strategy pass those that there are, and find what is wrong in those that are not
// right.
#include "radiosity/engine/checks/check_strategy.h"
#include "radiosity/engine/shooting/shooting.h"
#include "support/catch.h"

#include <stdexcept>

using namespace hemilux;

namespace {

/// What is done to an allocation of equal rays for the triangles of the last level.
enum class Flaw { none, half_of_rays, cell_without_rays, cell_missing, cell_twice, far_too_many };

template <Flaw flaw>
class Flawed final : public Strategy {
  public:
    explicit Flawed(const Hemisphere& hemisphere) {
        const std::size_t begin = Hemisphere::cells_up_to(hemisphere.depth() - 1),
                          end = Hemisphere::cells_up_to(hemisphere.depth());
        for (std::size_t c = begin; c < end; ++c) {
            double rays = 1 / double(end - begin);
            if (flaw == Flaw::half_of_rays)
                rays /= 2;
            if (flaw == Flaw::cell_without_rays && c == begin)
                rays = 0;
            if (flaw == Flaw::cell_missing && c == begin)
                continue;
            allocated_.add(static_cast<std::uint16_t>(c), rays);
            if (flaw == Flaw::cell_twice && c == begin)
                allocated_.add(static_cast<std::uint16_t>(c), rays);
        }
        if (flaw == Flaw::far_too_many)
            allocated_.add(60'000, 0);
    }
    Allocation allocate(std::uint32_t, AllocatedCells&) const override { return allocated_.view(); }

  private:
    AllocatedCells allocated_;
};

template <Flaw flaw>
std::unique_ptr<Strategy> make_flawed(const SolverInput&, const Hemisphere& hemisphere,
                                      const Workers&) {
    return std::make_unique<Flawed<flaw>>(hemisphere);
}

template <Flaw flaw>
std::vector<std::string> faults_of() {
    return check_strategy({.name = "flawed",
                           .summary = "",
                           .unbiased = true,
                           .default_stop = {},
                           .make = shoot_with<make_flawed<flaw>>,
                           .strategy = make_flawed<flaw>});
}

bool finds(const std::vector<std::string>& faults, const std::string& text) {
    for (const std::string& fault : faults)
        if (fault.find(text) != std::string::npos)
            return true;
    return false;
}

/// A solver that loses a part of the light.
template <MakeStrategy make>
class Losing final : public EngineSolver {
  public:
    explicit Losing(const SolverInput& input) : solver_(shoot_with<make>(input)) {}
    bool step() override {
        const bool done = solver_->step();
        solution_ = solver_->solution();
        for (Vec3& light : solution_.radiosity)
            light *= .97;
        return done;
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    std::unique_ptr<Solver> solver_;
    Solution solution_;
};

template <MakeStrategy make>
std::unique_ptr<EngineSolver> make_losing(const SolverInput& input) {
    return std::make_unique<Losing<make>>(input);
}

} // namespace

TEST_CASE("Flaws of an allocation are named") {
    CHECK(finds(faults_of<Flaw::half_of_rays>(), "rays do not sum to 1"));
    CHECK(finds(faults_of<Flaw::cell_without_rays>(), "a cell with power has no rays"));
    CHECK(finds(faults_of<Flaw::cell_missing>(), "not all of its power"));
    CHECK(finds(faults_of<Flaw::cell_twice>(), "some of it twice"));
    CHECK(finds(faults_of<Flaw::far_too_many>(), "neither of the hemisphere nor private"));
    CHECK_THROWS_AS(check_strategy(*find_method("matrix")), std::invalid_argument);
}

TEST_CASE("A strategy that is right passes, and light that is lost is found") {
    CHECK(faults_of<Flaw::none>() == std::vector<std::string>{});
    constexpr MakeStrategy right = make_flawed<Flaw::none>;
    const auto faults = check_strategy({.name = "losing",
                                        .summary = "",
                                        .unbiased = true,
                                        .default_stop = {},
                                        .make = make_losing<right>,
                                        .strategy = right});
    CHECK(finds(faults, "a closed room of one material"));
    CHECK(finds(faults, "a room with a block"));
}

TEST_CASE("All strategies pass", "[slow]") {
    for (const Method* const method : methods())
        if (method->strategy) {
            CAPTURE(method->name);
            CHECK(check_strategy(*method) == std::vector<std::string>{});
        }
}
