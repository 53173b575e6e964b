// Any bytes as a file of View3D: read or refused by InputError, and what is read is a scene.

#include "fuzz/input_file.h"
#include "fuzz/whole_scene.h"
#include "io/scene_files/vs3.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const hemilux::fuzz::InputFile file("a.vs3");
    hemilux::fuzz::check_reading([&](const hemilux::ReadGuard& guard) {
        return hemilux::read_vs3(file.with(data, size), guard);
    });
    return 0;
}
