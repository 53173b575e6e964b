#pragma once
// What is said of view factors that were computed: their errors, how far rows were from closed, and
// surfaces that are probably turned.

#include "app/factors/sunlit_run.h"
#include "app/settings/view_factor_settings.h"
#include "radiosity/answers/surfaces/surface_rows.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/rows/view_factors.h"

#include <span>

namespace hemilux {

/// Logs all of this, and warns where an error is larger than asked for.
void log_audit(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
               const ViewFactors& factors, double seconds);

/// Logs how many suns were done, and how exact their fractions are.
void log_sunlit(const ViewFactorSettings& settings, const SunlitRun& run, std::size_t suns,
                double seconds);

/// Logs how many points have rows, and how exact these are.
void log_points(const ViewFactorSettings& settings, std::span<const PointFactors> points,
                double seconds);

} // namespace hemilux
