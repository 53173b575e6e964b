#pragma once
// The subcommands. Each returns the exit code or throws UsageError, InputError or OutputError.

#include "app/settings/settings.h"

namespace hemilux {

struct DimSettings;        // dim_settings.h
struct ViewFactorSettings; // view_factor_settings.h

int solve(const SolveSettings& settings);
/// `hemilux MODEL`: solves it with a light where it has none, and writes a picture of it where
/// nothing else is asked for.
int light_model(SolveSettings settings);
/// Writes the scene's own file with its ambient occlusion; nothing is solved.
int bake_occlusion(const SolveSettings& settings);
int compare(const CompareSettings& settings);
int density(DensitySettings settings);
int formfactors(const FormFactorSettings& settings);
/// `viewfactors`, and `exchange`, whose settings have heat.
int viewfactors(const ViewFactorSettings& settings);
int dim(const DimSettings& settings);
int info(const InfoSettings& settings);

} // namespace hemilux
