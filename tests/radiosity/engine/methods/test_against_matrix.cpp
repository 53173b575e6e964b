// Proof of the estimators: every unbiased method against the reference, patch by patch, on scenes
// with occlusion, within the standard errors that both report.
#include "support/catch.h"
#include "support/example_scenes.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace hemilux;
using test::example_scene;
using test::Model;

namespace {

/// How far runs of a method, with different seeds, are off from the reference, beside the standard
/// errors that they report. A squared deviation is divided by the mean over the runs of the squared
/// standard error: each single one scatters, and the square of Student's t has the mean 3 where
/// four steps are behind it.
class Deviations {
  public:
    Deviations(const Mesh& mesh, const Solution& exact)
        : mesh_(mesh), exact_(exact), patches_(exact.radiosity.size()) {
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            const Vec3& sigma = exact.standard_error[i];
            exact_variance_ += mesh.patches()[i].area * glm::dot(sigma, sigma);
        }
    }

    void add(const Solution& s) {
        const double true_one = true_error(mesh_, s.radiosity, exact_.radiosity).all;
        ratios_.push_back(estimated_error(mesh_, s) / true_one);
        variance_ += s.variance.value() + exact_variance_;
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            const Vec3 off = s.radiosity[i] - exact_.radiosity[i];
            const Vec3 &sigma = s.standard_error[i], &exact_sigma = exact_.standard_error[i];
            patches_[i].off += off;
            patches_[i].squares += off * off;
            patches_[i].variance += sigma * sigma + exact_sigma * exact_sigma;
            patches_[i].hits += s.hits[i];
            squares_ += mesh_.patches()[i].area * glm::dot(off, off);
        }
    }

    /// Of a patch and a channel, with 30 hits a run or more.
    [[nodiscard]] double pairs() const {
        return sum_over_pairs([](double, double, double) { return 1.0; });
    }
    [[nodiscard]] double mean_score() const {
        return sum_over_pairs([&](double off, double, double variance) {
                   return off / std::sqrt(runs() * variance);
               }) /
               pairs();
    }
    [[nodiscard]] double rms_score() const {
        return std::sqrt(sum_over_pairs([](double, double squares, double variance) {
                             return squares / variance;
                         }) /
                         pairs());
    }
    /// True over reported error of the whole solution, both as the RMS over the runs.
    [[nodiscard]] double rms_ratio() const { return std::sqrt(squares_ / variance_); }
    /// Estimated over true error of a run.
    [[nodiscard]] double median_ratio() const {
        std::vector<double> sorted = ratios_;
        std::ranges::sort(sorted);
        return sorted[sorted.size() / 2];
    }

  private:
    /// Sums over the runs.
    struct PatchSums {
        Vec3 off{0.0}, squares{0.0}, variance{0.0};
        std::uint64_t hits = 0;
    };
    [[nodiscard]] double runs() const { return static_cast<double>(ratios_.size()); }

    /// Patches are chosen by the hits of all runs: those of one run would prefer runs in which
    /// much light arrived.
    template <class Term>
    [[nodiscard]] double sum_over_pairs(const Term& term) const {
        double sum = 0;
        for (const PatchSums& patch : patches_)
            for (int c = 0; c < 3; ++c)
                if (patch.hits >= 30 * ratios_.size() && patch.variance[c] > 0)
                    sum += term(patch.off[c], patch.squares[c], patch.variance[c]);
        return sum;
    }

    const Mesh& mesh_;
    const Solution& exact_;
    std::vector<PatchSums> patches_;
    std::vector<double> ratios_;
    double exact_variance_ = 0;         ///< area times variance of the reference
    double squares_ = 0, variance_ = 0; ///< area times deviation squared and variance, all runs
};

} // namespace

