// The list of the first program (cmake/FirstProgram.cmake).

#include "app/subcommands/first.h"

#include <array>

namespace hemilux {

Subcommands subcommands() {
    static constexpr std::array list{solve_subcommand, bake_subcommand, info_subcommand};
    return {list, model_subcommand,
            "\nThis is a part of hemilux, to begin with: ./demo.sh builds the whole."};
}

} // namespace hemilux
