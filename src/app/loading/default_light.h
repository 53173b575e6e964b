#pragma once
// The light of `hemilux MODEL` where a model has none that somebody would see.

#include "app/settings/settings.h"
#include "io/scene_files/read_result.h"

#include <optional>
#include <string>

namespace hemilux {

/// A light that was put in.
struct PutIn {
    std::string why;     ///< "nothing emits light"
    std::string options; ///< what asks for the same light, as a shell takes it
};

/// Adds a light to the settings where the light of the scene and of the settings reaches next to
/// nothing of what can be looked at; empty where it reaches enough. What can be looked at is what
/// the camera shows that was given or is of the file, else what is seen from within the scene's
/// box.
std::optional<PutIn> put_in_light(const ReadResult& read, SceneSettings& settings,
                                  const ViewSettings& view);

} // namespace hemilux
