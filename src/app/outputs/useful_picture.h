#pragma once
// --useful: a run ends once its picture is, "Useful (Image)" of the paper.

#include "app/rendering/view.h"
#include "app/settings/settings.h"
#include "radiosity/paper/solution/solution.h"

#include <cstdint>

namespace hemilux {

/// Judges whether a picture of the patches looks as the one without noise would: whether their
/// structural similarity (ssim.h) is expected to be that of a good picture
/// (docs/paper/decisions.md, D66). The noise is what standard errors say, as much on patches that
/// no ray has met as a ray brings. What patches leave out is no part of it.
class UsefulPicture {
  public:
    UsefulPicture(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer)
        : mesh_(mesh), tracer_(tracer), view_(settings.view), threads_(settings.options.threads),
          seed_(settings.options.seed) {}

    /// The similarity from which on a picture is useful.
    static constexpr double useful = .95;

    /// Returns the similarity that is expected [-1, 1]; 0 where errors are not known yet.
    [[nodiscard]] double similarity(const Solution& solution);

  private:
    const Mesh& mesh_;
    const Tracer& tracer_;
    ViewSettings view_; ///< with the camera and the exposure of the first picture
    unsigned threads_;
    std::uint64_t seed_;
};

} // namespace hemilux
