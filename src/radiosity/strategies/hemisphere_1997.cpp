// The hemisphere subdivision technique of 1997 (paper section 4; Jolivet and Plemenos, GraphiCon
// 1997), which section 5 improves upon.
//
// A patch is cut, in thought, into 2 x 2 sub-patches with a divided hemisphere over the centre of
// each. In each of n steps all triangles are divided into four, at new directions on their edges
// that lie nearer to the end where more surfaces were counted (edge_division.h), and the counts
// along the new directions are stored with them. In m further steps triangles are divided likewise,
// but with estimated counts, and nothing is stored. Every triangle gets the same number of rays and
// power by its area: where many surfaces are, triangles are small and rays close. After n + m steps
// plain progressive refinement follows, the method `progressive-monte-carlo`.
//
// By default the area of a triangle is its projected solid angle, so that Lambert's law holds
// (docs/decisions.md, D1), rays start anywhere on the sub-patch (D2), and where there are fewer
// rays than triangles they are allocated by systematic sampling (D4). With --literal the area is
// the solid angle, rays start at the centre of the sub-patch, and each triangle gets one ray at
// least.
//
// Counting rays are shot before the first step and carry no energy. --depth and --threshold are not
// used: n and m stand below.
//
// Good for comparison. Bad because large triangles, where few surfaces are, get as few rays as
// small ones: these rays carry much power each and their noise is seen. Costs 41 rays per sub-patch
// and, with directions stored in floats, 13 bytes for each of them: 2132 bytes per patch, where the
// method `hemisphere` needs 41.

#include "radiosity/hemisphere/density.h"
#include "radiosity/plain/plain.h"
#include "radiosity/scene/edge_division.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/shooting/shooting.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

/// n and m. The paper names no values; each step more makes four times as many triangles, and there
/// should not be many more of them than rays.
constexpr int stored_steps = 2, estimated_steps = 1;
constexpr int guided_steps = stored_steps + estimated_steps;

constexpr std::size_t sub_patches = 4; ///< quarters of a patch
constexpr std::size_t triangles(int level) { return std::size_t{4} << (2 * level); }
static_assert(sub_patches * triangles(guided_steps) < whole_hemisphere);

