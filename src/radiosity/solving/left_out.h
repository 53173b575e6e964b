#pragma once
// In words, what a scene did not need and what was therefore not done.

#include <string>
#include <vector>

namespace hemilux {

struct Method;
struct Needs;
struct Solution;

/// Something that a scene did not need and that was therefore not done.
struct LeftOut {
    std::string what, why, saved;
};

/// In words: by any method.
[[nodiscard]] std::vector<LeftOut> left_out(const Needs& needs);
/// By this one, in a run that came to this solution.
[[nodiscard]] std::vector<LeftOut> left_out(const Needs& needs, const Method& method,
                                            const Solution& solution);

} // namespace hemilux
