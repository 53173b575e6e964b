#pragma once
// Which axis of a scene points up, where neither the user nor the kind of file says so.

#include <optional>
#include <string>

namespace hemilux {

class Mesh;

struct UpGuess {
    int axis = 1;       ///< 1 for y, 2 for z
    std::string reason; ///< strongest evidence for that axis, as words that follow "as"
    double for_z = 0;   ///< all evidence; below 0 it speaks for y
};

/// Guesses the axis by what is usual: floors have that name and are larger than walls, scenes stand
/// on flat ground at a height of 0, emitters hang above and shine down, and the sun stands above.
/// `usual` is the axis that is customary in files of this kind; most must then speak against it.
/// Where it is empty the answer is y unless most speaks for z.
[[nodiscard]] UpGuess guess_up_axis(const Mesh& mesh, std::optional<int> usual = {});

/// Returns that axis alone.
[[nodiscard]] int guess_up(const Mesh& mesh, std::optional<int> usual = {});

} // namespace hemilux
