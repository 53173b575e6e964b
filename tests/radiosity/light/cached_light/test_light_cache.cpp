// Learned light against closed forms, and its error against the truth.
#include "parallel/workers.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/cached_light/page/how_wrong.h"
#include "radiosity/light/cached_light/walks.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solving/stop_flag.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "support/catch.h"

#include <cmath>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

const Method& transport() { return *find_method("stored-transport"); }

std::vector<TargetPart> parts_over(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<TargetPart> parts;
    for (const PatchPoint& point : PointsOverSurface(mesh).draw(count, seed))
        parts.push_back({{point.at}, {Vec3(1.0)}});
    return parts;
}

/// The irradiance at the points, from the light that is read [W/m2].
std::vector<Vec3> gathered(const Model& model, const SurfaceLight& light,
                           const std::vector<TargetPart>& parts, unsigned rays) {
    std::vector<Sensor> sensors;
    for (const TargetPart& part : parts)
        sensors.push_back({part.points[0], none});
    std::vector<Vec3> irradiance;
    for (const PointLight& point :
         light_at(sensors, model.mesh, model.bvh, light, {.rays = rays}, Workers(0)).lights)
        irradiance.push_back(point.irradiance);
    return irradiance;
}

/// Relative RMS.
double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double off = 0, size = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        off += glm::dot(a[k] - b[k], a[k] - b[k]);
        size += glm::dot(b[k], b[k]);
    }
    return std::sqrt(off / size);
}

} // namespace

TEST_CASE("walks find what light lacks, however wrong it is", "[slow]") {
    // In a furnace of emission 1 and reflectance 1/2 the irradiance is 2 everywhere.
    const Model model(test::furnace_box(2, .5));
    const double wrong = GENERATE(0.0, .5, 3.0);
    const std::vector<Vec3> sent(model.mesh.patches().size(), Vec3(1 + wrong));
    const SurfaceLight light(model.mesh, PatchLight(sent));
    const Walks walks(model.mesh, model.bvh, light);
    std::vector<WalkStart> starts;
    for (const PatchPoint& point : PointsOverSurface(model.mesh).draw(4000, 1)) {
        Rng rng(hash_words({starts.size()}));
        const double u = rng.uniform(), v = rng.uniform();
        starts.push_back({point.at, {u, v}, hash_words({starts.size(), 1})});
    }
    std::vector<WalkLight> found(starts.size());
    std::vector<IrradianceCells::Sample> samples;
    const std::uint64_t rays = walks.take(starts, found, samples);
    CHECK(rays > 2 * starts.size());
    double mean = 0, squares = 0;
    for (const WalkLight& walk : found) {
        const double whole = walk.direct.x + walk.read.x + walk.residual.x;
        mean += whole / double(found.size());
        squares += whole * whole / double(found.size());
    }
    const double sigma = std::sqrt((squares - mean * mean) / double(found.size()));
    CAPTURE(wrong, mean, sigma);
    CHECK(std::abs(mean - 2) < 4 * sigma + 1e-9);
    // The samples are those of the patches alone: 2 less what the light claims to arrive.
    double residual = 0;
    for (const IrradianceCells::Sample& sample : samples)
        residual += sample.residual.x / double(samples.size());
    CHECK(residual == Approx(2 - 2 * wrong).margin(.1));
}

TEST_CASE("right light is found to be right, without noise") {
    const Model model(test::furnace_box(2, .5));
    const std::vector<Vec3> sent(model.mesh.patches().size(), Vec3(2.0));
    LightCache cache(model.mesh, model.bvh, PatchLight(sent));
    const StopFlag never;
    const ReadError read =
        cache.learn(parts_over(model.mesh, 200, 1), {.error = .01}, Workers(0), never);
    CHECK(read.error < 1e-9);
    CHECK(read.bound < 1e-6);
    CHECK(read.level == Approx(2));
}

