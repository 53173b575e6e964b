// The options of `hemilux bake`.

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace hemilux {

namespace {

constexpr const char* bake_examples = R"(Examples:
  hemilux bake room.glb -o lit.glb
  hemilux bake room.glb -o lit.glb --lightmap 2048 --error 1%
  hemilux bake room.gltf -o engine.glb --bind lightmap
  hemilux bake room.obj -o lit.obj --sky 1
  hemilux bake room.glb -o ao.glb --bake ao --ao-distance 0.5
)";

/// The choice of texture coordinates.
struct CoordinatesChoice {
    std::optional<std::size_t> set; ///< empty: an atlas of our own
};

std::optional<CoordinatesChoice> coordinates_from(const std::string& text) {
    constexpr std::uint64_t max_set = 15;
    if (text == "new")
        return CoordinatesChoice{};
    const auto set = parse_whole(text);
    if (!set || *set > max_set)
        return std::nullopt;
    return CoordinatesChoice{static_cast<std::size_t>(*set)};
}

/// What was given of --bake and --bind.
struct GivenLight {
    enum class Kind { irradiance, indirect, radiosity, occlusion };
    std::optional<Kind> kind;
    std::optional<Binding> binding;
};

void add_light_options(Command command, SolveSettings& settings,
                       const std::shared_ptr<GivenLight>& given) {
    using Kind = GivenLight::Kind;
    add_choice<Kind>(command, "--bake",
                     {{Kind::irradiance, name_of(Bake::irradiance)},
                      {Kind::indirect, name_of(Bake::indirect)},
                      {Kind::radiosity, name_of(Bake::radiosity)},
                      {Kind::occlusion, "ao"}},
                     "the light of texels: irradiance: what arrives, which viewers multiply by "
                     "their materials; indirect: of that what was reflected before, for viewers "
                     "that light by lamps, too; radiosity: what surfaces send, with their colours; "
                     "ao: ambient occlusion, the share of the hemisphere that nothing blocks, for "
                     "which nothing is solved [irradiance; radiosity for --bind unlit, ao for "
                     "--bind occlusion]",
                     [given](Kind value) { given->kind = value; });
    add_choice<Binding>(
        command, "--bind",
        {{Binding::lit, "lit"},
         {Binding::lightmap, "lightmap"},
         {Binding::unlit, "unlit"},
         {Binding::occlusion, "occlusion"},
         {Binding::texture, "texture"}},
        "how materials have the light: lit: times their textures, as any viewer shows it; the "
        "file's own are a variant with MOZ_lightmap; lightmap: by MOZ_lightmap; unlit: as an unlit "
        "base colour, as coarse as its texels; occlusion: as "
        "occlusionTexture, which dims the light from all around in viewers; texture: not at all "
        "[lit; lightmap for --bake indirect, unlit for radiosity, occlusion for ao; texture for "
        ".obj]",
        [given](Binding value) { given->binding = value; });
    add_choice(
        command, "--normals", settings.file_bake.smooth, {{false, "facet"}, {true, "smooth"}},
        "the normals around which texels gather: facet: each facet is flat; smooth: those of "
        "the file, between the corners of facets, where it has them [facet]");
    add_number(command, "--ao-distance", "LENGTH", settings.file_bake.occlusion_distance, positive,
               "the length [m] beyond which nothing blocks, for --bake ao [no bound]");
}

/// Settles what is baked and how materials refer to it. Throws UsageError where the two contradict
/// each other.
void settle_light(const GivenLight& given, SolveSettings& settings) {
    using Kind = GivenLight::Kind;
    FileBakeSettings& file = settings.file_bake;
    const Kind kind = given.kind.value_or(given.binding == Binding::unlit       ? Kind::radiosity
                                          : given.binding == Binding::occlusion ? Kind::occlusion
                                                                                : Kind::irradiance);
    file.occlusion = kind == Kind::occlusion;
    const Binding usual = is_obj(settings.scene.path) ? Binding::texture
                          : kind == Kind::occlusion   ? Binding::occlusion
                          : kind == Kind::radiosity   ? Binding::unlit
                          : kind == Kind::indirect    ? Binding::lightmap
                                                      : Binding::lit;
    file.binding = given.binding.value_or(usual);
    settings.bake = kind == Kind::radiosity  ? Bake::radiosity
                    : kind == Kind::indirect ? Bake::indirect
                                             : Bake::irradiance;
    if (file.occlusion && file.binding != Binding::occlusion && file.binding != Binding::texture)
        throw UsageError("--bake ao is no light; it needs --bind occlusion or --bind texture");
    if (file.binding == Binding::occlusion && !file.occlusion)
        throw UsageError("--bind occlusion is for --bake ao");
    if (file.binding == Binding::lightmap && settings.bake == Bake::radiosity)
        throw UsageError("--bake radiosity has the colours of surfaces in it, which viewers of "
                         "lightmaps multiply by; add --bind unlit or --bind texture");
    if (file.binding == Binding::lit && settings.bake != Bake::irradiance)
        throw UsageError("--bind lit shows textures times what arrives; it needs --bake "
                         "irradiance");
    if (file.binding == Binding::unlit && settings.bake != Bake::radiosity)
        throw UsageError("--bind unlit shows what surfaces send; it needs --bake radiosity");
    if (file.occlusion_distance && !file.occlusion)
        throw UsageError("--ao-distance is for --bake ao");
}

void add_place_options(Command command, SolveSettings& settings) {
    FileBakeSettings& bake = settings.file_bake;
    add_parsed(command, "--lightmap-uv", "N|new",
               "the texture coordinates of the file, TEXCOORD_N; new: an atlas is added [1 where "
               "all objects have it in [0,1] without overlaps, else new]",
               "a number from 0 to 15, or new", coordinates_from,
               [&bake](const CoordinatesChoice& choice) {
                   bake.set = choice.set;
                   bake.new_set = !choice.set;
               });
    const Option size =
        add_whole(command, "--lightmap", settings.lightmap, 16, SolveSettings::max_lightmap,
                  "texels along a side [by the faces and their area, 128 to 2048]");
    add_number(command, "--texels-per-metre", "X", bake.texels_per_metre, positive,
               "as many texels as that needs, in an atlas of our own")
        .excludes(size);
    command.add_flag("--per-object", bake.per_object,
                     "a lightmap for each object, FILE.NAME.lightmap.exr: the largest has "
                     "--lightmap texels along a side, others are as dense");
    add_whole(command, "--margin", bake.margin, 1, FileBakeSettings::max_margin,
              "texels around charts that have their light, too [2]");
}

} // namespace

