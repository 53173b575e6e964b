#pragma once
// The figures of a run, as the JSON object that other tools read (docs: the program's outputs).

#include "parallel/ranks.h"
#include "radiosity/answers/asked/answer.h"
#include "radiosity/engine/solving/left_out.h"
#include "radiosity/paper/solution/solution.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace hemilux {

/// An option of the command line or of a file of options, in the order of --help.
struct GivenOption {
    std::string name;                ///< name with its dashes, or SCENE
    std::vector<std::string> values; ///< none: a flag
};

/// The light that the estimated error is about. `patches` stands for the patches' means, and
/// `surfaces` for the light on the surfaces, as functions on patches have it. `gathered` stands for
/// the light that is gathered at points or for pictures, and `target` for that on the target of
/// --for.
enum class ErrorOf { patches, surfaces, gathered, target };

/// The figures of one rank.
struct RankFigures {
    RankWork work;
    std::uint64_t bytes_peak;
};

/// What is known of a layer of light (--layers).
struct LayerFigures {
    std::string name;
    Vec3 emitted;     ///< by its lamps [W]
    double error = 0; ///< relative, of the layer by itself; NaN where it is not known
};

/// The error of what was gathered.
struct AnswerFigures {
    std::string of; ///< "points", "picture"
    AnswerError error;
};

/// The error of an object of a lightmap, where each has its own.
struct ObjectFigures {
    std::string name;
    std::uint64_t texels, rays; ///< rays at each texel
    double error, bound;        ///< of the share of the hemisphere; 95 % are below the bound
};

struct Statistics {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN(); ///< JSON: null

    std::uint64_t patches = 0, faces = 0, materials = 0;
    std::string method;
    std::uint64_t seed = 0;
    unsigned threads = 0;
    std::uint64_t steps = 0;
    std::uint64_t rays_energy = 0, rays_density = 0;
    double seconds_read = unknown, seconds_bvh = unknown;
    double seconds_density = unknown, seconds_solve = unknown;
    double seconds_divide = 0; ///< rough solutions and points, to divide patches by
    std::uint64_t rays_divide = 0;
    double seconds_division_error = unknown; ///< time to find out error_division
    std::uint64_t rays_division_error = 0;
    /// The time between the stages above and below [s]: for what the scene does not need, what is
    /// read besides it, and where light is lost.
    double seconds_analysis = unknown;
    double seconds_learn = 0; ///< learning of the light that gathers read, light at points
    std::uint64_t rays_learn = 0, rays_gather = 0;
    double seconds_gather = 0;      ///< gathers of pictures unless interpolated
    double seconds_picture = 0;     ///< all else of pictures: views, interpolation, files
    double seconds_write = 0;       ///< tables and meshes
    double seconds_total = unknown; ///< all of the seconds above, with those of no stage
    double rays_per_second = unknown;
    std::uint64_t bytes_density = 0;       ///< measured
    std::uint64_t bytes_transport = 0;     ///< the rays that `stored-transport` keeps
    std::uint64_t links = 0;               ///< links that `hierarchical` gathers over
    std::uint64_t bytes_density_paper = 0; ///< 4 (4^(n+1) - 1) / 3 per patch (paper section 6)
    std::uint64_t bytes_peak = 0;          ///< peak of the process
    double estimated_error = unknown;      ///< relative; of what: see ErrorOf
    ErrorOf estimated_error_of = ErrorOf::patches;
    double estimated_error_uncertainty = unknown; ///< one sigma; NaN before two steps
    double error_bound = unknown;                 ///< the error is below it in 19 of 20 runs
    /// What 95 of 100 places of gathered light are within, relative to the light there.
    double error_local = unknown;
    /// The groups, points or camera that the estimated error is of, as they were asked for; empty:
    /// all patches alike. Where there are any, the error of all that has no weight stands beside
    /// it.
    std::vector<std::string> target = {};
    double estimated_error_elsewhere = unknown; ///< relative
    double error_sampling = unknown;            ///< relative, of the patches' means
    /// The relative error of the light on the surfaces because it changes within patches
    /// (division_error.h).
    double error_division = unknown, error_division_uncertainty = unknown;
    EnergyBalance energy;
    /// The emitted power of suns and skies, whose light mostly passes the scene by, and the power
    /// that all other surfaces reflect [W]. Both are in the JSON where there are suns or skies.
    double emitted_far = 0, reflected = 0;
    std::vector<LayerFigures> layers; ///< in the JSON where there are any, with what they took
    double seconds_layers = 0;
    std::uint64_t rays_layers = 0;
    std::vector<LeftOut> left_out;
    /// The figures of each rank, where there are several.
    std::vector<RankFigures> ranks = {};
    std::vector<ObjectFigures> objects = {}; ///< of the lightmap of --bake ao
    std::vector<AnswerFigures> answers = {}; ///< in the JSON where there are any
    std::string program;                     ///< program with its version, whose defaults hold
    std::vector<GivenOption> settings;
};

/// Returns the object's text, one key a line, in the order of the struct.
[[nodiscard]] std::string to_json(const Statistics& statistics);

/// Returns the most memory that this process has held so far [bytes].
[[nodiscard]] std::uint64_t peak_memory_bytes();

} // namespace hemilux
