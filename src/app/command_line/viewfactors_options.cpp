#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/settings/factor_aim.h"
#include "geometry/numeric.h"

#include <array>
#include <bit>

namespace hemilux {

namespace {

constexpr const char* viewfactors_examples = R"(Examples:
  hemilux viewfactors room.obj -o factors.csv --legend surfaces.csv
  hemilux viewfactors room.obj --by group --sky -o factors.npz
  hemilux viewfactors room.obj --error 0.5% --of above:0.01 -o factors.npz
  hemilux viewfactors city.stl -o vfsparse.inp.001 -o svf.inp.001
  hemilux viewfactors room.obj --by group --points seats.txt -o factors.csv --legend rows.csv
  hemilux viewfactors city.stl --suns june.txt --sunlit june.csv
  hemilux viewfactors city.stl --of sky -o sky.vtu --legend sky.csv
  hemilux viewfactors city.stl -o city.npz --checkpoint city.saved
  hemilux viewfactors city.stl -o city.npz --checkpoint city.saved --resume city.saved
)";

constexpr const char* exchange_examples = R"(Examples:
  hemilux exchange furnace.obj --by group --surfaces known.csv -o heat.csv
  hemilux exchange street.obj --by group --surfaces known.csv --sky-temperature 263 -o heat.csv
)";

std::optional<std::uint32_t> rays_from(const std::string& text) {
    const std::optional<std::uint64_t> value = parse_whole(text);
    return value && std::has_single_bit(*value) && *value >= 256 && *value <= (1u << 20)
               ? std::optional(static_cast<std::uint32_t>(*value))
               : std::nullopt;
}

std::optional<Vec3> direction_from(const std::string& text) {
    const std::optional<std::vector<double>> numbers = parse_numbers(text, ',');
    if (!numbers || numbers->size() != 3)
        return {};
    const Vec3 direction((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    return direction == Vec3(0.0) ? std::nullopt : std::optional(direction_of(direction));
}

std::optional<std::string> output_from(const std::string& path) {
    return factor_file_of(path) ? std::optional(path) : std::nullopt;
}

void add_temperature(Command command, const std::string& name, std::optional<double>& temperature,
                     const std::string& what) {
    add_number(command, name, "KELVIN", temperature, non_negative,
               "how warm " + what + " is, which is black; needed where a surface sees it");
}

/// Adds what says which surfaces there are, and how exact factors should be.
void add_factor_options(Command command, ViewFactorSettings& settings) {
    add_geometry_options(command, settings.scene);
    add_memory_option(command.under(scene_group), settings.scene);
    const Command method = command.under(method_group);
    add_choice(method, "--by", settings.by,
               {{FactorRows::face, "face"},
                {FactorRows::group, "group"},
                {FactorRows::material, "material"},
                {FactorRows::patch, "patch"}},
               "what a row stands for: each side of a face of the file, a group, a material or a "
               "patch, as `solve` has them [face]");
    add_error(method, "--error", settings.error,
              "the standard error that is aimed at, relative [1%]");
    add_seconds(method, "--time", settings.seconds, positive,
                "end the search for better factors after this time, and report the error that was "
                "reached; 2m and 1h are minutes and hours");
    add_parsed(method, "--of", "above:F|rows|largest|pair:A,B|sky",
               "what it is of: factors of at least F, their root mean square; the factors of each "
               "row together; the largest factor of each row; the factor between two surfaces "
               "[above:0.001]",
               "above:F with F from 1e-6 to 1, rows, largest, pair:A,B or sky", parse_factor_aim,
               settings.aim);
    add_parsed(method, "--rays", "N",
               "rays from each face, a power of two, that find who sees whom [1024]",
               "a power of two from 256 to 1048576", rays_from, settings.rays);
    add_choice(method, "--up", settings.up, {{0, "x"}, {1, "y"}, {2, "z"}},
               "the axis that points to the sky [y for glTF, else z]");
    add_random_options(method, settings.options);
    add_checkpoint_options(command.under("Checkpoints"), settings.checkpoint);
}

} // namespace

Command add_viewfactors_command(Arguments& program, ViewFactorSettings& settings) {
    const Command command = program.add_command(
        "viewfactors", "write the view factors between surfaces, each with its error");
    add_factor_options(command, settings);
    const Command method = command.under(method_group);
    method.add_flag("--sky", settings.sky, "make the sky a column: what leaves the scene upwards");
    add_parsed(
        method, "--sky-bands", "N|tregenza",
        "divide the column of the sky into N bands of equal altitude, or into the 145 patches "
        "of Tregenza",
        "a whole number from 1 to 90 or tregenza", parse_sky_division,
        [&settings](const SkyDivision& division) {
            settings.sky_bands = division;
            settings.sky = true;
        });
    method.add_flag("--ground", settings.ground,
                    "make the ground a column: what leaves the scene downwards");
    method.add_text("--points", "FILE", settings.points,
                    "points with normals that get rows of their own: rows x,y,z,nx,ny,nz");
    add_parsed(method, "--sun", "X,Y,Z",
               "a sun for --sunlit: the direction in which its light goes, as for solve",
               "three numbers X,Y,Z that are not all 0", direction_from, settings.sun);
    method.add_text("--suns", "FILE", settings.suns,
                    "more suns for --sunlit: rows x,y,z of such directions");
    const Command output = command.under(output_group);
    add_parsed(
        output, "-o,--output", "FILE",
        "i,j,F,standard_error .csv; sparse matrix for SciPy .npz; dense NumPy array .npy; "
        "surfaces for ParaView .vtu; vfsparse.inp... and svf.inp... for uDALES; repeatable",
        "a file name that ends with .csv, .npz, .npy or .vtu, or begins with vfsparse.inp or "
        "svf.inp",
        output_from, settings.outputs);
    add_path(output, "--legend", "FILE",
             "a table of the rows: name, face, group, area, centre, normal, sky, sum of the row",
             ".csv", settings.legend);
    add_path(output, "--sunlit", "FILE",
             "a table of the share of each surface that the sun shines on: sun, surface, sunlit, "
             "standard_error",
             ".csv", settings.sunlit);
    add_verbosity_options(command, settings.verbosity);
    command.in_family(factor_family);
    command.call_often_used(std::to_array(
        {"--output", "--by", "--error", "--time", "--of", "--sky", "--points", "--threads"}));
    command.end_help_with(viewfactors_examples);
    return command;
}

Command add_exchange_command(Arguments& program, ViewFactorSettings& settings) {
    const Command command = program.add_command(
        "exchange", "write the heat that surfaces exchange by radiation, with its errors");
    add_factor_options(command, settings);
    const Command method = command.under(method_group);
    method
        .add_text("--surfaces", "FILE.csv", settings.heat.surfaces,
                  "what is known: columns surface, emissivity, and of each row the temperature [K] "
                  "or the flux that it gives off [W/m2]; * in a name stands for any letters")
        .required();
    add_temperature(method, "--sky-temperature", settings.heat.sky_temperature, "the sky");
    add_temperature(method, "--ground-temperature", settings.heat.ground_temperature,
                    "what lies below the scene");
    add_path(command.under(output_group), "-o,--output", "FILE.csv",
             "a table of temperatures and heat by surface, each with its standard error", ".csv",
             settings.heat.output)
        .required();
    add_verbosity_options(command, settings.verbosity);
    command.in_family(factor_family);
    command.call_often_used(
        std::to_array({"--output", "--surfaces", "--by", "--error", "--time", "--threads"}));
    command.end_help_with(exchange_examples);
    return command;
}

} // namespace hemilux
