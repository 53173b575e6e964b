#include "radiosity/engine/form_factors/exact_form_factors.h"

#include "geometry/box.h"
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>

namespace hemilux {

namespace {

constexpr double plane_rounding = 1e-9; ///< distance within a plane, as a share of the size
constexpr double sampled = -1;          ///< marks an entry

/// Where so many rays are expected hardly any row has none: one in fifty [-].
constexpr double enough_rays = 4;

/// Returns whether two boxes share more than their boundaries.
bool overlap(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(a.low[axis] < b.high[axis] - plane_rounding &&
              a.high[axis] > b.low[axis] + plane_rounding))
            return false;
    return true;
}

/// Returns the lowest and the highest place of outlines along a direction.
Vec2 range_along(const Vec3& direction, std::initializer_list<const Outline*> outlines) {
    Vec2 range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (const Outline* const outline : outlines)
        for (const Vec3& p : *outline) {
            range.x = std::min(range.x, glm::dot(direction, p));
            range.y = std::max(range.y, glm::dot(direction, p));
        }
    return range;
}

/// Returns whether a plane of one of a few directions separates a facet's part from the hull of a
/// pair. All lines of sight run in this hull.
bool separated(const Outline& part, const Vec3& normal, const FacingPair& pair) {
    const std::array<Vec3, 11> directions{{normal,
                                           {1, 1, 0},
                                           {1, -1, 0},
                                           {1, 0, 1},
                                           {1, 0, -1},
                                           {0, 1, 1},
                                           {0, 1, -1},
                                           {1, 1, 1},
                                           {1, 1, -1},
                                           {1, -1, 1},
                                           {-1, 1, 1}}};
    return std::ranges::any_of(directions, [&](const Vec3& direction) {
        const Vec2 of_part = range_along(direction, {&part});
        const Vec2 of_pair = range_along(direction, {&pair.from, &pair.to});
        return of_part.y <= of_pair.x + plane_rounding || of_part.x >= of_pair.y - plane_rounding;
    });
}

/// Returns whether nothing can stand between two patches. No facet or pane may have a part that is
/// in front of both planes, within the box of both and not separated from their hull.
bool nothing_between(std::span<const Polygon> shapes, std::span<const Box> boxes,
                     const FacingPair& pair, const Patch& from, const Patch& to) {
    const Plane first{from.shape.corner[0], from.normal}, second{to.shape.corner[0], to.normal};
    Box box = box_of(pair.from);
    box.include(box_of(pair.to));
    for (std::uint32_t f = 0; f < boxes.size(); ++f) {
        if (f == from.facet || f == to.facet || !overlap(boxes[f], box))
            continue;
        const Polygon& shape = shapes[f];
        const Outline part =
            in_front(in_front(outline_of(shape), first, plane_rounding), second, plane_rounding);
        if (!part.empty() && overlap(box_of(part), box) && !separated(part, shape.normal(), pair))
            return false;
    }
    return true;
}

} // namespace

ExactFormFactors::ExactFormFactors(const Mesh& mesh, const Workers& workers, const Monitor& monitor)
    : rows_(mesh.patches().size()) {
    std::vector<Polygon> shapes; // of facets, then of panes
    for (std::uint32_t f = 0; f < mesh.soup().facets.size(); ++f)
        shapes.push_back(mesh.shape_of(f));
    for (const Polygon& pane : local_panes(mesh))
        shapes.push_back(pane);
    std::vector<Box> boxes;
    for (const Polygon& shape : shapes)
        boxes.push_back(box_of(shape.corner));
    workers.for_chunks(rows_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !monitor.interrupted; ++i)
            find_row(mesh, static_cast<std::uint32_t>(i), shapes, boxes);
    });
    // The lower half follows by reciprocity.
    const auto patches = mesh.patches();
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
        for (const Entry& entry : rows_[i]) {
            if (entry.patch > i)
                rows_[entry.patch].push_back({i, entry.factor < 0 ? sampled
                                                                  : entry.factor * patches[i].area /
                                                                        patches[entry.patch].area});
        }
    }
    for (std::vector<Entry>& row : rows_)
        std::ranges::sort(row, {}, &Entry::patch);
}

