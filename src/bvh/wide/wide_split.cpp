#include "bvh/wide/wide_split.h"

#include <algorithm>
#include <cmath>

namespace hemilux::wide {
namespace {

constexpr int bin_count = 16;
/// Larger ranges are binned by several threads, in pieces of this size.
constexpr std::size_t chunk = 1 << 16;

struct Bins {
    std::array<std::array<FloatBox, bin_count>, 3> box{};
    std::array<std::array<std::uint32_t, bin_count>, 3> count{};

    void merge(const Bins& other) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t b = 0; b < bin_count; ++b) {
                box[axis][b].include(other.box[axis][b]);
                count[axis][b] += other.count[axis][b];
            }
    }
};

/// A map from centres to bins. An axis along which they do not differ has scale 0.
struct Binning {
    F4 low, scale;

    explicit Binning(const FloatBox& centres) : low(centres.low), scale(F4::splat(0)) {
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = centres.high.v[axis] - centres.low.v[axis];
            if (extent > 1e-30f)
                scale.v[axis] = bin_count * (1 - 0x1p-20f) / extent;
        }
    }
    [[nodiscard]] F4 operator()(const Item& item) const { return (item.centre() - low) * scale; }
};

void fill_bins(std::span<const Item> items, const Binning& bin_of, Bins& bins) {
    for (const Item& item : items) {
        const F4 at = bin_of(item);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto b = static_cast<std::size_t>(static_cast<int>(at.v[axis]));
            bins.box[axis][b].include(item.low, item.high);
            ++bins.count[axis][b];
        }
    }
}

void fill_bins(std::span<const Item> items, const Binning& bin_of, Bins& bins,
               const Workers& workers) {
    if (items.size() <= chunk || workers.threads() == 1)
        return fill_bins(items, bin_of, bins);
    std::vector<Bins> parts((items.size() + chunk - 1) / chunk);
    workers.for_chunks(items.size(), chunk, [&](std::size_t begin, std::size_t end) {
        fill_bins(items.subspan(begin, end - begin), bin_of, parts[begin / chunk]);
    });
    for (const Bins& part : parts)
        bins.merge(part);
}

struct Split {
    std::size_t axis = 3;
    int bin = 0;
    float cost = std::numeric_limits<float>::infinity();
};

void sweep(const Bins& bins, std::size_t axis, Split& best) {
    std::array<float, bin_count> right_cost;
    FloatBox right;
    std::uint32_t count = 0;
    for (std::size_t b = bin_count; b-- > 1;) {
        right.include(bins.box[axis][b]);
        count += bins.count[axis][b];
        right_cost[b] = count == 0 ? std::numeric_limits<float>::infinity()
                                   : right.half_area() * blocks_of(count);
    }
    FloatBox left;
    count = 0;
    for (std::size_t b = 1; b < bin_count; ++b) {
        left.include(bins.box[axis][b - 1]);
        count += bins.count[axis][b - 1];
        if (count == 0)
            continue;
        const float cost = left.half_area() * blocks_of(count) + right_cost[b];
        if (cost < best.cost)
            best = {axis, static_cast<int>(b), cost};
    }
}

std::array<Range, 2> halve(std::span<const Item> items, const Range& range) {
    const std::uint32_t middle = range.begin + range.size() / 2;
    return {range_of(items, range.begin, middle), range_of(items, middle, range.end)};
}

} // namespace

Item::Item(const Vec3& low_corner, const Vec3& high_corner, std::uint32_t slot)
    : low(F4::splat(static_cast<float>(slot & 0xffff))),
      high(F4::splat(static_cast<float>(slot >> 16))) {
    for (int i = 0; i < 3; ++i) {
        low.v[i] = static_cast<float>(low_corner[i]);
        high.v[i] = static_cast<float>(high_corner[i]);
    }
}

Range range_of(std::span<const Item> items, std::uint32_t begin, std::uint32_t end) {
    Range range{begin, end, {}, {}};
    for (std::uint32_t i = begin; i < end; ++i)
        range.include(items[i]);
    return range;
}

std::array<Range, 2> divide(std::span<Item> items, const Range& range, bool balanced,
                            const Workers& workers) {
    const Binning bin_of(range.centres);
    Split split;
    if (!balanced) {
        Bins bins;
        fill_bins(items.subspan(range.begin, range.size()), bin_of, bins, workers);
        for (std::size_t axis = 0; axis < 3; ++axis)
            sweep(bins, axis, split);
    }
    if (split.axis == 3)
        return halve(items, range);

    // The loop runs from both ends towards the middle and collects the boxes of both parts.
    Range left{range.begin, range.begin, {}, {}}, right{range.end, range.end, {}, {}};
    while (left.end < right.begin) {
        const Item item = items[left.end];
        if (static_cast<int>(bin_of(item).v[split.axis]) < split.bin) {
            left.include(item);
            ++left.end;
        } else {
            right.include(item);
            items[left.end] = items[--right.begin];
            items[right.begin] = item;
        }
    }
    return {left, right};
}

} // namespace hemilux::wide
