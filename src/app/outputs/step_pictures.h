#pragma once
// A picture after every step, for those who want to see a method at work.

#include "app/running/write_report.h"
#include "app/settings/settings.h"
#include "bvh/tracer.h"
#include "io/files/provenance.h"
#include "radiosity/answers/images/image.h"

#include <atomic>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// The pictures of all steps. They have one camera, chosen by the first step that has light to
/// show, and one exposure, so that one sees the light grow. The picture of step 12 for room.png is
/// room-0012.png. This refers to the scene and the flag.
class StepPictures {
  public:
    StepPictures(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer,
                 const std::atomic<bool>& interrupted);

    /// Writes the pictures of a step where --every-step asks for them, but none after the first
    /// failure or once a picture was interrupted.
    void write(std::span<const Vec3> radiosity, std::uint32_t step);

    /// Returns the camera of all steps, once it is known.
    [[nodiscard]] const std::optional<Camera>& camera() const { return view_.camera; }
    /// Returns what was written and what failed.
    [[nodiscard]] const WriteReport& report() const { return report_; }

  private:
    const Mesh& mesh_;
    const Tracer& tracer_;
    const std::atomic<bool>& interrupted_;
    std::vector<Output> pictures_; ///< the last ones, whose names those of steps have
    ViewSettings view_;            ///< as far as it is known
    Provenance from_;
    unsigned threads_;
    WriteReport report_;
};

} // namespace hemilux
