#pragma once
// Figures that one method finds besides the light. Each has a name, which results print.

#include <cstdint>
#include <string_view>
#include <vector>

namespace hemilux {

class MethodFigures {
  public:
    /// Sets a figure. Its name outlives this: it is a constant of the method.
    void set(std::string_view name, std::uint64_t value) {
        for (Figure& figure : figures_)
            if (figure.name == name) {
                figure.value = value;
                return;
            }
        figures_.push_back({name, value});
    }
    /// Returns a figure; 0 where the method finds none of that name.
    [[nodiscard]] std::uint64_t value(std::string_view name) const {
        for (const Figure& figure : figures_)
            if (figure.name == name)
                return figure.value;
        return 0;
    }

  private:
    struct Figure {
        std::string_view name;
        std::uint64_t value;
    };
    std::vector<Figure> figures_;
};

} // namespace hemilux
