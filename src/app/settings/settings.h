#pragma once
// The settings that the command line asks for, once it has been read and its numbers are within
// their ranges.

#include "app/settings/lights.h"
#include "app/settings/numbers.h"
#include "app/settings/outputs.h"
#include "app/settings/overrides.h"
#include "io/files/outside_files.h"
#include "io/files/provenance.h"
#include "io/gltf/binding.h"
#include "io/meshes/ply.h"
#include "io/results/statistics.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/run/side_by_side.h"
#include "radiosity/answers/run/sides.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/light/lamps/lamp_layers.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solve_options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

struct ReadResult; // io/scene_files/read_result.h

/// What becomes of materials that let light through.
enum class Glass { solid, open };

/// The scene, and the changes to it.
struct SceneSettings {
    std::string path;
    std::string config; ///< path of the file that options were read from; empty: none
    std::vector<Override> emission, reflectance;
    std::vector<LightSettings> lights; ///< lights that are added
    std::vector<SunSettings> suns;
    std::optional<Vec3> sky; ///< its radiosity [W/m2]
    Sides sides = Sides::automatic;
    Glass glass = Glass::solid;
    bool textures = true;                ///< they are read
    Outside outside = Outside::reported; ///< files that the scene names in other folders
    MeshOptions mesh;                    ///< two-sided with Sides::both
    /// Adds lights to those above, once the scene was read with them; empty: none are added.
    std::function<void(const ReadResult&, SceneSettings&)> more_light;
    std::optional<std::uint64_t> memory; ///< bytes that a run may need
};

/// This says how much is reported on stderr.
enum class Verbosity { quiet, normal, verbose };

/// The view of a picture.
struct ViewSettings {
    std::optional<Camera> camera;     ///< empty: chosen by the program
    bool uses_camera_of_scene = true; ///< its camera is used where there is one and none was given
    bool camera_has_up = false;       ///< the camera given says what is upwards in the picture
    std::optional<int> up;            ///< axis asked for, 1 for y or 2 for z; empty: guessed
    std::optional<int> usual_up;      ///< FileView::usual_up
    PixelSize size{800, 600};
    std::optional<double> exposure; ///< empty: from the picture
    double stops = 0;               ///< the exposure is doubled so often
    Tone tone = Tone::neutral;
};

/// The settings of --points and --points-output: where the light is to be known, and the table of
/// it.
struct PointSettings {
    std::string path, output; ///< empty: none
    /// The number of rays from a point for each ray of --gather: points are fewer than pixels.
    static constexpr unsigned rays_per_gather_ray = 256;
};

/// The settings of --for, which say what is to be right. Without them, all patches count alike.
struct TargetSettings {
    bool camera = false;
    std::vector<std::string> groups, points; ///< names; paths of files as of --points
    /// Returns the names as they are given; empty where nothing is.
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> names;
        if (camera)
            names.emplace_back("camera");
        for (const std::string& group : groups)
            names.push_back("group:" + group);
        for (const std::string& path : points)
            names.push_back("points:" + path);
        return names;
    }
};

/// The settings of --checkpoint, --every and --resume.
struct CheckpointSettings {
    std::string path, resumed;   ///< empty: none
    std::optional<double> every; ///< seconds between two
    static constexpr double default_every = 60;
};

/// The settings of `bake`, which writes the scene's own file with its light.
struct FileBakeSettings {
    bool asked = false;             ///< by `bake`; `solve` writes the divided mesh
    std::optional<std::size_t> set; ///< --lightmap-uv: the set of the file
    bool new_set = false;           ///< --lightmap-uv new: an atlas of our own in any case
    std::optional<double> texels_per_metre;
    int margin = 2; ///< texels around charts that have their light too
    Binding binding = Binding::lit;
    bool per_object = false; ///< a lightmap for each object
    bool smooth = false;     ///< --normals smooth: texels are gathered around those of the file
    bool occlusion = false;  ///< --bake ao in place of SolveSettings::bake
    std::optional<double> occlusion_distance; ///< [m], beyond which nothing blocks
    static constexpr int max_margin = 64;
};

