#include "radiosity/engine/factors/rows/open_views.h"

#include "geometry/elementary.h"
#include "radiosity/engine/factors/rows/row_rays.h"
#include "radiosity/engine/factors/rows/rows_done.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hemilux {
namespace {

constexpr std::uint32_t first_rays = 256; ///< of a patch in all directions

/// Rays of a patch to one side by which it begins, by which it gives up where none arrives, and the
/// most.
constexpr std::uint32_t first_to_side = 256, enough_for_none = 1024, most_to_side = 1 << 18;

/// Shares below this are asked for in absolute figures.
constexpr double least_share = .01;

/// Directions of a patch by Lambert's law that rise towards one side, up or down.
//
// Seen along the normal, directions by Lambert's law are uniform over the unit disc (Nusselt). The
// horizon of the side is half of an ellipse in it: with y the direction in which the side rises, c
// the cosine between it and the normal, and s = sqrt(1 - x^2), what rises has y from -c s to s. So
// a point of the disc becomes one of that part by a shift and a scale of its y.
class SideDirections {
  public:
    SideDirections(const Vec3& normal, const Vec3& side) : cosine_(glm::dot(normal, side)) {
        frame_ = Frame::from_normal(normal);
        const Vec3 along = side - cosine_ * normal;
        const double length = glm::length(along);
        if (length > 1e-9) {
            frame_.y = along / length;
            frame_.x = glm::cross(frame_.y, frame_.z);
        }
    }
    /// Returns the share of the patch's directions that rise [-].
    [[nodiscard]] double share() const { return (1 + cosine_) / 2; }
    /// Returns a direction, in the world, for a point of the unit square.
    [[nodiscard]] Vec3 at(Vec2 u) const {
        const Vec3 d = cosine_direction(u);
        const double s = std::sqrt(std::max(1 - d.x * d.x, 0.0));
        const double y = share() * d.y + (1 - share()) * s;
        const double z = std::sqrt(std::max(1 - d.x * d.x - y * y, 0.0));
        return frame_.to_world({d.x, y, z});
    }

  private:
    Frame frame_;
    double cosine_;
};

/// Rays of one patch to one side, with memory for the next; one for each thread.
class SideRays {
  public:
    SideRays(const Mesh& mesh, const Tracer& tracer, const OpenViewOptions& options)
        : mesh_(mesh), tracer_(tracer), options_(options) {}

    /// Goes to a patch and a side.
    void begin(std::uint32_t patch, Open open);
    /// Goes on to so many rays, a power of two, `blocks` at least.
    void go_on_to(std::uint32_t rays);
    [[nodiscard]] std::uint32_t rays() const { return count_; }
    [[nodiscard]] OpenShare share() const;
    [[nodiscard]] std::vector<OpenShare> bands() const;

  private:
    static constexpr std::size_t blocks = 16;
    /// The variance of the mean as a share of that of independent blocks: each block of the
    /// sequence lies where the others do not. In cities it was 0.3 to 0.5 of it.
    static constexpr double of_independent = .45;

