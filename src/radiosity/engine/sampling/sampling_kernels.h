#pragma once
// Declares the arithmetic of drawing samples, sixteen or more at once, and of products with a
// sparse matrix. These are plain loops that the compiler turns into vector instructions, compiled
// once per instruction set (kernels/). All sets give the same bits, as every operation is rounded
// by itself. This header holds plain data only: it may define no function that the linker could
// merge.

#include <cstddef>
#include <cstdint>

namespace hemilux {

enum class InstructionSet; // parallel/instruction_set.h

inline constexpr std::size_t samples_per_block = 16;
inline constexpr std::size_t max_dimensions = 5;

/// Sixteen consecutive points of a scrambled sequence: an aligned block. All words have their bits
/// reversed.
struct SobolBlockStart {
    std::uint32_t seeds[max_dimensions];
    std::uint32_t first[max_dimensions]; ///< words of the block's first point, not scrambled
};

/// The xor of any point of a block to the first one.
struct alignas(64) SobolSteps {
    std::uint32_t step[max_dimensions][samples_per_block];
};

/// The patches that emit, in arrays by emitter. Lengths and areas are in local units.
struct EmitterArrays {
    const double *centre[3], *normal[3], *corner[4][3];
    const double *area, *side; ///< side: the root of the area
    const double* light;       ///< emission, mean of channels [W/m2]
};
/// The spheres that hold several emitters each, in arrays by sphere. Lengths and areas are in local
/// units.
struct ClusterArrays {
    const double *centre[3], *radius, *power;
    const double* area;  ///< mean of its emitters
    const double* light; ///< mean emission, by power
};
struct EmitterReceiver {
    double centre[3], normal[3], corner[4][3], side, radius;
};

/// The place of each sample's random numbers: the two words of its stream's key, and its number in
/// the stream.
struct RandomKeys {
    const std::uint32_t *low, *high, *number;
};

/// Spherical triangles, in arrays by cell. Points uniform in a parallelogram, or in its half,
/// around the projection to the disc are kept if they lie inside (geometry/spherical_triangle.h).
struct CellShapes {
    /// The indices into `part`. First come the unit normals of the planes of the three sides,
    /// inwards. The parallelogram follows, and then a 1 if only half of it is used, else a 0.
    static constexpr unsigned corner = 9, edges = 11, half = 15, parts = 16;
    const double* part[parts];
};

/// The part of a line of rays that a patch owns. A ray stands at each whole number of the line, and
/// the patch's cells follow each other by running sums.
struct PatchOnLine {
    double before, after; ///< places where it begins and ends
    double rays;          ///< after - before: rays for one unit of the sums
    double all;           ///< the largest sum: cells that end there own all that is left
};

/// How words of 32 bits hold the entries of a sparse matrix (entry_words.h).
struct EntryFormat {
    std::uint32_t columns; ///< the bits of the column
    std::uint32_t least;   ///< what the others, two places lower, lack to be a float's
};

/// Three channels side by side, and a 0.
struct alignas(32) Lanes {
    double lane[4];
};

struct SamplingKernels {
    /// Draws points in (0,1)^n, where n is `dimensions`: coordinate d of point k goes to out[16 d +
    /// k].
    void (*sobol)(const SobolBlockStart&, const SobolSteps&, std::size_t dimensions, double* out);
    /// Draws directions with density cos(theta) / pi, for u and v in [0,1] (concentric_map.h).
    void (*cosine)(std::size_t count, const double* u, const double* v, double* x, double* y,
                   double* z);
    /// Estimates two numbers for each emitter. One is the root mean square of what a shadow ray to
    /// it may bring, the other the mean square of what a random ray brings from it. Both are 0
    /// where the rays bring nothing for certain.
    void (*weigh_emitters)(const EmitterArrays&, std::size_t count, const EmitterReceiver&,
                           double* weights, double* found);
    /// Estimates the same for clusters of emitters, on the high side.
    void (*weigh_clusters)(const ClusterArrays&, std::size_t count, const EmitterReceiver&,
                           double* weights, double* found);
    /// Finds in places[k] the last place with sums[place] <= at[k], or 0. `size` is a power of two.
    void (*find_places)(const double* sums, std::size_t size, std::size_t count, const double* at,
                        std::uint64_t* places);
    /// Finds in last[k + 1] the last ray before the end of cell k, of at most 64 cells. The caller
    /// gives last[0], the last ray before them all. Returns a bit for each cell that has rays.
    std::uint64_t (*last_rays)(const PatchOnLine&, std::size_t count, const double* up_to,
                               std::int64_t* last);
    /// Draws four independent numbers, uniform in (0,1), for each sample and attempt.
    void (*random)(const RandomKeys&, std::size_t count, std::uint32_t attempt, double* a,
                   double* b, double* c, double* d);
    /// Draws directions into cells for u and v uniform in (0,1). They are cosine distributed as far
    /// as they are inside (1); else (0) another u and v are to be tried.
    void (*in_cells)(const CellShapes&, std::size_t count, const std::int32_t* cell,
                     const double* u, const double* v, double* x, double* y, double* z,
                     std::uint32_t* inside);
    /// Sets `sum` to the sum of value times x[column] over the `count` entries of a row.
    void (*row_times)(const std::uint32_t* row, std::size_t count, EntryFormat, const Lanes* x,
                      Lanes* sum);
};

/// Returns the kernels of an instruction set, which must be available.
[[nodiscard]] const SamplingKernels& sampling_kernels(InstructionSet set);
/// Returns the kernels of the instruction set that was chosen.
[[nodiscard]] const SamplingKernels& sampling_kernels();

} // namespace hemilux
