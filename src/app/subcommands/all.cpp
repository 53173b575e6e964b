// The list of the whole program.

#include "app/settings/dim_settings.h"
#include "app/settings/view_factor_settings.h"
#include "app/subcommands/first.h"

#include <array>

namespace hemilux {

Subcommands subcommands() {
    static constexpr std::array list{
        solve_subcommand,
        bake_subcommand,
        AddSubcommand(subcommand<CompareSettings, add_compare_command, compare>),
        AddSubcommand(subcommand<DensitySettings, add_density_command, density>),
        AddSubcommand(subcommand<FormFactorSettings, add_formfactors_command, formfactors>),
        AddSubcommand(subcommand<ViewFactorSettings, add_viewfactors_command, viewfactors>),
        AddSubcommand(subcommand<ViewFactorSettings, add_exchange_command, viewfactors>),
        AddSubcommand(subcommand<DimSettings, add_dim_command, dim>),
        info_subcommand};
    return {list, model_subcommand, ""};
}

} // namespace hemilux
