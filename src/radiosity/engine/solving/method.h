#pragma once
// Defines what the program and the tests know of a method: its name, what it does and needs, its
// options.

#include "radiosity/paper/solving/stop_rule.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

class EngineSolver;
class Hemisphere;
class Solver;
class Strategy;
class Workers;
struct MethodOption;
struct SolveOptions;
struct SolverInput;
/// Makes the strategy of a stepwise shooting method (strategy.h).
using MakeStrategy = std::unique_ptr<Strategy> (*)(const SolverInput&, const Hemisphere&,
                                                   const Workers&);

/// The work of a method that a scene may not need, and what comes of it.
struct MethodWork {
    bool densities = false;      ///< counts surfaces before it solves
    bool pairs = false;          ///< looks from patches to patches
    bool linear_systems = false; ///< solves one for each channel
    bool passes = false;         ///< solves again and again, to take the mean or with more rays
    bool ends_by_itself = false; ///< it takes as many steps as it needs: no number of them is usual
    bool estimates_error = true; ///< else a run ends by itself, and how far off it is is not known
};

/// The roles for which the program takes a method where the user names none. Each role is one
/// method's.
enum class Role {
    standard,   ///< solves
    reference,  ///< is taken for the truth in comparisons
    baseline,   ///< the others' gains are relative to it
    paper,      ///< shows how hemispheres are divided
    forerunner, ///< shows how they were divided before
};

/// A method as the user picks it. Members that not all methods need may be left out.
struct Method {
    std::string_view name;    ///< value of --method
    std::string_view summary; ///< one line for --help, with the source
    bool has_literal = false; ///< --literal changes it
    bool has_depth = false;   ///< --depth changes it
    bool unbiased;            ///< each step, in its corrected form; else consistent
    StopRule default_stop;    ///< rule where the user gives none
    std::unique_ptr<EngineSolver> (*make)(const SolverInput&);
    MakeStrategy strategy = nullptr; ///< what it shoots with; nullptr if it is no shooting method
    MethodWork work = {};            ///< what it does that a scene may not need
    bool takes_points = false; ///< it traces shadow rays to lights without extent (lit_by_points.h)
    bool saves = false;        ///< save and load are there; all shooting methods have them
    /// Makes the same on one page, slow and obviously right (paper/pages/pages.h); nullptr where
    /// there is none.
    std::unique_ptr<Solver> (*plain)(const SolverInput&) = nullptr;
    std::size_t max_plain_patches = std::numeric_limits<std::size_t>::max(); ///< limit of its page
    std::optional<Role> role = {};
    /// Returns whether --for changes it; nullptr: it never does.
    bool (*aims)() = nullptr;

    /// Returns its own options. Several methods may declare one of the same name: the first in
    /// alphabetical order knows all its values, the others may take fewer.
    std::vector<MethodOption> (*options)() = nullptr;
    /// Throws std::invalid_argument with what is wrong where options do not go together, or not
    /// with so many patches. If `patches` is 0, their number is not known yet.
    void (*check)(const SolveOptions&, std::size_t patches) = nullptr;
    /// Changes what it does (`work`) to what it does with these options.
    void (*adapt)(MethodWork&, const SolveOptions&) = nullptr;
    /// Returns roughly the bytes that it takes at the peak besides solutions and rays under way.
    double (*bytes)(const SolveOptions&, double patches) = nullptr;
    /// Returns the options that make it the one to solve with where --method is not given.
    std::vector<std::string> (*implied_by)() = nullptr;
    std::string_view former_name = {}; ///< what --method takes too; empty where there is none

    [[nodiscard]] bool can_resume() const { return saves || strategy; }
    [[nodiscard]] bool takes_target() const { return aims && aims(); }
    [[nodiscard]] std::vector<MethodOption> own_options() const;
    /// Returns what it does with these options.
    [[nodiscard]] MethodWork work_with(const SolveOptions& chosen) const;
};

/// Makes a solver of this class from its input, for Method::make.
template <class Class>
[[nodiscard]] std::unique_ptr<EngineSolver> make_solver_of(const SolverInput& input) {
    return std::make_unique<Class>(input);
}

/// Returns all methods, one per file of strategies/ and solvers/, in alphabetical order.
[[nodiscard]] std::span<const Method* const> methods();
/// Finds a method by its name or its former name; nullptr if there is no such method.
[[nodiscard]] const Method* find_method(std::string_view name);
/// Returns the method that has this role.
[[nodiscard]] const Method& method_of(Role role);

} // namespace hemilux
