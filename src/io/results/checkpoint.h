#pragma once
// A run that can be resumed: its options, its scene and what it had computed.
//
// The file begins with a line that names the format and its version. Then follow the length of the
// content, the content (radiosity/engine/saving/state.h) and a checksum of all of it. It replaces
// the one before only when it is on the disk, so there is always a good one.

#include "io/results/tables.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hemilux {

class Mesh;

struct Checkpoint {
    /// Options that the result depends on, as on the command line: name and value.
    std::vector<std::pair<std::string, std::string>> options;
    std::uint64_t scene = 0;   ///< scene_hash()
    double seconds = 0;        ///< time of the solver so far [s]
    std::vector<StepRow> rows; ///< rows of the steps log so far
    std::string state;         ///< Solver::save()
};

/// Returns a hash of all that the solvers see of a scene: positions, patches, materials.
[[nodiscard]] std::uint64_t scene_hash(const Mesh& mesh);

/// Returns any content as a whole file: with the first line, its length and the checksum.
[[nodiscard]] std::string sealed_checkpoint(std::string_view content);
[[nodiscard]] std::string to_bytes(const Checkpoint& checkpoint);
/// Reads what to_bytes() made; throws InputError for anything else. `file` is for messages.
[[nodiscard]] Checkpoint checkpoint_from(std::string_view bytes, const std::string& file);

/// Writes the file, which is on the disk when this returns. Throws OutputError.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);
/// Reads a checkpoint. Throws InputError.
[[nodiscard]] Checkpoint read_checkpoint(const std::string& path);

} // namespace hemilux