struct SolveSettings {
    SceneSettings scene;
    const Method* method = nullptr;
    bool plain = false; ///< the method's page (Method::plain) instead of the engine
    SolveOptions options;
    bool divide_given = false; ///< --divide was; else divides_by_default() decides
    bool divide_auto = false;  ///< patches are divided where the light changes within them
    bool whole_error = false;  ///< what patches leave out is found out
    StopRule stop;             ///< rule as given; the method's own stands in for an empty one
    bool useful = false;       ///< --useful: it also ends once its picture is (UsefulPicture)
    /// One sigma of the error of gathered light, as a share of it, to which it is found out; 0: no
    /// matter.
    double error_accuracy = 0;
    ViewSettings view;
    std::vector<Output> outputs;
    Bake bake = Bake::radiosity; ///< what mesh files hold
    std::optional<int> lightmap; ///< texels along a side, beside .glb files; `bake` has a default
    FileBakeSettings file_bake;
    [[nodiscard]] bool writes_lightmap() const { return lightmap || file_bake.asked; }
    PlyColours ply_colours = PlyColours::linear; ///< what .ply files hold
    Provenance from;                             ///< provenance of the files
    std::vector<GivenOption> given;              ///< options and their values
    /// These are paths; empty: not asked for.
    std::string statistics, steps_log, error_map, report;
    bool every_step = false;         ///< pictures also after every step
    bool preview = false;            ///< Preview, also where no terminal shows the run
    std::string reference;           ///< path of a patch table; empty: none
    std::vector<std::string> detail; ///< groups; empty: those that begin with `detail`
    CheckpointSettings checkpoint;
    PointSettings points;
    TargetSettings target;
    /// Rays at a point of a surface that a picture shows, if given; points have more.
    std::optional<unsigned> gather;
    [[nodiscard]] unsigned rays_of_gather() const { return gather.value_or(default_gather); }
    static constexpr unsigned default_gather = 16, max_gather = 1024;
    static constexpr int max_lightmap = 16384;
    /// The number of rays from a patch for each ray of --gather, where the indirect light is baked.
    static constexpr unsigned bake_rays_per_gather_ray = 64;
    std::optional<LayersBy> layers; ///< the light of each lamp by itself is given out too
    bool gather_pictures = true;    ///< else they interpolate the light of the patches
    Verbosity verbosity = Verbosity::normal;
    const Ranks* ranks = &one_rank(); ///< processes that solve it together

    /// Returns what the method does in this run.
    [[nodiscard]] MethodWork work() const { return method->work_with(options); }
};

/// A method as `compare` names it: METHOD-VALUE is the method with this value of one of its
/// options, METHOD:NAME=VALUE:NAME=VALUE with several.
struct MethodVariant {
    std::string name;
    const Method* method = nullptr;
    struct Setting {
        std::string option, value; ///< the option's name with its dashes
        [[nodiscard]] bool operator==(const Setting&) const = default;
    };
    /// What differs from the options as given.
    std::vector<Setting> settings = {};
    [[nodiscard]] SolveOptions applied_to(SolveOptions options) const;
    /// Returns the name as a part of a file's name.
    [[nodiscard]] std::string file_name() const;
};

struct CompareSettings {
    SceneSettings scene;
    std::vector<MethodVariant> variants;
    SolveOptions options; ///< run r has the seed plus r; `literal` is for methods that have it
    Budget budget;        ///< of each run of each method
    std::uint32_t runs = 3;
    std::string reference;         ///< path of a patch table; empty: computed by `matrix`
    double reference_error = .002; ///< estimated error at which it is good enough, relative [-]
    bool relative_mse = false;     ///< the table has this error, too
    bool total = false;            ///< errors are those of the light itself, division included
    ViewSettings view;
    Provenance from;                ///< provenance of the files
    std::vector<GivenOption> given; ///< options and their values
    std::string folder;
    std::string report;              ///< path of a page; empty: none
    std::vector<std::string> detail; ///< groups; empty: those that begin with `detail`
    Verbosity verbosity = Verbosity::normal;
    const Ranks* ranks = &one_rank(); ///< processes that work at it together
};

struct DensitySettings {
    SceneSettings scene;
    const Method* method = &method_of(Role::paper); ///< method whose hemispheres are shown
    SolveOptions options;                           ///< how they are divided, seed, threads
    std::optional<std::uint32_t> patch; ///< patch to be shown; empty: the largest spread
    std::uint32_t part = 0;             ///< part of the patch that is shown from above
    std::uint32_t rays = 0;             ///< energy rays to show in it
    bool plane = false;                 ///< a cross-section instead (figure 1)
    ViewSettings view;
    std::vector<std::string> outputs; ///< .svg: a hemisphere; .png: mean densities
    std::vector<GivenOption> given;   ///< options and their values
    Verbosity verbosity = Verbosity::normal;
};

struct FormFactorSettings {
    SceneSettings scene;
    SolveOptions options;      ///< seed, threads, factors
    std::uint32_t rays = 4096; ///< rays per patch; a power of two
    std::vector<std::string> outputs;
    std::vector<GivenOption> given; ///< options and their values
    Verbosity verbosity = Verbosity::normal;

    static constexpr std::size_t max_dense = 20'000; ///< patches
};

struct InfoSettings {
    SceneSettings scene;
    bool json = false; ///< one object instead of lines of text
    Verbosity verbosity = Verbosity::normal;
};

} // namespace hemilux
