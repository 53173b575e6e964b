#pragma once
// Figures that one method finds besides the light. Each has a name, which results print.

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hemilux {

class MethodFigures {
  public:
    /// Sets a figure. Its name outlives this: it is a constant of the method.
    void set(std::string_view name, std::uint64_t value) {
        const auto found = std::find_if(figures_.begin(), figures_.end(), Named{name});
        if (found == figures_.end())
            figures_.push_back({name, value});
        else
            found->value = value;
    }
    /// Returns a figure; 0 where the method finds none of that name.
    [[nodiscard]] std::uint64_t value(std::string_view name) const {
        const auto found = std::find_if(figures_.begin(), figures_.end(), Named{name});
        return found == figures_.end() ? 0 : found->value;
    }

  private:
    struct Figure {
        std::string_view name;
        std::uint64_t value;
    };
    struct Named {
        std::string_view name;
        bool operator()(const Figure& figure) const { return figure.name == name; }
    };
    std::vector<Figure> figures_;
};

} // namespace hemilux
