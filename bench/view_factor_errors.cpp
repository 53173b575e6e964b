// Reported errors of view factors against true ones, which are found by brute force: a number of
// pairs of a scene, half of them exact ones.
//
//     hemilux_view_factor_errors SCENE.obj [PAIRS] [ERROR] [SEED]
//
// It prints the processor time of the factors; how far exact ones are from the truth at most; and
// of estimates the root mean square and the shares of z = (factor - truth) / error, where the error
// is that of both, and their relative errors. Factors are those of at least 0.001.

#include "bvh/wide/wide_bvh.h"
#include "geometry/polygon_sampler.h"
#include "io/scene_files/obj.h"
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <vector>

namespace {

using namespace hemilux;

constexpr double least_factor = 1e-3;

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// The factor between two patches: the contour integral times the share of the kernel that 2^16
/// pairs of points see of each other, in 16 independent batches.
OpenShare brute_force(const Mesh& mesh, const Tracer& tracer, std::uint32_t i, std::uint32_t j) {
    constexpr int batches = 16, of_batch = 1 << 12;
    constexpr std::array<double, 4> step = {.8566748838545029, .7338918566271260, .6287067210378087,
                                            .5385972572236101};
    const Patch &a = mesh.patches()[i], &b = mesh.patches()[j];
    const PolygonSampler of_a(a.shape), of_b(b.shape);
    std::array<double, batches> share{};
    for (std::uint64_t batch = 0; batch < batches; ++batch) {
        Rng random(hash_words({99, i, j, batch}));
        std::array<double, 4> u;
        for (double& x : u)
            x = random.uniform();
        double seen = 0, all = 0;
        for (int k = 0; k < of_batch; ++k) {
            const Vec3 x = of_a.sample({u[0], u[1]}), y = of_b.sample({u[2], u[3]}), d = y - x;
            const double square = glm::dot(d, d);
            const double kernel = std::max(0.0, glm::dot(d, a.normal)) *
                                  std::max(0.0, -glm::dot(d, b.normal)) / (square * square);
            const Ray ray{.origin = x, .direction = d, .t_max = 1 - 1e-12, .from = a.facet};
            all += kernel;
            seen += kernel > 0 && !tracer.occluded(ray, b.facet) ? kernel : 0;
            for (std::size_t axis = 0; axis < 4; ++axis)
                u[axis] += step[axis] - std::floor(u[axis] + step[axis]);
        }
        share[batch] = all > 0 ? seen / all : 0;
    }
    const double mean = std::accumulate(share.begin(), share.end(), 0.0) / batches;
    double squares = 0;
    for (const double x : share)
        squares += (x - mean) * (x - mean);
    const double free = exchange_area(a.shape, b.shape) / a.area;
    return {free * mean, free * std::sqrt(squares / (batches * (batches - 1)))};
}

/// Of factors that are estimates.
struct Errors {
    int pairs = 0, beyond_two = 0, beyond_far = 0;
    double squares = 0, relative_squares = 0, worst = 0;

    void add(const OpenShare& found, const OpenShare& truth) {
        constexpr double far = 3.5;
        const double error = std::hypot(found.standard_error, truth.standard_error);
        const double z = std::abs(found.factor - truth.factor) / error;
        ++pairs;
        beyond_two += z > 2;
        beyond_far += z > far;
        squares += z * z;
        const double relative = std::abs(found.factor / truth.factor - 1);
        relative_squares += relative * relative;
        worst = std::max(worst, relative);
    }
};

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr,
                     "usage: hemilux_view_factor_errors SCENE.obj [PAIRS] [ERROR] [SEED]\n");
        return 1;
    }
    const int pairs = argc > 2 ? std::atoi(argv[2]) : 200;
    const double error = argc > 3 ? std::atof(argv[3]) : .015;
    const auto seed = static_cast<std::uint64_t>(argc > 4 ? std::atol(argv[4]) : 1);
    const Mesh mesh = layered_mesh(read_obj(argv[1], {}, false).scene, {});
    const double start = processor_seconds();
    const WideBvh tree(mesh.soup_to_trace(), {.threads = 1});
    std::vector<std::uint32_t> row_of(mesh.patches().size());
    std::iota(row_of.begin(), row_of.end(), 0u);
    Monitor monitor;
    const ViewFactors factors = view_factors(
        mesh, tree, row_of, row_of.size(),
        {.tolerance = relative_above(error, least_factor), .seed = seed}, Workers(1), monitor);
    std::printf("%zu patches, %zu factors, %.2f s of a processor\n", factors.rows(),
                factors.column.size(), processor_seconds() - start);
    Errors errors;
    Rng random(hash_words({seed, 17}));
    int exact = 0;
    double worst_of_exact = 0;
    for (int tries = 0; exact + errors.pairs < pairs && tries < 1000 * pairs; ++tries) {
        const auto i = static_cast<std::uint32_t>(random.uniform() * double(factors.rows()));
        const std::size_t begin = factors.row_begin[i], end = factors.row_begin[i + 1];
        const auto k = begin + static_cast<std::size_t>(random.uniform() * double(end - begin));
        if (begin == end || factors.factor[k] < least_factor)
            continue;
        const OpenShare found{factors.factor[k], factors.standard_error[k]};
        const bool is_exact = found.standard_error == 0;
        if (is_exact && exact >= pairs / 2)
            continue;
        const OpenShare truth = brute_force(mesh, tree, i, factors.column[k]);
        if (is_exact) {
            ++exact;
            worst_of_exact = std::max(worst_of_exact, std::abs(found.factor - truth.factor));
        } else if (truth.factor > 0) {
            errors.add(found, truth);
        }
    }
    std::printf("%d exact ones: off by %.1g at most\n", exact, worst_of_exact);
    const double count = errors.pairs;
    std::printf("%d estimates: z rms %.3f, beyond 2 in %.2f %%, beyond 3.5 in %.2f %%\n",
                errors.pairs, std::sqrt(errors.squares / count), 100 * errors.beyond_two / count,
                100 * errors.beyond_far / count);
    std::printf("relative error of these: %.2f %% rms, %.1f %% at most\n",
                100 * std::sqrt(errors.relative_squares / count), 100 * errors.worst);
}
