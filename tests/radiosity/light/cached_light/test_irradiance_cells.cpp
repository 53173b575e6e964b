// Cells of residuals: what they return of what was added.
#include "geometry/polygon_sampler.h"
#include "radiosity/light/cached_light/irradiance_cells.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "support/catch.h"

#include <cmath>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

Vec3 point_of(const Patch& patch, Rng& rng) {
    const double u = rng.uniform(), v = rng.uniform();
    return PolygonSampler(patch.shape).sample({u, v});
}

/// Samples all over a patch, with this residual at each point.
template <class Residual>
std::vector<IrradianceCells::Sample> samples_on(const Mesh& mesh, std::uint32_t patch,
                                                std::size_t count, const Residual& residual) {
    Rng rng(patch + 1);
    std::vector<IrradianceCells::Sample> samples;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 point = point_of(mesh.patches()[patch], rng);
        samples.push_back({patch, point, residual(point)});
    }
    return samples;
}

const std::vector<Vec3> light_of(const Mesh& mesh) {
    return std::vector<Vec3>(mesh.patches().size(), Vec3(1.0));
}

} // namespace

TEST_CASE("cells without samples have no residual, and the size of their patch") {
    const Model model(test::furnace_box(2, .5));
    const std::vector<Vec3> light = light_of(model.mesh);
    IrradianceCells cells(model.mesh, PatchLight(light));
    cells.update();
    const Patch& patch = model.mesh.patches()[3];
    CHECK(cells.at(3, patch.centre).residual == Vec3(0.0));
    CHECK(cells.at(3, patch.centre).side == Approx(std::sqrt(patch.area)));
}

TEST_CASE("the residual of a patch is the mean of its samples, shrunk by their number alone") {
    const Model model(test::furnace_box(2, .5));
    const std::vector<Vec3> light = light_of(model.mesh);
    const std::size_t count = GENERATE(1u, 4u, 16u, 48u);
    const double value = GENERATE(.1, 7.0, -3.0);
    IrradianceCells cells(model.mesh, PatchLight(light));
    // A region takes over a share of what its patches lack; another patch of it has nothing.
    cells.add(samples_on(model.mesh, 3, count, [&](const Vec3&) { return Vec3(value); }));
    cells.update();
    const double n = double(count), own = n / (n + 16);
    const double irradiance = SurfaceLight(model.mesh, PatchLight(light))
                                  .irradiance(3, model.mesh.patches()[3].centre)
                                  .value.x;
    const double of_region =
        irradiance > 0 ? std::clamp(own * value / irradiance, -.5, .5) * irradiance : 0;
    CHECK(cells.at(3, model.mesh.patches()[3].centre).residual.x ==
          Approx(own * value + (1 - own) * of_region));
}

TEST_CASE("with more samples cells become smaller, and follow what varies") {
    const Model model(test::furnace_box(1, .5));
    const std::vector<Vec3> light = light_of(model.mesh);
    const Patch& patch = model.mesh.patches()[0];
    const Frame frame = Frame::from_normal(patch.normal);
    const auto residual = [&](const Vec3& point) {
        return Vec3(1 + std::sin(5 * glm::dot(point, frame.x)));
    };
    double before = std::numeric_limits<double>::infinity(),
           side = std::numeric_limits<double>::infinity();
    for (const std::size_t count : {100u, 2000u, 40'000u, 800'000u}) {
        IrradianceCells cells(model.mesh, PatchLight(light));
        cells.add(samples_on(model.mesh, 0, count, residual));
        cells.update();
        Rng rng(5);
        double off = 0, sides = 0;
        constexpr int places = 500;
        for (int k = 0; k < places; ++k) {
            const Vec3 point = point_of(patch, rng);
            const IrradianceCells::Known known = cells.at(0, point);
            off += std::pow(known.residual.x - residual(point).x, 2) / places;
            sides += known.side / places;
        }
        CAPTURE(count, off, sides);
        CHECK(off < .5 * before);
        CHECK(sides < side);
        before = off;
        side = sides;
    }
    CHECK(std::sqrt(before) < .03);
}
