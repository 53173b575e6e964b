#include "app/outputs/useful_picture.h"

#include "radiosity/answers/images/ssim.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <optional>
#include <vector>

namespace hemilux {
namespace {

/// Pictures are judged at this size, as those of the paper: the windows of the index are in pixels.
constexpr int width = 640;

/// Returns what a ray brings to a patch, times its area, in the mean over patches that rays have
/// met [W].
Vec3 light_of_a_ray(const Mesh& mesh, const Solution& solution) {
    Vec3 sum(0.0);
    double patches = 0;
    for (std::uint32_t i = 0; i < solution.hits.size(); ++i)
        if (solution.hits[i] > 0) {
            sum += mesh.patches()[i].area * solution.standard_error[i] /
                   std::sqrt(double(solution.hits[i]));
            ++patches;
        }
    return patches > 0 ? sum / patches : sum;
}

/// Returns the light with as much noise once more, by standard errors of either sign; nothing where
/// they are not known.
std::optional<std::vector<Vec3>> with_noise(const Mesh& mesh, const Solution& solution,
                                            std::uint64_t seed) {
    const Vec3 of_a_ray = light_of_a_ray(mesh, solution);
    std::vector<Vec3> light = solution.radiosity;
    for (std::uint32_t i = 0; i < light.size(); ++i) {
        Vec3 error = solution.standard_error[i];
        if (solution.hits[i] == 0 && error == Vec3(0.0) &&
            mesh.material(i).reflectance != Vec3(0.0))
            error = of_a_ray / mesh.patches()[i].area;
        if (!std::isfinite(mean_of_channels(error)))
            return {};
        light[i] += hash_words({seed, solution.steps, i}) % 2 == 0 ? error : -error;
        light[i] = glm::max(light[i], 0.0);
    }
    return light;
}

} // namespace

double UsefulPicture::similarity(const Solution& solution) {
    const std::optional<std::vector<Vec3>> noisy = with_noise(mesh_, solution, seed_);
    if (!noisy)
        return 0;
    const LitScene scene{mesh_, tracer_, solution.radiosity, threads_};
    if (!view_.camera)
        view_.camera = camera_of(view_, scene);
    const int height =
        std::max(1, static_cast<int>(double(width) * view_.size.height / view_.size.width));
    const auto picture_of = [&](std::span<const Vec3> radiosity) {
        return render(mesh_, tracer_, radiosity, *view_.camera,
                      {.width = width, .height = height, .threads = threads_});
    };
    const Image picture = picture_of(solution.radiosity);
    choose_exposure(view_, picture, scene, *view_.camera);
    const Display display = display_of(view_);
    return ssim_without_noise(luma_of(picture, display), luma_of(picture_of(*noisy), display));
}

} // namespace hemilux
