#include "radiosity/answers/images/ssim.h"

#include "geometry/elementary.h"
#include "radiosity/answers/images/tone.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace hemilux {
namespace {

constexpr int window = 2 * ssim_margin + 1;
constexpr double deviation = 1.5, range = 255;
constexpr double c1 = .01 * range * .01 * range, c2 = .03 * range * .03 * range;

std::array<double, window> gaussian() {
    std::array<double, window> weight;
    for (int k = 0; k < window; ++k)
        weight[static_cast<std::size_t>(k)] =
            elementary::exp(-.5 * (k - ssim_margin) * (k - ssim_margin) / (deviation * deviation));
    const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (double& w : weight)
        w /= sum;
    return weight;
}

/// Weighted means over all windows that lie within the picture: along rows, then along columns.
LumaPicture means(const LumaPicture& picture) {
    static const std::array<double, window> weight = gaussian();
    const auto along = [&](const LumaPicture& from, int dx, int dy) {
        LumaPicture to{from.width - dx * (window - 1), from.height - dy * (window - 1), {}};
        for (int y = 0; y < to.height; ++y)
            for (int x = 0; x < to.width; ++x) {
                double sum = 0;
                for (int k = 0; k < window; ++k)
                    sum += weight[static_cast<std::size_t>(k)] * from.at(x + dx * k, y + dy * k);
                to.values.push_back(sum);
            }
        return to;
    };
    return along(along(picture, 1, 0), 0, 1);
}

LumaPicture product(const LumaPicture& a, const LumaPicture& b) {
    LumaPicture result{a.width, a.height, a.values};
    for (std::size_t k = 0; k < result.values.size(); ++k)
        result.values[k] *= b.values[k];
    return result;
}

} // namespace

LumaPicture luma_of(int width, int height, std::span<const std::uint8_t> rgb) {
    LumaPicture picture{width, height, {}};
    for (std::size_t k = 0; k + 2 < rgb.size(); k += 3)
        picture.values.push_back(.299 * rgb[k] + .587 * rgb[k + 1] + .114 * rgb[k + 2]);
    return picture;
}

LumaPicture luma_of(const Image& image, const Display& display) {
    std::vector<std::uint8_t> rgb;
    for (const glm::vec3& pixel : image.pixels) {
        const glm::vec3 shown = display(pixel);
        for (int c = 0; c < 3; ++c)
            rgb.push_back(srgb_byte(shown[c]));
    }
    return luma_of(image.width, image.height, rgb);
}

namespace {

/// Calls visit(index of means, variance of a, variance of b, covariance) for each window.
template <class Visit>
void for_each_window(const LumaPicture& a, const LumaPicture& b, const Visit& visit) {
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("the pictures have different sizes");
    if (a.width < window || a.height < window)
        throw std::invalid_argument("a picture has 11 x 11 pixels at least");
    const std::vector<double> mean_a = means(a).values, mean_b = means(b).values;
    const std::vector<double> aa = means(product(a, a)).values, bb = means(product(b, b)).values,
                              ab = means(product(a, b)).values;
    for (std::size_t k = 0; k < mean_a.size(); ++k) {
        const double ma = mean_a[k], mb = mean_b[k];
        visit((2 * ma * mb + c1) / (ma * ma + mb * mb + c1), aa[k] - ma * ma, bb[k] - mb * mb,
              ab[k] - ma * mb);
    }
}

double mean_of(const std::vector<double>& map) {
    return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

} // namespace

std::vector<double> ssim_map(const LumaPicture& a, const LumaPicture& b) {
    std::vector<double> map;
    for_each_window(a, b, [&](double of_means, double va, double vb, double covariance) {
        map.push_back(of_means * (2 * covariance + c2) / (va + vb + c2));
    });
    return map;
}

double ssim(const LumaPicture& a, const LumaPicture& b) { return mean_of(ssim_map(a, b)); }

double ssim_without_noise(const LumaPicture& noisy, const LumaPicture& again) {
    std::vector<double> map;
    for_each_window(noisy, again, [&](double of_means, double va, double vb, double covariance) {
        const double noise = std::max(va + vb - 2 * covariance, 0.0),
                     without = std::max(va - noise, 0.0);
        map.push_back(of_means * (2 * without + c2) / (2 * without + noise + c2));
    });
    return mean_of(map);
}

} // namespace hemilux