TEST_CASE("what gathers read becomes right where patches are coarse", "[slow]") {
    const Model coarse(test::room_with_block()), fine(test::room_with_block(), {.max_edge = .1});
    const Solution solution =
        test::solve(coarse, transport(), {}, {.steps = {}, .seconds = {}, .error = .05});
    const Solution accurate =
        test::solve(fine, transport(), {}, {.steps = {}, .seconds = {}, .error = .003});
    const std::vector<TargetPart> parts = parts_over(coarse.mesh, 200, 7);
    const std::vector<Vec3> truth = gathered(fine, SurfaceLight(fine.mesh, accurate), parts, 8192);
    const double before =
        difference(gathered(coarse, SurfaceLight(coarse.mesh, solution), parts, 4096), truth);
    const StopFlag never;
    int within = 0;
    constexpr int runs = 4;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        LightCache cache(coarse.mesh, coarse.bvh, solution);
        const ReadError read = cache.learn(parts, {.seed = seed, .error = .012}, Workers(0), never);
        const double after = difference(gathered(coarse, cache.light(), parts, 4096), truth);
        CAPTURE(seed, before, after, read.error, read.bound, read.rays);
        CHECK(read.bound <= .012);
        CHECK(after < .5 * before);
        CHECK(after < 1.5 * read.bound);
        within += after < read.bound + .003; // noise of both gathers
    }
    CHECK(within + 1 >= runs);
}

TEST_CASE("the error of what is read is found, small or large") {
    // Patches are small, so that few rays end too near to read what is known there.
    const Model model(test::furnace_box(16, .5));
    const double wrong = GENERATE(.02, .1, .4);
    const std::vector<Vec3> sent(model.mesh.patches().size(), Vec3(2 - wrong));
    const StopFlag never;
    // The first round judges the light of patches alone; so few rays end it.
    LightCache cache(model.mesh, model.bvh, PatchLight(sent));
    const ReadError read = cache.learn(parts_over(model.mesh, 200, 3),
                                       {.error = 1e-9, .max_rays = 1}, Workers(0), never);
    CHECK(read.error == Approx(wrong / 2).epsilon(.2));
    CHECK(read.bound > read.error);
}

TEST_CASE("learned light does not depend on the number of threads, and a signal ends it") {
    const Model model(test::room_with_block());
    const Solution solution = test::solve(model, transport(), {}, test::steps(1));
    const std::vector<TargetPart> parts = parts_over(model.mesh, 60, 1);
    const auto learned = [&](unsigned threads) {
        LightCache cache(model.mesh, model.bvh, solution);
        const StopFlag never;
        const ReadError read =
            cache.learn(parts, {.error = .03, .max_rays = 300'000}, Workers(threads), never);
        std::vector<Vec3> light{Vec3(read.error, read.bound, double(read.rays))};
        for (const TargetPart& part : parts)
            light.push_back(
                cache.light().irradiance(part.points[0].facet, part.points[0].position).value);
        return light;
    };
    CHECK((learned(1) == learned(3)));
    LightCache cache(model.mesh, model.bvh, solution);
    StopFlag interrupted;
    interrupted.set_wished(true);
    CHECK(std::isnan(cache.learn(parts, {}, Workers(0), interrupted).error));
}

TEST_CASE("the page of learned light and the engine find the same light and the same error",
          "[slow]") {
    const Model model(test::furnace_box(16, .5));
    const double wrong = GENERATE(.1, .5);
    const std::vector<Vec3> sent(model.mesh.patches().size(), Vec3(2 - wrong));
    const std::vector<TargetPart> parts = parts_over(model.mesh, 100, 3);
    std::vector<SurfacePoint> points;
    for (const TargetPart& part : parts)
        points.push_back(part.points[0]);
    const PlainAnswer plain =
        how_wrong(model.mesh, model.bvh, PatchLight(sent), points, 4, 256, 1024, 1);
    CHECK(std::sqrt(plain.squared_error[0]) == Approx(wrong).epsilon(.1)); // of 2
    CHECK(plain.squared_error[3] < .1 * plain.squared_error[0]);
    for (const Vec3& irradiance : plain.irradiance)
        CHECK(irradiance.x == Approx(2).epsilon(.02));
    LightCache cache(model.mesh, model.bvh, PatchLight(sent));
    const StopFlag never;
    const ReadError read = cache.learn(parts, {.error = .005}, Workers(0), never);
    CHECK(read.bound <= .005);
    for (const Vec3& irradiance : gathered(model, cache.light(), parts, 4096))
        CHECK(irradiance.x == Approx(2).epsilon(.03));
}
