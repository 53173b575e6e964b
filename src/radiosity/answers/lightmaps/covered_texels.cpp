#include "radiosity/answers/lightmaps/covered_texels.h"

#include "geometry/frame.h"
#include "parallel/workers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

/// The rays from a point, and how many of them may be free where it is covered.
constexpr std::uint32_t rays_of_point = 8, max_free = 1;

/// What is nearer than this share of a texel's side touches, and what is nearer than rounding.
constexpr double touching_share = .02, touching = 1e-7;

/// The texels between those that are tried first, in a large lightmap. Where these agree, the
/// others are as they are; in a small one objects may be smaller than that.
constexpr int max_stride = 4, size_of_stride = 512;

bool is_covered(const Mesh& mesh, const Tracer& tracer, const TexelMap& texels, std::size_t texel) {
    const SurfacePoint point = texels.point(texel);
    const double near = std::max(touching, touching_share * texels.side(texel));
    const Frame frame = Frame::from_normal(point.normal);
    SobolBlocks<4> numbers(hash_words({texel}));
    std::uint32_t free = 0;
    for (std::uint32_t k = 0; k < rays_of_point; ++k) {
        const auto u = numbers.at(k);
        const auto hit = tracer.closest(point.ray(frame.to_world(cosine_direction({u[0], u[1]}))));
        const bool is_inside = hit && (hit->t < near || mesh.patch_at(*hit) == none);
        if (!is_inside && ++free > max_free)
            return false;
    }
    return true;
}

} // namespace

std::vector<bool> find_covered(const Mesh& mesh, const Tracer& tracer, const TexelMap& texels,
                               const std::function<void()>& check, const Workers& workers) {
    enum State : std::uint8_t { unknown, is_free, covered };
    const int size = texels.size(), stride = std::clamp(size / size_of_stride, 1, max_stride);
    std::vector<std::uint8_t> state(texels.count(), unknown);
    const auto try_texel = [&](std::size_t texel) {
        if (texels.shows(texel) && state[texel] == unknown)
            state[texel] = is_covered(mesh, tracer, texels, texel) ? covered : is_free;
    };
    const auto for_rows = [&](const auto& visit) {
        workers.for_chunks(static_cast<std::size_t>(size), 4,
                           [&](std::size_t begin, std::size_t end) {
                               check();
                               for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                                   visit(y);
                           });
    };
    for_rows([&](int y) {
        for (int x = 0; y % stride == 0 && x < size; x += stride)
            try_texel(texels.index(x, y));
    });
    const std::vector<std::uint8_t> tried = state;
    for_rows([&](int y) {
        for (int x = 0; x < size; ++x) {
            const std::size_t texel = texels.index(x, y);
            if (!texels.shows(texel) || state[texel] != unknown)
                continue;
            // The tried texels around are of one chart and free, or this one is tried too.
            const int left = x / stride * stride, top = y / stride * stride;
            bool all_free = true;
            for (const int row : {top, std::min(top + stride, size - 1)})
                for (const int column : {left, std::min(left + stride, size - 1)}) {
                    const std::size_t other = texels.index(column, row);
                    all_free = all_free && tried[other] == is_free &&
                               texels.triangle(other).chart == texels.triangle(texel).chart;
                }
            if (all_free)
                state[texel] = is_free;
            else
                try_texel(texel);
        }
    });
    std::vector<bool> marks(texels.count());
    for (std::size_t k = 0; k < marks.size(); ++k)
        marks[k] = state[k] == covered;
    return marks;
}

} // namespace hemilux
