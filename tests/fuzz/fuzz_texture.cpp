// Any bytes as a PNG or JPEG file: decoded or refused by InputError, and the mean over a triangle,
// whose corners are the last bytes, is a colour.

#include "io/files/error.h"
#include "io/textures/texture_files.h"

#include <array>
#include <cstdlib>
#include <cstring>

namespace {
struct TooLarge {};
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::function<void(double)> guard = [](double needed) {
        constexpr double most = 1 << 24;
        if (needed > most)
            throw TooLarge();
    };
    std::array<float, 6> places{};
    if (size >= sizeof places)
        std::memcpy(places.data(), data + size - sizeof places, sizeof places);
    try {
        hemilux::TextureFiles files(guard);
        const auto texture = files.decode(bytes, "a.png");
        if (!texture)
            return 0;
        const std::array<hemilux::Vec2, 3> triangle{hemilux::Vec2(places[0], places[1]),
                                                    hemilux::Vec2(places[2], places[3]),
                                                    hemilux::Vec2(places[4], places[5])};
        for (const auto wrap :
             {hemilux::Wrap::repeat, hemilux::Wrap::clamp, hemilux::Wrap::mirror}) {
            const hemilux::Vec3 mean = texture->mean_over(triangle, {wrap, wrap});
            if (!(mean.x >= 0 && mean.y >= 0 && mean.z >= 0 && mean.x + mean.y + mean.z < 3.001))
                std::abort();
        }
    } catch (const hemilux::InputError&) {
    } catch (const TooLarge&) {
    }
    return 0;
}
