#include "radiosity/engine/densities/cell_directions.h"

namespace hemilux {
namespace {

/// The memory in which the samples' numbers and directions are computed.
struct Attempt {
    static constexpr std::size_t room = DirectionBatch::room;
    alignas(64) std::array<double, room> a, b, c, d, x, y, z;
    std::array<std::int32_t, room> cell;
    std::array<std::uint32_t, room> inside;
};

} // namespace

CellDirections::CellDirections(const Hemisphere& hemisphere, CellArea area) {
    const auto cells = static_cast<std::uint16_t>(hemisphere.cells().size());
    for (std::uint16_t cell = 0; cell < cells; ++cell) {
        add(hemisphere.cells()[cell].shape);
        power_shares_.push_back(hemilux::power_share(hemisphere, cell, area));
    }
    for (std::size_t i = 0; i < parts_.size(); ++i)
        shapes_.part[i] = parts_[i].data();
}

void CellDirections::add(const SphericalTriangle& triangle) {
    auto part = parts_.begin();
    for (const Vec3& plane : triangle.planes())
        for (int axis = 0; axis < 3; ++axis)
            (part++)->push_back(plane[axis]);
    const auto& [corner, edges, is_half] = triangle.hull();
    for (const Vec2& each : {corner, edges[0], edges[1]})
        for (int axis = 0; axis < 2; ++axis)
            (part++)->push_back(each[axis]);
    part->push_back(is_half ? 1 : 0);
}

void CellDirections::draw(DirectionBatch& batch) const {
    const SamplingKernels& kernels = sampling_kernels();
    const std::size_t n = batch.size;
    Attempt now;
    kernels.random({batch.key_low.data(), batch.key_high.data(), batch.number.data()}, n, 0,
                   now.a.data(), now.b.data(), batch.u.data(), batch.v.data());
    std::size_t wholes = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const bool whole = batch.cell[k] == whole_hemisphere;
        wholes += whole;
        now.cell[k] = whole ? 0 : batch.cell[k];
    }
    if (wholes < n)
        kernels.in_cells(shapes_, n, now.cell.data(), now.a.data(), now.b.data(), batch.x.data(),
                         batch.y.data(), batch.z.data(), now.inside.data());
    if (wholes > 0) {
        kernels.cosine(n, now.a.data(), now.b.data(), now.x.data(), now.y.data(), now.z.data());
        for (std::size_t k = 0; k < n; ++k)
            if (batch.cell[k] == whole_hemisphere) {
                batch.x[k] = now.x[k], batch.y[k] = now.y[k], batch.z[k] = now.z[k];
                now.inside[k] = 1;
            }
    }
    std::array<std::uint32_t, DirectionBatch::room> missed;
    std::size_t misses = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
        missed[misses] = k;
        misses += 1 - now.inside[k];
    }
    if (misses > 0)
        try_again(batch, std::span(missed).first(misses));
}

/// Draws those that have missed again, attempt after attempt. This ends soon: a cell fills more
/// than two fifths of the hull around it.
void CellDirections::try_again(DirectionBatch& batch, std::span<std::uint32_t> missed) const {
    const SamplingKernels& kernels = sampling_kernels();
    std::array<std::uint32_t, DirectionBatch::room> low, high, number;
    Attempt now;
    for (std::uint32_t attempt = 1; !missed.empty(); ++attempt) {
        for (std::size_t i = 0; i < missed.size(); ++i) {
            low[i] = batch.key_low[missed[i]];
            high[i] = batch.key_high[missed[i]];
            number[i] = batch.number[missed[i]];
            now.cell[i] = batch.cell[missed[i]];
        }
        kernels.random({low.data(), high.data(), number.data()}, missed.size(), attempt,
                       now.a.data(), now.b.data(), now.c.data(), now.d.data());
        kernels.in_cells(shapes_, missed.size(), now.cell.data(), now.a.data(), now.b.data(),
                         now.x.data(), now.y.data(), now.z.data(), now.inside.data());
        std::size_t misses = 0;
        for (std::size_t i = 0; i < missed.size(); ++i) {
            const std::uint32_t k = missed[i];
            batch.x[k] = now.x[i], batch.y[k] = now.y[i], batch.z[k] = now.z[i];
            missed[misses] = k;
            misses += 1 - now.inside[i];
        }
        missed = missed.first(misses);
    }
}

} // namespace hemilux
