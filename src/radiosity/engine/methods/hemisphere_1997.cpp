// The hemisphere subdivision technique of 1997 (paper section 4; Jolivet and Plemenos, GraphiCon
// 1997), which section 5 improves upon.
//
// A patch is cut, in thought, into --parts parts with a divided hemisphere over the centre of each
// (subdivision_1997.h). In each of n steps, --stored-steps, all triangles are divided into four at
// new directions on their edges. These lie nearer to the end where more surfaces were counted, and
// the counts along them are stored with them. In m further steps, --estimated-steps, triangles are
// divided likewise, but with estimated counts, and nothing is stored. Every triangle gets the same
// number of rays and power by its area: where many surfaces are, triangles are small and rays
// close. After n + m steps plain progressive refinement follows, the method
// `progressive-monte-carlo`.
//
// By default the area of a triangle is its projected solid angle, so that Lambert's law holds
// (docs/paper/decisions.md, D1). Rays start anywhere on the part (D2). If there are fewer rays than
// triangles, they are allocated by systematic sampling (D4). Counting rays are shot before the
// first step and carry no energy.
//
// With --literal the area is the solid angle, rays start at the centre of the part, and each
// triangle gets one ray at least. Subdivision then goes on between the steps: each begins by
// dividing once more. The rays that count carry energy too. Besides its random rays, each triangle
// shoots one through each corner that the step has found, all with the same part of its power
// (docs/paper/decisions.md, D61). --depth and --threshold are not used.
//
// The method is good for comparison. It is bad because large triangles, where few surfaces are, get
// as few rays as small ones: these rays carry much power each and their noise is seen. With the
// usual numbers it costs 41 rays per part and 13 bytes for each of them, as directions are stored
// in floats. That is 2132 bytes per patch, where the method `hemisphere` needs 41. Each further
// step has four times as many triangles, and there should not be many more of them than rays.

#include "parallel/workers.h"
#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/shooting/shooting.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

static_assert(Subdivision1997::max_triangles < whole_hemisphere);

class Hemisphere1997 final : public Strategy, StepHook, PrivateCells {
  public:
    Hemisphere1997(const SolverInput& input, const Workers& workers)
        : input_(input), workers_(workers), printed_(input.options.literal),
          numbers_(own_options<Subdivision1997Options>(input.options)),
          subdivision_(input.mesh, input.needs, numbers_) {
        if (!printed_)
            find(static_cast<int>(numbers_.stored_steps)); // later steps will find no more
        begin_step(0);
    }

    void begin_step(std::uint64_t step) override {
        allocated_.clear();
        find(static_cast<int>(std::min<std::uint64_t>(step + 1, numbers_.stored_steps)));
        if (step >= numbers_.stored_steps + numbers_.estimated_steps) {
            allocated_.add(whole_hemisphere, 1);
            return;
        }
        level_ = static_cast<int>(step) + 1;
        const std::size_t cells = subdivision_.parts() * triangles();
        const double share = 1 / static_cast<double>(cells);
        for (std::size_t cell = 0; cell < cells; ++cell)
            allocated_.add(static_cast<std::uint16_t>(cell),
                           printed_ ? rays_as_printed(cell, share) / input_.options.rays : share);
    }

    Allocation allocate(std::uint32_t, AllocatedCells&) const override { return allocated_.view(); }
    [[nodiscard]] StepHook* step_hook() override { return this; }
    [[nodiscard]] const PrivateCells* private_cells() const override { return this; }

    [[nodiscard]] std::optional<PrivateCell> private_cell(std::uint32_t patch,
                                                          std::uint16_t cell) const override {
        if (cell == whole_hemisphere)
            return std::nullopt;
        const Patch& whole = input_.mesh.patches()[patch];
        const std::size_t part = cell / triangles(), index = cell % triangles();
        const CountedTriangle corner = subdivision_.triangle(patch, part, level_, index);
        PrivateCell result{.power = 0,
                           .shape = {corner[0].direction, corner[1].direction, corner[2].direction},
                           .origins = part_of(whole.shape, subdivision_.parts(), part)};
        const double share = printed_ ? result.shape.solid_angle() / (2 * std::numbers::pi)
                                      : result.shape.projected_solid_angle() / std::numbers::pi;
        result.power = result.origins.area() / whole.area * std::max(share, 0.0);
        if (printed_)
            for (const std::size_t found : subdivision_.corners_found(level_, index))
                result.direction[result.given++] = density_direction(corner[found].direction);
        return result;
    }

    [[nodiscard]] std::uint64_t density_rays() const override { return subdivision_.rays(); }
    [[nodiscard]] std::uint64_t density_bytes() const override { return subdivision_.bytes(); }

  private:
    void find(int level) { subdivision_.find(level, input_.tracer, workers_, input_.monitor); }

    /// Returns the number of triangles of a part, at the current level.
    [[nodiscard]] std::size_t triangles() const { return Subdivision1997::triangles(level_); }

    /// Returns the same number for every triangle, besides the rays that count.
    [[nodiscard]] double rays_as_printed(std::size_t cell, double share) const {
        return std::max(std::round(input_.options.rays * share), 1.0) +
               static_cast<double>(subdivision_.corners_found(level_, cell % triangles()).size());
    }

    SolverInput input_;
    Workers workers_;
    bool printed_;
    Subdivision1997Options numbers_;
    Subdivision1997 subdivision_;
    int level_ = 1;            ///< level of the present step's triangles
    AllocatedCells allocated_; ///< the same for all patches
};

std::unique_ptr<Strategy> make_hemisphere_1997(const SolverInput& input, const Hemisphere&,
                                               const Workers& workers) {
    return std::make_unique<Hemisphere1997>(input, workers);
}

std::vector<MethodOption> options() {
    using Own = Subdivision1997Options;
    return {number_option("--stored-steps", "n, steps that divide triangles by counts [2]",
                          &Own::stored_steps, Subdivision1997::stored_choices),
            number_option("--estimated-steps", "m, steps after them, by estimated counts [1]",
                          &Own::estimated_steps, Subdivision1997::estimated_choices),
            number_option("--parts", "parts of a patch, each with a hemisphere [4]", &Own::parts,
                          Subdivision1997::part_choices)};
}

void check(const SolveOptions& options, std::size_t) {
    Subdivision1997::check(own_options<Subdivision1997Options>(options));
}

double bytes(const SolveOptions& options, double patches) {
    return patches * Subdivision1997::bytes_of_patch(own_options<Subdivision1997Options>(options));
}

} // namespace

extern const Method hemisphere_1997_method{
    .name = "hemisphere-1997",
    .summary = "triangles shrunk towards many surfaces (Jolivet and Plemenos 1997; paper 4)",
    .has_literal = true,
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_hemisphere_1997, true>,
    .strategy = make_hemisphere_1997,
    .work = {.densities = true, .passes = true},
    .plain =
        [](const SolverInput& input) {
            return plain::hemisphere_1997(input,
                                          own_options<Subdivision1997Options>(input.options));
        },
    .role = Role::forerunner,
    .aims = has_aimer,
    .options = options,
    .check = check,
    .bytes = bytes,
};

} // namespace hemilux
