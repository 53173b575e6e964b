// Any bytes as an OBJ file: read or refused by InputError; a scene that was read can be divided.

#include "fuzz/input_file.h"
#include "io/files/error.h"
#include "io/scene_files/obj.h"
#include "radiosity/paper/scene/mesh.h"

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const hemilux::fuzz::InputFile file("s.obj");
    try {
        hemilux::ReadResult read = hemilux::read_obj(file.with(data, size));
        if (read.scene.facets.empty() || read.scene.faces == 0)
            std::abort();
        const hemilux::Mesh mesh(std::move(read.scene), {.max_patches = 10000});
        if (mesh.patches().empty())
            std::abort();
    } catch (const hemilux::InputError&) {
    } catch (const std::invalid_argument&) { // of Mesh: too many patches
    }
    return 0;
}
