#include "app/outputs/layered_picture.h"

#include "app/rendering/view.h"
#include "io/files/error.h"
#include "parallel/workers.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/answers/vertices/baked_light.h"
#include "radiosity/engine/densities/density.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>

namespace hemilux {
namespace {

constexpr std::uint32_t no_patch = std::numeric_limits<std::uint32_t>::max();

/// Returns the patch in the middle of each pixel. Colours in a picture of one sample a pixel are
/// the numbers themselves, in two halves that a float holds exactly.
std::vector<std::uint32_t> patches_in(const Results& results, const Camera& camera,
                                      const RenderOptions& options) {
    constexpr std::uint32_t half = 1u << 16;
    std::vector<Vec3> names;
    for (std::uint32_t i = 0; i < results.mesh.patches().size(); ++i)
        names.emplace_back(i / half, i % half, 1);
    const Image image = render(results.mesh, results.tracer, names, camera, options);
    std::vector<std::uint32_t> patches;
    for (const glm::vec3& pixel : image.pixels)
        patches.push_back(pixel.b > 0 ? static_cast<std::uint32_t>(pixel.r) * half +
                                            static_cast<std::uint32_t>(pixel.g)
                                      : no_patch);
    return patches;
}

/// Returns by patch the mean density of its hemisphere, weighted by Lambert's law [surfaces per
/// ray]. Empty when interrupted.
std::vector<double> mean_densities(const Results& results) {
    const Hemisphere hemisphere(results.options.depth);
    const DensityMap map(results.mesh, results.tracer, hemisphere, results.options.threshold,
                         Workers(results.options.threads), results.monitor);
    if (results.monitor.interrupted)
        return {};
    std::vector<double> means;
    std::vector<DensityLeaf> leaves;
    for (std::uint32_t i = 0; i < results.mesh.patches().size(); ++i) {
        leaves.clear();
        map.leaves(i, leaves);
        double sum = 0;
        for (const auto& [cell, density] : leaves)
            sum += double(density) * hemisphere.cells()[cell].shape.projected_solid_angle();
        means.push_back(sum / std::numbers::pi);
    }
    return means;
}

template <class Value>
Image picture_of(const Image& light, const std::vector<std::uint32_t>& patches, Value value) {
    Image image(light.width, light.height);
    for (std::size_t k = 0; k < patches.size(); ++k)
        if (patches[k] != no_patch)
            image.pixels[k] = glm::vec3(value(patches[k]));
    return image;
}

} // namespace

void add_lamp_channels(std::vector<ExrChannel>& channels, const LampLayers& lamps,
                       std::span<const Image> images) {
    const std::vector<std::string> names = channel_names(lamps);
    for (std::size_t k = 0; k < images.size(); ++k)
        add_exr_channels(channels, names[k], images[k]);
}

std::vector<ExrChannel> picture_layers(const Results& results, const Image& light,
                                       std::span<const Image> lamps, const Camera& camera) {
    const Solution& solution = results.solution;
    RenderOptions options{.width = light.width,
                          .height = light.height,
                          .samples = 1,
                          .smooth = false,
                          .threads = results.options.threads};
    if (results.monitor.interrupted)
        options.square = square_for_speed(light.width, light.height);
    const std::vector<std::uint32_t> patches = patches_in(results, camera, options);
    std::vector<ExrChannel> channels;
    add_exr_channels(channels, "", light);
    add_exr_channels(channels, "irradiance", picture_of(light, patches, [&](std::uint32_t i) {
                         return irradiance_of(results.mesh.material(i), solution.radiosity[i]);
                     }));
    add_exr_channels(channels, "error", picture_of(light, patches, [&](std::uint32_t i) {
                         return solution.standard_error.empty() ? Vec3(0.0)
                                                                : solution.standard_error[i];
                     }));
    const std::vector<double> means = mean_densities(results);
    if (!means.empty()) {
        ExrChannel density{"density", ExrChannel::Kind::number, {}};
        for (const std::uint32_t i : patches)
            density.bits.push_back(
                std::bit_cast<std::uint32_t>(i == no_patch ? 0.0f : static_cast<float>(means[i])));
        channels.push_back(std::move(density));
    }
    add_lamp_channels(channels, results.lamps.lamps, lamps);
    channels.push_back({"patch", ExrChannel::Kind::whole, patches});
    return channels;
}

} // namespace hemilux