    const Mesh& mesh_;
    const Tracer& tracer_;
    const OpenViewOptions& options_;
    std::uint32_t patch_ = 0, count_ = 0;
    double whole_ = 0; ///< share of the directions that rise
    Vec3 side_{};
    std::uint64_t seed_ = 0;
    std::array<std::uint32_t, blocks> arrived_{};
    std::vector<std::uint32_t> in_band_;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> targets_;
    std::vector<std::uint8_t> blocked_;
};

void SideRays::begin(std::uint32_t patch, Open open) {
    patch_ = patch;
    count_ = 0;
    side_ = Vec3(0.0);
    side_[options_.up] = open == Open::sky ? 1 : -1;
    seed_ = hash_words({options_.seed, patch, 100 + static_cast<std::uint64_t>(open)});
    arrived_ = {};
    in_band_.assign(options_.bands && open == Open::sky ? options_.bands->size() : 0, 0);
    whole_ = SideDirections(mesh_.patches()[patch].normal, side_).share();
}

void SideRays::go_on_to(std::uint32_t rays) {
    for (std::uint32_t before = count_; before > 0 && before < rays; before *= 2)
        for (std::size_t k = 0; k < blocks; ++k)
            arrived_[k] = 2 * k < blocks ? arrived_[2 * k] + arrived_[2 * k + 1] : 0;
    const auto of_block = static_cast<std::uint32_t>(rays / blocks);
    constexpr std::uint32_t at_a_time = 4096;
    const SideDirections directions(mesh_.patches()[patch_].normal, side_);
    const auto start = PatchStart::in_any_axes(mesh_, patch_);
    SobolBlocks<4> points(seed_);
    while (count_ < rays) {
        const std::uint32_t end = std::min(rays, count_ + at_a_time);
        rays_.clear();
        for (std::uint32_t k = count_; k < end; ++k) {
            const std::array<double, 4> u = points.at(k);
            rays_.push_back({.origin = start.points.sample({u[2], u[3]}),
                             .direction = directions.at({u[0], u[1]}),
                             .from = start.facet});
        }
        targets_.assign(rays_.size(), none);
        blocked_.resize(rays_.size());
        tracer_.occluded_stream(rays_, targets_, blocked_);
        for (std::size_t k = 0; k < rays_.size(); ++k) {
            if (blocked_[k])
                continue;
            ++arrived_[(count_ + k) / of_block];
            if (!in_band_.empty())
                ++in_band_[options_.bands->of(rays_[k].direction)];
        }
        count_ = end;
    }
}

OpenShare SideRays::share() const {
    const auto of_block = static_cast<std::uint32_t>(count_ / blocks);
    const auto [share, error] = share_of_blocks(arrived_, of_block, of_independent);
    return {whole_ * share, whole_ * error};
}

std::vector<OpenShare> SideRays::bands() const {
    std::vector<OpenShare> shares = shares_of(in_band_, count_);
    for (OpenShare& share : shares)
        share = {whole_ * share.factor, whole_ * share.standard_error};
    return shares;
}

} // namespace

OpenViews find_open_views(const Mesh& mesh, const Tracer& tracer, const OpenViewOptions& options,
                          const Workers& workers, Monitor& monitor) {
    const std::size_t patches = mesh.patches().size();
    OpenViews views;
    views.open.resize(patches);
    const std::size_t of_row = options.bands ? options.bands->size() : 0;
    views.bands.resize(patches * of_row);
    const auto keep_bands = [&](std::size_t i, const std::vector<OpenShare>& bands) {
        std::ranges::copy(bands, views.bands.begin() + static_cast<std::ptrdiff_t>(i * of_row));
    };
    const FacingBacks backs(mesh);
    const RowScene scene{mesh, tracer, backs, options.seed, options.up, options.bands};
    views.is_void = !trace_all_rows(scene, first_rays, "looking around", workers, monitor,
                                    [&](std::uint32_t i, const RowView& view) {
                                        views.open[i] = view.open;
                                        keep_bands(i, view.bands);
                                    });
    std::atomic<std::uint64_t> traced{patches * first_rays}, left{0};
    const auto find = [&](SideRays& rays, std::uint32_t i, Open open) {
        OpenShare& share = views.open[i][static_cast<std::size_t>(open)];
        if (!(share.standard_error > 0))
            return;
        rays.begin(i, open);
        for (std::uint32_t count = first_to_side;;) {
            rays.go_on_to(count);
            const OpenShare found = rays.share();
            const bool is_none = !(found.factor > 0) && count >= enough_for_none;
            const double excess =
                found.standard_error / (options.error * std::max(found.factor, least_share));
            if (is_none || excess <= 1 || count >= most_to_side || monitor.interrupted) {
                share = found;
                left += monitor.interrupted && !is_none && excess > 1 ? 1 : 0;
                break;
            }
            // The error falls about as the power -0.7 of the rays.
            const double wanted =
                found.factor > 0 ? count * elementary::pow(excess, 1 / .7) : enough_for_none;
            do
                count *= 2;
            while (count < most_to_side && 1.4 * count < wanted);
        }
        traced += rays.rays();
        monitor.rays += rays.rays();
        if (open == Open::sky)
            keep_bands(i, rays.bands());
    };
    RowsDone done(monitor, options.ground ? "measuring sky and ground" : "measuring the sky",
                  patches);
    workers.for_chunks_with(
        patches, 16, [&] { return SideRays(mesh, tracer, options); },
        [&](SideRays& rays, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (monitor.interrupted) {
                    ++left;
                    continue;
                }
                find(rays, static_cast<std::uint32_t>(i), Open::sky);
                if (options.ground)
                    find(rays, static_cast<std::uint32_t>(i), Open::ground);
            }
            done.add(end - begin);
        });
    views.rays = traced;
    views.rows_left = left;
    return views;
}

} // namespace hemilux
