#include "app/loading/read_scene.h"

#include "app/settings/extension.h"
#include "io/files/error.h"
#include "io/gltf/gltf.h"
#include "io/scene_files/obj.h"
#include "io/scene_files/stl.h"

namespace hemilux {

ReadResult read_scene_file(const std::string& path, const ReadGuard& guard, bool textures) {
    const std::string extension = extension_of(path);
    if (extension == ".obj")
        return read_obj(path, guard, textures);
    if (extension == ".gltf" || extension == ".glb")
        return read_gltf(path, guard, textures);
    if (extension == ".stl")
        return read_stl(path, guard);
    throw InputError(path,
                     std::string("expected a scene of a kind that can be read: ") + scene_formats);
}

} // namespace hemilux
