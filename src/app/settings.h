#pragma once
// What the command line asks for, once it has been read and its numbers are within their ranges.

#include "app/numbers.h"
#include "app/outputs.h"
#include "app/overrides.h"
#include "io/camera.h"
#include "radiosity/mesh.h"
#include "radiosity/solver.h"

#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// Which scene, and with which changes.
struct SceneSettings {
    std::string path;
    std::vector<Override> emission, reflectance;
    MeshOptions mesh;
};

/// How much is said on stderr.
enum class Talk { quiet, normal, verbose };

/// The view of a picture.
struct ViewSettings {
    std::optional<Camera> camera; ///< empty: chosen by the program
    PixelSize size{800, 600};
    std::optional<double> exposure; ///< empty: from the picture
};

struct SolveSettings {
    SceneSettings scene;
    const Method* method = nullptr;
    SolveOptions options;
    StopRule stop; ///< as given; the method's own rule stands in for an empty one
    ViewSettings view;
    std::vector<Output> outputs;
    std::string statistics, steps_log; ///< paths; empty: not asked for
    std::string reference;             ///< path of a patch table; empty: none
    std::vector<std::string> detail;   ///< groups; empty: those that begin with `detail`
    Talk talk = Talk::normal;
};

struct InfoSettings {
    SceneSettings scene;
    Talk talk = Talk::normal;
};

} // namespace hemilux
