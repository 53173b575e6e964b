#pragma once
// Holds the options of single methods besides those of all. Each method declares a type of its own,
// as ProgressiveOptions, and nobody else needs to know it.

#include <any>
#include <map>
#include <typeindex>

namespace hemilux {

/// Holds one value of each type that a method asks for.
class OwnOptions {
  public:
    /// Returns the value of this type; the default where nobody has set it.
    template <class Options>
    [[nodiscard]] const Options& of() const {
        static const Options defaults{};
        const auto found = values_.find(typeid(Options));
        return found == values_.end() ? defaults : *std::any_cast<Options>(&found->second);
    }
    /// Returns the same, to be set. It stays where it is as long as this object.
    template <class Options>
    [[nodiscard]] Options& of() {
        std::any& value = values_[typeid(Options)];
        if (!value.has_value())
            value = Options{};
        return *std::any_cast<Options>(&value);
    }

  private:
    std::map<std::type_index, std::any> values_;
};

} // namespace hemilux
