#include "radiosity/answers/images/image.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hemilux {
namespace {

/// A table of the bytes of a PNG, as powers would take longer than all else of a picture. The
/// floats of a cell agree in the sign, the exponent and six bits of the fraction. The byte of its
/// lowest is at most two below that of any other.
class ByteTable {
  public:
    ByteTable() {
        for (std::size_t byte = 0; byte < least_.size(); ++byte)
            least_[byte] = min_with(static_cast<int>(byte));
        for (std::uint32_t cell = 0; cell < lowest_.size(); ++cell)
            lowest_[cell] = static_cast<std::uint8_t>(exact(std::bit_cast<float>(cell << shift)));
    }
    [[nodiscard]] std::uint8_t of(float linear) const {
        if (!(linear > 0)) // NaN is black
            return 0;
        if (linear >= 1)
            return 255;
        std::uint8_t byte = lowest_[std::bit_cast<std::uint32_t>(linear) >> shift];
        while (byte < 255 && linear >= least_[byte + std::size_t{1}])
            ++byte;
        return byte;
    }

  private:
    static constexpr int shift = 17;
    static long exact(float linear) { return std::lround(255.0f * srgb_from_linear(linear)); }
    /// Finds the least float that has so large a byte, by bisection of the bits, which grow with
    /// floats.
    static float min_with(int byte) {
        std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            if (exact(std::bit_cast<float>(middle)) >= byte)
                high = middle;
            else
                low = middle + 1;
        }
        return std::bit_cast<float>(low);
    }

    std::array<float, 256> least_;
    std::array<std::uint8_t, (std::bit_cast<std::uint32_t>(1.0f) >> shift) + 1> lowest_;
};

} // namespace

float srgb_from_linear(float linear) {
    if (!(linear > 0)) // NaN is black
        return 0;
    if (linear >= 1)
        return 1;
    return linear <= 0.0031308f
               ? 12.92f * linear
               : static_cast<float>(1.055 * elementary::pow(linear, 1 / 2.4) - 0.055);
}

float linear_from_srgb(float encoded) {
    if (!(encoded > 0)) // NaN is black
        return 0;
    if (encoded >= 1)
        return 1;
    return encoded <= 0.04045f
               ? encoded / 12.92f
               : static_cast<float>(elementary::pow((encoded + 0.055) / 1.055, 2.4));
}

double auto_exposure(const Image& image, const Image& emission) {
    constexpr double percentile = 0.95;
    constexpr double contrast = 12;
    constexpr double aim = 0.8;
    constexpr float rounding = 1e-5f; // of the difference of two like numbers
    constexpr std::size_t few = 100;  // lit pixels beside those of emitters
    std::vector<float> lit, on_emitters;
    lit.reserve(image.pixels.size());
    for (std::size_t k = 0; k < image.pixels.size(); ++k) {
        const float all = luminance(image.pixels[k]);
        const float y = emission.pixels.empty() ? all : all - luminance(emission.pixels[k]);
        if (y > rounding * all && std::isfinite(y))
            (2 * y > all ? lit : on_emitters).push_back(y);
    }
    if (few * lit.size() < on_emitters.size())
        lit.insert(lit.end(), on_emitters.begin(), on_emitters.end());
    if (lit.empty())
        return emission.pixels.empty() ? 1 : auto_exposure(image);
    const auto value_at = [&](double share) {
        const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(lit.size() - 1));
        std::nth_element(lit.begin(), lit.begin() + rank, lit.end());
        return static_cast<double>(lit[static_cast<std::size_t>(rank)]);
    };
    return aim / std::min(value_at(percentile), contrast * value_at(0.5));
}

std::uint8_t srgb_byte(float linear) {
    static const ByteTable table;
    return table.of(linear);
}

} // namespace hemilux
