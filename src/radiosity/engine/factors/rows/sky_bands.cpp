#include "radiosity/engine/factors/rows/sky_bands.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The axes that point east and north, by the one that points up.
struct Compass {
    Vec3 east, north;
};
constexpr std::array<Compass, 3> compasses = {{{Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                               {Vec3(1, 0, 0), Vec3(0, 0, -1)},
                                               {Vec3(1, 0, 0), Vec3(0, 1, 0)}}};

} // namespace

SkyBands::SkyBands(double step, std::vector<std::size_t> parts, int up)
    : step_(step), parts_(std::move(parts)), first_(1, 0) {
    up_[up] = 1;
    east_ = compasses[static_cast<std::size_t>(up)].east;
    north_ = compasses[static_cast<std::size_t>(up)].north;
    for (std::size_t ring = 0; ring < parts_.size(); ++ring) {
        first_.push_back(first_.back() + parts_[ring]);
        lower_.push_back(elementary::sin(static_cast<double>(ring) * step_ * degree));
    }
}

SkyBands SkyBands::of_equal_steps(unsigned count, int up) {
    return {90.0 / count, std::vector<std::size_t>(count, 1), up};
}

SkyBands SkyBands::tregenza(int up) { return {12, {30, 30, 24, 24, 18, 12, 6, 1}, up}; }

std::size_t SkyBands::of(const Vec3& direction) const {
    const double height = glm::dot(direction, up_);
    const auto above = std::upper_bound(lower_.begin(), lower_.end(), height);
    const auto ring =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - lower_.begin() - 1, 0));
    const std::size_t parts = parts_[ring];
    if (parts == 1)
        return first_[ring];
    const double turn = elementary::atan2(glm::dot(direction, east_), glm::dot(direction, north_)) /
                        (2 * std::numbers::pi);
    const double place = (turn < 0 ? turn + 1 : turn) * static_cast<double>(parts) + .5;
    return first_[ring] + static_cast<std::size_t>(place) % parts;
}

std::size_t SkyBands::ring_of(std::size_t band) const {
    return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), band) -
                                    first_.begin()) -
           1;
}

std::string SkyBands::name(std::size_t band) const {
    if (parts_.front() > 1)
        return "sky " + std::to_string(band + 1);
    const auto degrees = [this](std::size_t ring) {
        const double tenths = std::round(10 * step_ * static_cast<double>(ring));
        const auto whole = static_cast<unsigned>(tenths) / 10,
                   rest = static_cast<unsigned>(tenths) % 10;
        return std::to_string(whole) + (rest > 0 ? "." + std::to_string(rest) : "");
    };
    return "sky " + degrees(band) + "-" + degrees(band + 1);
}

Vec3 SkyBands::middle(std::size_t band) const {
    const std::size_t ring = ring_of(band), parts = parts_[ring];
    if (parts == 1)
        return up_;
    const double altitude = (static_cast<double>(ring) + .5) * step_ * degree;
    const Vec2 around = elementary::on_circle(static_cast<double>(band - first_[ring]) /
                                              static_cast<double>(parts) * 2 * std::numbers::pi);
    return elementary::cos(altitude) * (around.x * north_ + around.y * east_) +
           elementary::sin(altitude) * up_;
}

std::vector<OpenShare> shares_of(std::span<const std::uint32_t> counts, std::uint32_t rays) {
    std::vector<OpenShare> shares;
    for (const std::uint32_t count : counts) {
        const double p = (count + .5) / (rays + 1.0);
        shares.push_back(
            {static_cast<double>(count) / rays, std::sqrt(p * (1 - p) / (rays + 1.0))});
    }
    return shares;
}

void scale_to_sum(std::span<OpenShare> shares, double sum) {
    double before = 0;
    for (const OpenShare& share : shares)
        before += share.factor;
    for (OpenShare& share : shares)
        if (before > 0) {
            share.factor *= sum / before;
            share.standard_error *= sum > 0 ? sum / before : 1;
        } else {
            share.factor = sum / static_cast<double>(shares.size());
        }
}

} // namespace hemilux