class Hemisphere1997 final : public Strategy {
  public:
    Hemisphere1997(const SolverInput& input, const Workers& workers)
        : mesh_(input.mesh), needs_(input.needs), literal_(input.options.literal),
          rays_asked_(input.options.rays), topology_(stored_steps) {
        const std::size_t looking = needs_.densities ? mesh_.patches().size() : 1;
        const std::size_t places = looking * sub_patches * vertices();
        direction_.resize(places);
        count_.resize(places);
        workers.for_chunks(looking, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !input.monitor.interrupted; ++i) {
                if (needs_.densities && !needs_.power(static_cast<std::uint32_t>(i)))
                    continue;
                look(static_cast<std::uint32_t>(i), input.tracer);
                if (needs_.densities)
                    rays_ += sub_patches * vertices();
            }
        });
        input.monitor.rays += rays_;
        begin_step(0);
    }

    void begin_step(std::uint64_t step) override {
        if (step >= guided_steps) {
            allocated_.clear();
            allocated_.add(whole_hemisphere, 1);
            return;
        }
        level_ = static_cast<int>(step) + 1;
        const std::size_t cells = sub_patches * triangles(level_);
        double share = 1 / static_cast<double>(cells);
        if (literal_)
            share = std::max(std::round(rays_asked_ * share), 1.0) / rays_asked_;
        allocated_.clear();
        for (std::size_t cell = 0; cell < cells; ++cell)
            allocated_.add(static_cast<std::uint16_t>(cell), share);
    }

    Allocation allocate(std::uint32_t, AllocatedCells&) const override { return allocated_.view(); }

    [[nodiscard]] bool has_private_cells() const override { return true; }
    [[nodiscard]] std::optional<PrivateCell> private_cell(std::uint32_t patch,
                                                          std::uint16_t cell) const override {
        if (cell == whole_hemisphere)
            return std::nullopt;
        const Patch& whole = mesh_.patches()[patch];
        const std::size_t piece = cell / triangles(level_);
        const CountedTriangle corner = triangle(patch, piece, cell % triangles(level_));
        PrivateCell result{0,
                           {corner[0].direction, corner[1].direction, corner[2].direction},
                           quarters_of(whole.shape)[piece]};
        const double part = result.origins.area() / whole.area;
        const double share = literal_ ? result.shape.solid_angle() / (2 * std::numbers::pi)
                                      : result.shape.projected_solid_angle() / std::numbers::pi;
        result.power = part * std::max(share, 0.0);
        return result;
    }

    [[nodiscard]] std::uint64_t density_rays() const override { return rays_; }
    [[nodiscard]] std::uint64_t density_bytes() const override {
        return direction_.size() * sizeof(direction_[0]) + count_.size();
    }

  private:
    /// Of the stored triangles of one hemisphere.
    [[nodiscard]] std::size_t vertices() const { return topology_.vertices().size(); }

    /// Where the vertices of a sub-patch begin. Without densities all patches are alike.
    [[nodiscard]] std::size_t place(std::uint32_t patch, std::size_t piece) const {
        return ((needs_.densities ? patch : 0) * sub_patches + piece) * vertices();
    }

    [[nodiscard]] CountedDirection stored(std::size_t at) const {
        const auto& [x, y, z] = direction_[at];
        return {glm::normalize(Vec3(x, y, z)), static_cast<double>(count_[at])};
    }

    /// Finds all stored directions of a patch and counts the surfaces along them. Which triangles
    /// share a vertex is the same as in the regular subdivision; only the places differ.
    void look(std::uint32_t patch, const Tracer& tracer) {
        const Frame frame = mesh_.hemisphere_frame(patch);
        const auto pieces = quarters_of(mesh_.patches()[patch].shape);
        for (std::size_t piece = 0; piece < sub_patches; ++piece) {
            const std::size_t begin = place(patch, piece);
            const Vec3 centre = pieces[piece].centre();
            const auto keep = [&](std::size_t vertex, const Vec3& v) {
                Ray ray{centre, frame.to_world(density_direction(v))};
                ray.from = mesh_.patches()[patch].facet;
                direction_[begin + vertex] = {static_cast<float>(v.x), static_cast<float>(v.y),
                                              static_cast<float>(v.z)};
                count_[begin + vertex] = static_cast<std::uint8_t>(
                    needs_.densities ? std::min(tracer.count(ray), 255u) : 1u);
            };
            std::size_t known = 0; // vertices are numbered in the order in which cells need them
            for (; known < first_vertices; ++known)
                keep(known, topology_.vertices()[known]);
            for (std::size_t c = 0; c < Hemisphere::cells_up_to(stored_steps - 1); ++c)
                for (std::size_t edge = 0; edge < 3; ++edge) {
                    const Hemisphere::Cell& cell = topology_.cells()[c];
                    if (cell.midpoint[edge] < known)
                        continue;
                    const CountedDirection p1 = stored(begin + cell.vertex[edge]);
                    const CountedDirection p2 = stored(begin + cell.vertex[(edge + 1) % 3]);
                    keep(known++, point_on_arc(p1.direction, p2.direction,
                                               division_share(p1.surfaces, p2.surfaces)));
                }
        }
    }

    /// Triangle `index` of the present level: a stored one, or what becomes of it by estimation.
    [[nodiscard]] CountedTriangle triangle(std::uint32_t patch, std::size_t piece,
                                           std::size_t index) const {
        const int stored_level = std::min(level_, stored_steps);
        int below = 2 * (level_ - stored_level); // bits of the path from the stored triangle on
        const auto& vertex =
            topology_.cells()[Hemisphere::cells_up_to(stored_level - 1) + (index >> below)].vertex;
        const std::size_t begin = place(patch, piece);
        CountedTriangle corner = {stored(begin + vertex[0]), stored(begin + vertex[1]),
                                  stored(begin + vertex[2])};
        for (; below > 0; below -= 2)
            corner = estimated_child(corner, (index >> (below - 2)) % 4);
        return corner;
    }

    static constexpr std::size_t first_vertices = 5; ///< of the four octants

    const Mesh& mesh_;
    const Needs& needs_;
    bool literal_;
    double rays_asked_; ///< of each patch: N_hemi
    Hemisphere topology_;
    std::atomic<std::uint64_t> rays_{0};
    // By patch, sub-patch and vertex of the topology, in the patch's own frame.
    std::vector<std::array<float, 3>> direction_;
    std::vector<std::uint8_t> count_;
    int level_ = 1;            ///< of the present step's triangles
    AllocatedCells allocated_; ///< the same for all patches
};

std::unique_ptr<Strategy> make_hemisphere_1997(const SolverInput& input, const Hemisphere&,
                                               const Workers& workers) {
    return std::make_unique<Hemisphere1997>(input, workers);
}

} // namespace

extern const Method hemisphere_1997_method;
const Method hemisphere_1997_method{
    .name = "hemisphere-1997",
    .summary = "triangles shrunk towards many surfaces (Jolivet and Plemenos 1997; paper 4)",
    .has_literal = true,
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = shoot_with<make_hemisphere_1997>,
    .strategy = make_hemisphere_1997,
    .work = {.densities = true, .passes = true},
    .plain = plain::hemisphere_1997,
    .aims = true,
};

} // namespace hemilux
