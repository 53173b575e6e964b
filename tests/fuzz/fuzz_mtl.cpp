// Any bytes as an MTL file: read or refused by InputError, and colours are finite.

#include "fuzz/input_file.h"
#include "io/files/error.h"
#include "io/scene_files/mtl.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const hemilux::fuzz::InputFile file("a.mtl");
    try {
        for (const hemilux::MtlMaterial& material :
             hemilux::read_mtl(file.with(data, size)).materials)
            for (const auto& colour : {material.reflectance, material.emission})
                if (colour && !std::isfinite(colour->r + colour->g + colour->b))
                    std::abort();
    } catch (const hemilux::InputError&) {
    }
    return 0;
}
