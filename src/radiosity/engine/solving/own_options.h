#pragma once
// Holds the options of single methods besides those of all. Each method declares a type of its own,
// as ProgressiveOptions, and nobody else needs to know it.

#include "radiosity/paper/solving/solve_options.h"

#include <memory>
#include <utility>

namespace hemilux {

/// A list of values, each of a type that a method has declared. The first of a type counts. Values
/// do not change, so that copies of SolveOptions share them.
class OwnOptions {
  public:
    explicit OwnOptions(std::shared_ptr<const OwnOptions> set_before)
        : set_before_(std::move(set_before)) {}
    OwnOptions(const OwnOptions&) = delete;
    OwnOptions& operator=(const OwnOptions&) = delete;
    virtual ~OwnOptions() = default;
    [[nodiscard]] const OwnOptions* set_before() const { return set_before_.get(); }

  private:
    std::shared_ptr<const OwnOptions> set_before_;
};

template <class Options>
class OwnOptionsOf final : public OwnOptions {
  public:
    OwnOptionsOf(Options of_method, std::shared_ptr<const OwnOptions> set_before)
        : OwnOptions(std::move(set_before)), value(std::move(of_method)) {}
    const Options value;
};

/// Returns the options of this type; the defaults where nobody has set any. They stay where they
/// are until they are set anew.
template <class Options>
[[nodiscard]] const Options& own_options(const SolveOptions& options) {
    static const Options defaults{};
    for (const OwnOptions* at = options.own.get(); at; at = at->set_before())
        if (const auto* const found = dynamic_cast<const OwnOptionsOf<Options>*>(at))
            return found->value;
    return defaults;
}

/// Sets the options of this type.
template <class Options>
void set_own_options(SolveOptions& options, Options value) {
    options.own =
        std::make_shared<const OwnOptionsOf<Options>>(std::move(value), std::move(options.own));
}

} // namespace hemilux
