#pragma once
// What a library has to say of a scene, of work under way and of a result. The program prints it,
// Python raises warnings and keeps it, a page shows it.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hemilux {

struct Finding {
    /// How much it matters to who asked.
    enum class Kind {
        detail,      ///< a figure of work under way, for those who follow it closely
        note,        ///< what was chosen, or what a result is
        warning,     ///< a result that may not be what was asked for, or a doubt about it
        ended_early, ///< what is left where the user asked the program to end
    };
    Kind kind = Kind::note;
    std::string text; ///< a sentence without its full stop
    /// What may help, which goes on with the sentence after a semicolon and names options of the
    /// command line; empty: nothing to be said.
    std::string advice = {};

    [[nodiscard]] std::string with_advice() const {
        return advice.empty() ? text : text + "; " + advice;
    }
};

using Findings = std::vector<Finding>;

/// Adds what was found, if anything was.
inline void add(Findings& all, std::optional<Finding> found) {
    if (found)
        all.push_back(*std::move(found));
}

} // namespace hemilux
