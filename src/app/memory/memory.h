#pragma once
// --memory: what a scene will need is estimated before it is allocated. The program ends with exit
// code 3 where that is too much.

#include "app/settings/settings.h"
#include "radiosity/paper/scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hemilux {

/// Reads a number of bytes such as 800, 64k or 1.5G: k, M, G and T stand for powers of 1024.
[[nodiscard]] std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// The memory that a run needs at its peak, by parts [bytes].
struct MemoryNeed {
    double scene = 0;    ///< scene as read
    double mesh = 0;     ///< patches
    double tree = 0;     ///< tree for the rays
    double pairs = 0;    ///< pairs of facets in one plane, until they are offset
    double analysis = 0; ///< sides that face the light, and what light may reach
    double method = 0;   ///< the method; of several, all
    double results = 0;  ///< results while they are made and written
    /// Returns the peak of all parts [bytes]. The list of patches grows by being copied, before
    /// there is anything else.
    [[nodiscard]] double all() const {
        return scene +
               std::max(2 * mesh + pairs, mesh + tree + std::max(analysis, method + results));
    }
};

/// Returns the most patches that a division of the faces will make.
[[nodiscard]] double patches_of(const Scene& scene, const MeshOptions& options);
/// Returns the need of these methods side by side (none: of a command that solves nothing), after
/// `before` has run alone.
[[nodiscard]] MemoryNeed memory_need(const Scene& scene, const MeshOptions& mesh,
                                     const SolveOptions& options,
                                     std::span<const Method* const> methods,
                                     const Method* before = nullptr);

/// Returns the bytes at the peak of writing what a run leaves behind, all at once, for so many
/// patches [bytes]. Points of --points are counted apart.
[[nodiscard]] double bytes_of_results(const SolveSettings& settings, double patches);
/// Return the bytes at the peak of writing a picture of so many pixels, or for `compare` all of its
/// pictures.
[[nodiscard]] double bytes_of_picture(PixelSize size, bool gathered, unsigned threads);
[[nodiscard]] double bytes_of_compared_pictures(PixelSize size);
/// Returns the bytes of a lightmap with so many texels along a side, while it is made and written.
[[nodiscard]] double bytes_of_lightmap(int size, bool gathered, unsigned threads);
/// Returns the bytes of so many points of --points, while their light is gathered and written.
[[nodiscard]] double bytes_of_points(std::size_t points, unsigned gather);
/// What a layer of --layers has light of.
struct LayerSize {
    double patches = 0, points = 0;
    double texels = 0; ///< of all lightmaps
};
/// Returns the bytes of so many layers of --layers, besides the run whose light they share.
[[nodiscard]] double bytes_of_layers(const SolveSettings& settings, const MemoryNeed& run,
                                     const LayerSize& size, std::size_t layers);

/// Returns a check while the file is read, which throws std::runtime_error once that takes more
/// than the limit; without one, more than the machine has.
[[nodiscard]] std::function<void(double bytes)> memory_guard(const std::string& path,
                                                             std::optional<std::uint64_t> limit);
/// Makes this the check of every file that is read from now on.
void bound_inputs(std::optional<std::uint64_t> limit);
/// Does the same check before the file is read, by its size.
void check_memory_to_read(const std::string& path, std::optional<std::uint64_t> limit);
/// Checks the need before the faces are divided. Throws std::runtime_error, which says what is
/// needed for what, and `advice` on what needs less.
void check_memory(const MemoryNeed& need, std::optional<std::uint64_t> limit,
                  const std::string& path,
                  const std::string& advice = "a larger --max-edge, fewer --rays, a smaller "
                                              "--size or --no-gather need less");
/// Returns a check of lists whose length is known only as they are found: it throws
/// std::runtime_error where the run needs more than the limit with so many bytes of them.
[[nodiscard]] std::function<void(double bytes)> memory_guard(const MemoryNeed& need,
                                                             std::optional<std::uint64_t> limit,
                                                             const std::string& path,
                                                             const std::string& advice);

} // namespace hemilux
