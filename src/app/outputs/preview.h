#pragma once
// A coarse picture while a run goes on, so that a viewer shows how it gets on.

#include "app/rendering/view.h"
#include "app/settings/settings.h"

#include <optional>
#include <vector>

namespace hemilux {

struct Solution;

/// Returns whether outputs are written before the end: the settings ask for it, or a terminal shows
/// the run.
[[nodiscard]] bool shows_previews(const SolveSettings& settings);

/// Writes the .png files of a run before its end: by the light of the patches, in squares, then
/// with the rows that are gathered. The first one is written after a second of processor time, or
/// when the gathering of a picture that is not small begins. Each takes its share of the time: the
/// next one waits for many times as long as it took. What the run writes in the end does not depend
/// on it.
class Preview {
  public:
    /// Does nothing unless the settings ask for it or a terminal shows the run.
    Preview(const SolveSettings& settings, const std::atomic<bool>& interrupted);

    /// Shows the light of the patches, where it is time for that. `camera` is that of pictures, if
    /// it is chosen.
    void show(const LitScene& scene, const Solution& solution,
              const std::optional<Camera>& camera = {});
    /// Shows it as what the gathering begins with.
    void begin_gathering(const LitScene& scene, const Solution& solution, const Camera& camera);
    /// Shows so many rows of a picture, from the top, above that light.
    void show_rows(const Image& picture, int rows);

  private:
    [[nodiscard]] bool is_due() const;
    void render(const LitScene& scene, const Solution& solution);
    void write();

    const SolveSettings& settings_;
    const std::atomic<bool>& interrupted_;
    std::vector<Output> pictures_;
    ViewSettings view_; ///< with the camera and the exposure, once they are chosen
    Image image_;       ///< as it was written last; empty before
    double next_ = 1;   ///< processor time at which the next one may be written [s]
    double begun_ = 0;  ///< at which the last one was begun
};

} // namespace hemilux