TEST_CASE("Deviations from matrix are those of the reported errors", "[slow]") {
    // The spread of n batches or steps divided by n in place of n - 1 makes standard errors too
    // small by sqrt((n - 1) / n). With few of them this shows: shooting takes n = 4 steps, which
    // makes .87, and stored-transport has n = 8 batches, which makes .94. Over 16 runs of some
    // hundred independent patches both ratios below scatter by .01 (jackknife over the runs).
    constexpr int runs = 16;
    for (const std::string scene :
         {"cornell_box", "room_1002", "open_scene", "wall_before_crowd"}) {
        const Model model(example_scene(scene));
        const Solution exact = test::reference(model, .002);
        for (const Method* method : methods()) {
            const bool gathers = method->name == "stored-transport";
            if (!method->unbiased && !gathers)
                continue;
            Deviations all(model.mesh, exact);
            for (int run = 0; run < runs; ++run) {
                SolveOptions options;
                options.seed = 31 + std::uint64_t(run);
                if (!gathers) // whose steps grow where their number is not known
                    options.stop = test::steps(4);
                all.add(test::solve(model, *method, options, test::steps(gathers ? 3 : 4)));
            }
            CAPTURE(scene, method->name, all.pairs(), all.mean_score(), all.rms_score(),
                    all.rms_ratio(), all.median_ratio());
            CHECK(all.pairs() > 900);
            CHECK(std::abs(all.mean_score()) < .04);
            // The variance of the whole solution has no allowance: an unbiased estimate of it is
            // right on average.
            CHECK(all.rms_ratio() > .95);
            CHECK(all.rms_ratio() < 1.05);
            // A patch's standard error is pooled over neighbours, or from its own spread where that
            // is more, which makes it larger by some 7 % where spreads are those of four steps.
            // That of stored-transport is raised further where neighbours err together, by 12 to 23
            // %.
            CHECK(all.rms_score() > (gathers ? .7 : .88));
            CHECK(all.rms_score() < (gathers ? .92 : 1));
            // Where few patches make most of the error, and all err together, as in the open scene,
            // the reported one is raised (error_spread.h), after four steps by some 12 %.
            CHECK(all.median_ratio() > .9);
            CHECK(all.median_ratio() < (scene == "open_scene" ? 1.15 : 1.1));
        }
    }
}

TEST_CASE("The error falls as one over the root of the rays, over three decades", "[slow]") {
    const Model model(test::room_with_block());
    const Solution exact = test::reference(model, .001);
    for (const Method* method : methods()) {
        if (!method->unbiased)
            continue;
        Monitor monitor;
        SolveOptions options;
        options.rays = 16;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = method->make(input);
        std::vector<double> scaled; // error sqrt(rays): constant if there is no floor
        run(*solver, input, test::steps(4000), [&](const StepRecord& record, const Solution& s) {
            if (record.step == 4 || record.step == 40 || record.step == 400 || record.step == 4000)
                scaled.push_back(true_error(model.mesh, s.radiosity, exact.radiosity).all *
                                 std::sqrt(double(s.rays_energy)));
        });
        CAPTURE(method->name, scaled);
        REQUIRE(scaled.size() == 4);
        for (const double value : scaled)
            CHECK(value == Approx(scaled[0]).epsilon(.25));
    }
}

TEST_CASE("Plain Monte Carlo has its known error on the lit cube", "[slow]") {
    // V[B_i] = rho_i Phi_T (B_i - E_i) / (A_i N) makes error sqrt(N) = 9.29.
    const Model model(test::cube_with_lit_floor(4, .5));
    const Solution exact = test::reference(model, .0002);
    constexpr int runs = 60;
    double squares = 0;
    for (int run = 0; run < runs; ++run) {
        SolveOptions options;
        options.rays = 200;
        options.seed = 500 + std::uint64_t(run);
        const Solution s =
            test::solve(model, *find_method("progressive-monte-carlo"), options, test::steps(8));
        const double error = true_error(model.mesh, s.radiosity, exact.radiosity).all;
        squares += error * error * double(s.rays_energy) / runs;
    }
    CHECK(std::sqrt(squares) == Approx(9.29).epsilon(.05));
}

TEST_CASE("The reference reports its own error", "[slow]") {
    // Its spread is that of 8 batches.
    constexpr int runs = 40;
    const Model model(test::room_with_block());
    const Solution fine = test::reference(model, .001);
    for (const std::uint32_t n : {1u, 3u}) {
        Deviations all(model.mesh, fine);
        for (int run = 0; run < runs; ++run) {
            SolveOptions options;
            options.seed = 231 + std::uint64_t(run);
            all.add(test::solve(model, *find_method("matrix"), options, test::steps(n)));
        }
        CAPTURE(n, all.mean_score(), all.rms_score(), all.rms_ratio(), all.median_ratio());
        CHECK(std::abs(all.mean_score()) < .05);
        CHECK(all.rms_ratio() > .95);
        CHECK(all.rms_ratio() < 1.05);
        CHECK(all.rms_score() > .85);
        CHECK(all.rms_score() < .98);
        CHECK(all.median_ratio() > .9);
        CHECK(all.median_ratio() < 1.1);
    }
}
