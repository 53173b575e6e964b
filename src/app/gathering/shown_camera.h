#pragma once
// The camera of a run's pictures, of which the user hears where the program chose it.

#include "app/rendering/view.h"
#include "app/settings/settings.h"

namespace hemilux {

/// Returns camera_of(); one that was chosen is logged.
[[nodiscard]] Camera shown_camera_of(const ViewSettings& view, const LitScene& scene,
                                     Verbosity verbosity);

} // namespace hemilux
