#pragma once
// The work that a scene did not need and that was left out, in words.

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

/// What every method leaves out.
[[nodiscard]] std::vector<LeftOut> left_out(const Needs& needs);
/// What a method left out of its work in the run that found `solution`.
[[nodiscard]] std::vector<LeftOut> left_out(const Needs& needs, const MethodWork& work,
                                            const Solution& solution);

} // namespace hemilux
