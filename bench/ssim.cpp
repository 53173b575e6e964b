#include "ssim.h"

#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hemilux::bench {
namespace {

constexpr int window = 2 * ssim_margin + 1;
constexpr double deviation = 1.5, range = 255;
constexpr double c1 = .01 * range * .01 * range, c2 = .03 * range * .03 * range;

std::array<double, window> gaussian() {
    std::array<double, window> weight;
    for (int k = 0; k < window; ++k)
        weight[static_cast<std::size_t>(k)] =
            std::exp(-.5 * std::pow((k - ssim_margin) / deviation, 2));
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

std::vector<double> ssim_map(const LumaPicture& a, const LumaPicture& b) {
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("the pictures have different sizes");
    if (a.width < window || a.height < window)
        throw std::invalid_argument("a picture has 11 x 11 pixels at least");
    const std::vector<double> mean_a = means(a).values, mean_b = means(b).values;
    const std::vector<double> aa = means(product(a, a)).values, bb = means(product(b, b)).values,
                              ab = means(product(a, b)).values;
    std::vector<double> map;
    for (std::size_t k = 0; k < mean_a.size(); ++k) {
        const double ma = mean_a[k], mb = mean_b[k];
        const double variances = aa[k] - ma * ma + bb[k] - mb * mb, covariance = ab[k] - ma * mb;
        map.push_back((2 * ma * mb + c1) * (2 * covariance + c2) /
                      ((ma * ma + mb * mb + c1) * (variances + c2)));
    }
    return map;
}

double ssim(const LumaPicture& a, const LumaPicture& b) {
    const std::vector<double> map = ssim_map(a, b);
    return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

} // namespace hemilux::bench
