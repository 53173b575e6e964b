#include "module/own_strategy.h"

#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/pages/step.h"

#include <stdexcept>
#include <string>

namespace hemilux::lesson {
namespace {

using plain::Due;
using plain::RayNumbers;
using plain::Rays;
using plain::Step;
using plain::StepSolver;

struct Triangle {
    const Hemisphere::Cell* cell;
    double rays, power; ///< shares [-]
};

class OwnStrategy final : public StepSolver {
  public:
    OwnStrategy(const SolverInput& input, std::span<const double> numbers, const OwnRules& rules)
        : StepSolver(input, !rules.rounded), hemisphere_(input.options.depth), rules_(rules) {
        for (std::size_t patch = 0; patch < input.mesh.patches().size(); ++patch) {
            triangles_.emplace_back();
            for (auto left = static_cast<std::size_t>(next(numbers)); left > 0; --left)
                triangles_.back().push_back(triangle(numbers));
        }
        if (!numbers.empty())
            throw std::invalid_argument("there are more triangles than patches have");
    }

  private:
    static double next(std::span<const double>& numbers) {
        if (numbers.empty() || !(numbers.front() >= 0))
            throw std::invalid_argument("a share is missing, negative or no number");
        const double value = numbers.front();
        numbers = numbers.subspan(1);
        return value;
    }

    Triangle triangle(std::span<const double>& numbers) const {
        const auto cell = static_cast<std::size_t>(next(numbers));
        if (cell >= hemisphere_.cells().size())
            throw std::invalid_argument("there is no triangle " + std::to_string(cell));
        const double rays = next(numbers), power = next(numbers);
        return {&hemisphere_.cells()[cell], rays, power};
    }

    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        constexpr double not_shot = 1e-4;
        const double rest = rules_.rounded ? not_shot * result.power_unshot() : 0;
        for (std::uint64_t bounce = 0; result.power_unshot() > rest; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean))
                shoot(due, result);
            result.reflect();
        }
        return true;
    }

    void shoot(const Due& due, Step& result) const {
        const Patch& patch = input_.mesh.patches()[due.patch];
        const Frame frame = input_.mesh.hemisphere_frame(due.patch);
        double all = 0, up_to = 0; // shares of rays
        for (const Triangle& t : triangles_[due.patch])
            all += t.rays;
        for (std::uint32_t number = 0; const Triangle& t : triangles_[due.patch]) {
            const double from = up_to / all, to = (up_to += t.rays) / all;
            const Rays N_tr = rules_.rounded ? plain::rays_rounded(input_.options.rays * t.rays)
                                             : plain::rays_on_line(due, from, to);
            const Vec3 Phi_ray = 1 / N_tr.divisor * t.power * result.unshot[due.patch];
            for (std::uint64_t ray = 0; ray < N_tr.number; ++ray) {
                RayNumbers random(due.key, number++);
                const Vec3 direction = frame.to_world(t.cell->shape.sample_rejection(random));
                const Vec3 start =
                    rules_.from_centre ? patch.centre : patch.shape.sample(random.start());
                result.shoot(patch, start, direction, Phi_ray);
            }
        }
    }

    Hemisphere hemisphere_;
    OwnRules rules_;
    std::vector<std::vector<Triangle>> triangles_; ///< triangles of each patch
};

} // namespace

std::unique_ptr<Solver> own_strategy(const SolverInput& input, std::span<const double> triangles,
                                     const OwnRules& rules) {
    return std::make_unique<OwnStrategy>(input, triangles, rules);
}

} // namespace hemilux::lesson
