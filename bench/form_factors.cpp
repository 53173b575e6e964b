// How far form factors by hemicubes and by rays are off, at equal numbers of rays.
//
//     form_factors SCENE.obj [MAX_EDGE]
//
// Prints a row for each number N of pixels along the edge of a hemicube: seconds for all factors of
// the scene and their errors, then the same for 3 N^2 rays a patch. The truth is contour
// integration, so only pairs with nothing in between count. Errors are the mean of |F - F*| over
// the mean of F*, and the largest |F - F*|. The last row is the closed form of a patch's centre:
// what hemicubes come to with ever more pixels. One thread.
#include "bvh/wide/wide_bvh.h"
#include "clock.h"
#include "geometry/projected_polygon.h"
#include "io/scene_files/obj.h"
#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/form_factors/closed_form_factors.h"
#include "radiosity/engine/form_factors/sampled_form_factors.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

using namespace hemilux;

namespace {

struct Errors {
    double off = 0, truth = 0, largest = 0;

    void add(double factor, double exact) {
        off += std::abs(factor - exact);
        truth += exact;
        largest = std::max(largest, std::abs(factor - exact));
    }
    [[nodiscard]] double mean() const { return off / truth; }
};

/// Of all pairs that are known. `factor_of(i, row)` fills a row of the matrix.
template <class FillRow>
Errors errors_of(const ClosedFormFactors& exact, std::uint32_t patches, const FillRow& fill_row) {
    Errors errors;
    std::vector<double> row(patches);
    for (std::uint32_t i = 0; i < patches; ++i) {
        std::ranges::fill(row, 0.0);
        fill_row(i, row);
        for (std::uint32_t j = 0; j < patches; ++j)
            if (const std::optional<double> known = exact.factor(i, j))
                errors.add(row[j], *known);
    }
    return errors;
}

Errors errors_of(const ClosedFormFactors& exact, const SparseMatrix& matrix) {
    return errors_of(exact, static_cast<std::uint32_t>(matrix.rows()),
                     [&](std::uint32_t i, std::vector<double>& row) {
                         for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k)
                             row[matrix.column[k]] += matrix.value[k];
                     });
}

Errors errors_of_centres(const ClosedFormFactors& exact, const Mesh& mesh) {
    const auto patches = mesh.patches();
    return errors_of(
        exact, static_cast<std::uint32_t>(patches.size()),
        [&](std::uint32_t i, std::vector<double>& row) {
            const Frame frame = Frame::from_normal(patches[i].normal);
            for (std::uint32_t j = 0; j < row.size(); ++j)
                if (glm::dot(patches[j].normal, patches[i].centre - patches[j].centre) > 0 &&
                    patches[j].facet != patches[i].facet)
                    row[j] = ProjectedPolygon(patches[i].centre, frame, patches[j].shape).factor();
        });
}

void measure(const Mesh& mesh) {
    const WideBvh bvh(mesh.soup_to_trace(), {.threads = 1});
    const Workers all(0), one(1);
    Monitor monitor;
    const ClosedFormFactors exact(mesh, bvh, all, monitor);
    std::printf("%zu patches, %llu pairs by contour integration, %llu left out\n\n",
                mesh.patches().size(), static_cast<unsigned long long>(exact.clear_pairs()),
                static_cast<unsigned long long>(exact.other_pairs()));
    std::printf("            hemicube                  rays\n"
                "   N  3 N^2     time    mean  largest     time    mean  largest\n");
    for (const std::uint32_t edge : {16u, 32u, 64u, 128u, 256u, 512u}) {
        double started = bench::cpu_seconds();
        const HemicubeFormFactors cubes =
            hemicube_form_factors(Hemicube(edge), mesh, bvh, one, monitor);
        const double seconds_of_cubes = bench::cpu_seconds() - started;
        const Errors of_cubes = errors_of(exact, cubes.matrix);
        started = bench::cpu_seconds();
        SampledFormFactors samples(mesh, bvh, {}, 1);
        samples.trace_up_to(3 * edge * edge, one, monitor);
        const SparseMatrix sampled = samples.matrix();
        const double seconds_of_rays = bench::cpu_seconds() - started;
        const Errors of_rays = errors_of(exact, sampled);
        std::printf("%4u %6u %6.2f s %6.3g%%  %.5f  %6.2f s %6.3g%%  %.5f\n", edge, 3 * edge * edge,
                    seconds_of_cubes, 100 * of_cubes.mean(), of_cubes.largest, seconds_of_rays,
                    100 * of_rays.mean(), of_rays.largest);
    }
    const Errors of_centres = errors_of_centres(exact, mesh);
    std::printf("centre               %6.3g%%  %.5f\n", 100 * of_centres.mean(),
                of_centres.largest);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::fprintf(stderr, "usage: form_factors SCENE.obj [MAX_EDGE]\n");
        return 1;
    }
    try {
        const double max_edge = argc > 2 ? std::atof(argv[2]) : 0;
        measure(Mesh(read_obj(argv[1]).scene, {.max_edge = max_edge}));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "form_factors: %s\n", error.what());
        return 2;
    }
}
