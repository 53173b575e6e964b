#include "radiosity/light/cached_light/irradiance_cells.h"

#include "geometry/numeric.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The number of samples for which a patch has half of its own residual.
constexpr double prior_of_patch = 16;

/// That of parts of patches is at least the same, and this share of the root of the number of all
/// samples. So both the noise of a cell and its size fall with more walks.
constexpr double share_of_root = .125;

/// The number of regions along each axis of the scene, and the largest share of its light that a
/// patch takes over from its region.
constexpr std::uint32_t regions_along_axis = 8;
constexpr double max_share = .5;

/// A cell is divided once it has so many samples, and so many times at the most.
constexpr std::uint32_t samples_to_divide = 64;
constexpr int max_depth = 12;

/// Moves from a place in a square to that in its quarter; returns the number of the quarter.
std::uint32_t quarter_of(Vec2& place) {
    place *= 2.0;
    std::uint32_t quarter = 0;
    if (place.x >= 1) {
        place.x -= 1;
        quarter = 1;
    }
    if (place.y >= 1) {
        place.y -= 1;
        quarter += 2;
    }
    return quarter;
}

Vec3 shrunk(const Vec3& larger, const Vec3& sum, double count, double prior) {
    return count > 0 ? glm::mix(larger, sum / count, count / (count + prior)) : larger;
}

} // namespace

Vec3 IrradianceCells::Region::share() const {
    const Vec3 share = ratio_or_zero(residual, irradiance) * (count / (count + prior_of_patch));
    return glm::clamp(share, Vec3(-max_share), Vec3(max_share));
}

IrradianceCells::IrradianceCells(const Mesh& mesh, const PatchLight& light)
    : mesh_(mesh), of_patch_(mesh.patches().size(), none),
      regions_(6 * regions_along_axis * regions_along_axis * regions_along_axis) {
    for (std::uint32_t i = 0; i < of_patch_.size(); ++i)
        irradiance_.push_back(ratio_or_zero(light.radiosity[i] - mesh.material(i).emission,
                                            mesh.material(i).reflectance));
}

/// The scene lies within [-1,1]^3.
std::uint32_t IrradianceCells::region_of(std::uint32_t patch) const {
    const Patch& on = mesh_.patches()[patch];
    std::uint32_t region = 0;
    for (int axis = 0; axis < 3; ++axis)
        region =
            region * regions_along_axis +
            static_cast<std::uint32_t>(std::clamp(.5 * (on.centre[axis] + 1) * regions_along_axis,
                                                  0.0, regions_along_axis - 1.0));
    const Vec3 size = glm::abs(on.normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 6 * region + static_cast<std::uint32_t>(2 * axis + (on.normal[axis] < 0 ? 1 : 0));
}

Vec2 IrradianceCells::place_of(std::uint32_t patch, const Vec3& point) const {
    const Patch& on = mesh_.patches()[patch];
    const Frame frame = Frame::from_normal(on.normal);
    const Vec3 way = (point - on.centre) / (2 * radius_of(on));
    return {.5 + glm::dot(way, frame.x), .5 + glm::dot(way, frame.y)};
}

void IrradianceCells::add(std::span<const Sample> samples) {
    samples_ += static_cast<double>(samples.size());
    for (const auto& [patch, point, residual] : samples) {
        std::uint32_t cell = of_patch_[patch];
        if (cell == none) {
            cell = of_patch_[patch] = static_cast<std::uint32_t>(cells_.size());
            cells_.push_back({.parts = none});
        }
        Vec2 place = place_of(patch, point);
        for (int depth = 0;; ++depth) {
            Cell& here = cells_[cell];
            here.sum += residual;
            ++here.count;
            if (here.parts == none) {
                if (here.count < samples_to_divide || depth == max_depth)
                    break;
                here.parts = static_cast<std::uint32_t>(cells_.size());
                cells_.insert(cells_.end(), 4, Cell{.parts = none});
                break;
            }
            cell = here.parts + quarter_of(place);
        }
        Region& region = regions_[region_of(patch)];
        region.residual += residual;
        region.irradiance += irradiance_[patch];
        ++region.count;
    }
}

void IrradianceCells::update() {
    prior_ = std::max(prior_of_patch, share_of_root * std::sqrt(samples_));
    for (std::uint32_t patch = 0; patch < of_patch_.size(); ++patch) {
        if (of_patch_[patch] == none)
            continue;
        Cell& whole = cells_[of_patch_[patch]];
        const Vec3 larger = regions_[region_of(patch)].share() * irradiance_[patch];
        whole.residual = shrunk(larger, whole.sum, whole.count, prior_of_patch);
        update_parts(whole);
    }
}

void IrradianceCells::update_parts(const Cell& larger) {
    if (larger.parts == none)
        return;
    for (std::uint32_t part = larger.parts; part < larger.parts + 4; ++part) {
        cells_[part].residual =
            shrunk(larger.residual, cells_[part].sum, cells_[part].count, prior_);
        update_parts(cells_[part]);
    }
}

IrradianceCells::Known IrradianceCells::at(std::uint32_t patch, const Vec3& point) const {
    const Patch& on = mesh_.patches()[patch];
    std::uint32_t cell = of_patch_[patch];
    if (cell == none)
        return {samples_ > 0 ? regions_[region_of(patch)].share() * irradiance_[patch] : Vec3(0.0),
                std::sqrt(on.area)};
    double side = std::sqrt(on.area);
    const Cell* here = &cells_[cell];
    if (here->parts != none) {
        Vec2 place = place_of(patch, point);
        while (here->parts != none) {
            const Cell& part = cells_[here->parts + quarter_of(place)];
            if (part.count < prior_)
                break;
            here = &part;
            side /= 2;
        }
    }
    return {here->residual, side};
}

std::size_t IrradianceCells::bytes() const {
    return cells_.size() * sizeof(Cell) + of_patch_.size() * sizeof(std::uint32_t);
}

} // namespace hemilux