void ExactFormFactors::find_row(const Mesh& mesh, std::uint32_t i, std::span<const Polygon> shapes,
                                std::span<const Box> boxes) {
    const auto patches = mesh.patches();
    for (std::uint32_t j = i + 1; j < patches.size(); ++j) {
        const FacingPair pair = facing_parts(patches[i].shape, patches[j].shape, plane_rounding);
        if (pair.from.empty())
            continue;
        const double smaller = std::min(patches[i].area, patches[j].area);
        const double factor = nothing_between(shapes, boxes, pair, patches[i], patches[j])
                                  ? exchange_area(pair.from, pair.to, smaller) / patches[i].area
                                  : sampled;
        rows_[i].push_back({j, factor});
    }
}

/// The exact factors of a row say what all else sums to: the sampled pairs and what is lost. Rays
/// only say how that is shared out, and all of it is scaled. If the pairs alone were, they would
/// take the noise of what is lost. Where too few rays are expected there, many rows have none and
/// scaling the others would be wrong on average. Then the exact factors are scaled to what the rays
/// leave.
SparseMatrix ExactFormFactors::matrix(const SampledFormFactors& samples) const {
    const SparseMatrix all = samples.matrix();
    std::vector<bool> is_emitter(rows_.size());
    for (const std::uint32_t emitter : samples.emitters())
        is_emitter[emitter] = true;
    SparseMatrix result;
    result.row_begin.push_back(0);
    std::vector<double> sampled_factor(rows_.size()); // of the row
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
        for (std::size_t k = all.row_begin[i]; k < all.row_begin[i + 1]; ++k)
            sampled_factor[all.column[k]] = all.value[k];
        double exact = 0, to_emitters = 0, by_counts = samples.lost()[i].sum();
        bool has_samples = false;
        for (const Entry& entry : rows_[i]) {
            has_samples = has_samples || entry.factor < 0;
            if (entry.factor >= 0)
                exact += entry.factor;
            else
                (is_emitter[entry.patch] ? to_emitters : by_counts) += sampled_factor[entry.patch];
        }
        double scale_of_exact = 1, scale_of_counts = 1;
        const double rest = std::max(1 - exact - to_emitters, 0.0);
        if (rest * samples.rays() >= enough_rays)
            scale_of_counts = by_counts > 0 ? rest / by_counts : 1;
        else if (has_samples && exact > 0)
            scale_of_exact = std::max(1 - to_emitters - by_counts, 0.0) / exact;
        for (const Entry& entry : rows_[i]) {
            const double factor =
                entry.factor >= 0
                    ? scale_of_exact * entry.factor
                    : sampled_factor[entry.patch] * (is_emitter[entry.patch] ? 1 : scale_of_counts);
            if (!(factor > 0))
                continue;
            result.column.push_back(entry.patch);
            result.value.push_back(factor);
        }
        for (std::size_t k = all.row_begin[i]; k < all.row_begin[i + 1]; ++k)
            sampled_factor[all.column[k]] = 0;
        result.row_begin.push_back(result.value.size());
    }
    return result;
}

std::optional<double> ExactFormFactors::factor(std::uint32_t i, std::uint32_t j) const {
    const auto found = std::ranges::lower_bound(rows_[i], j, {}, &Entry::patch);
    if (found == rows_[i].end() || found->patch != j)
        return 0.0;
    return found->factor >= 0 ? std::optional(found->factor) : std::nullopt;
}

std::uint64_t ExactFormFactors::exact_pairs() const {
    std::uint64_t count = 0;
    for (const std::vector<Entry>& row : rows_)
        count += static_cast<std::uint64_t>(
            std::ranges::count_if(row, [](const Entry& e) { return e.factor >= 0; }));
    return count / 2;
}

std::uint64_t ExactFormFactors::sampled_pairs() const {
    std::uint64_t count = 0;
    for (const std::vector<Entry>& row : rows_)
        count += row.size();
    return count / 2 - exact_pairs();
}

} // namespace hemilux