Command add_bake_command(Arguments& program, SolveSettings& settings) {
    settings.method = &method_of(Role::standard);
    settings.file_bake.asked = true;
    settings.bake = Bake::irradiance;
    const auto given = std::make_shared<GivenLight>();
    const Command command = program.add_command(
        "bake", "solve a glTF or OBJ scene, write the same file with its light as a lightmap");
    const Command scene = command.under(scene_group), outputs = command.under(output_group);
    add_scene_options(command, settings.scene);
    add_memory_option(scene, settings.scene);
    add_random_options(command.under(method_group), settings.options);
    add_stop_options(command.under("Stop at the first that is met"), settings.stop);
    add_path(outputs, "-o,--output", "FILE.glb|FILE.obj",
             "the scene's file with its light; the light itself beside it as FILE.lightmap.exr, "
             "linear floats [W/m2]",
             ".glb or .obj",
             [&settings](const std::string& path) {
                 settings.outputs = {{path, is_obj(path) ? OutputKind::obj : OutputKind::glb}};
             })
        .required();
    outputs.add_text("--stats", "FILE", settings.statistics, "statistics of the run as JSON");
    add_light_options(outputs, settings, given);
    add_place_options(outputs, settings);
    add_whole(outputs, "--gather", settings.gather, 1, SolveSettings::max_gather,
              "rays that gather light at a texel, more at edges [16, or as many as "
              "--error needs]");
    add_layers_option(outputs, settings.layers);
    add_exposure_options(outputs, settings.view);
    add_verbosity_options(command, settings.verbosity);
    command.after_parsing([&settings, given] { settle_light(*given, settings); });
    command.call_often_used(std::to_array({"--output", "--error", "--time", "--lightmap", "--bind",
                                           "--sky", "--sun", "--light", "--threads"}));
    command.end_help_with(std::string(bake_examples) + exit_codes);
    return command;
}

} // namespace hemilux
