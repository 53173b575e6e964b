#pragma once
// Describes in words the work that a scene did not need and that was left out.

#include <string>
#include <vector>

namespace hemilux {

struct MethodWork;
struct Needs;
struct Solution;

/// Something that a scene did not need and that was therefore not done.
struct LeftOut {
    std::string what, why, saved;
};

/// Returns what every method leaves out.
[[nodiscard]] std::vector<LeftOut> left_out(const Needs& needs);
/// Returns what a method left out of its work in the run that found `solution`.
[[nodiscard]] std::vector<LeftOut> left_out(const Needs& needs, const MethodWork& work,
                                            const Solution& solution);

} // namespace hemilux
