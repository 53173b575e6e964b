// How alike two PNG files of hemilux look, as the structural similarity index (ssim.h):
//
//     compare_pictures A.png B.png [LEFT,TOP,WIDTH,HEIGHT]
//
// Prints the index, of the whole or of a part in pixels.
#include "io/png_reader.h"
#include "radiosity/answers/images/ssim.h"

#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>

using namespace hemilux;

namespace {

LumaPicture read(const char* path) {
    const test::Png png = test::read_png(path);
    return luma_of(png.width, png.height, png.bytes);
}

/// left, top, width and height.
std::array<int, 4> parse(const char* text) {
    std::array<int, 4> part{};
    if (std::sscanf(text, "%d,%d,%d,%d", &part[0], &part[1], &part[2], &part[3]) != 4)
        throw std::invalid_argument("a part is LEFT,TOP,WIDTH,HEIGHT");
    return part;
}

LumaPicture cut(const LumaPicture& from, const std::array<int, 4>& part) {
    const auto& [left, top, width, height] = part;
    if (left < 0 || top < 0 || width < 1 || height < 1 || width > from.width - left ||
        height > from.height - top)
        throw std::invalid_argument("the part is not within the picture");
    LumaPicture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.values.push_back(from.at(left + x, top + y));
    return picture;
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 3 || argc > 4) {
        std::fputs("usage: compare_pictures A.png B.png [LEFT,TOP,WIDTH,HEIGHT]\n", stderr);
        return 1;
    }
    const LumaPicture a = read(argv[1]), b = read(argv[2]);
    const bool whole = argc == 3;
    const std::array<int, 4> part = whole ? std::array<int, 4>{} : parse(argv[3]);
    std::printf("%.4f\n", whole ? ssim(a, b) : ssim(cut(a, part), cut(b, part)));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "compare_pictures: %s\n", error.what());
    return 2;
}
