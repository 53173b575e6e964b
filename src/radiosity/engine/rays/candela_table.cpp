#include "radiosity/engine/rays/candela_table.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

namespace hemilux {
namespace {

constexpr double degree = std::numbers::pi / 180;

bool ascend(std::span<const double> angles) {
    return std::ranges::adjacent_find(angles, std::greater_equal()) == angles.end();
}

/// The last of the angles that is not above x, but for the last of all, and the share of the way to
/// the next.
struct Place {
    std::size_t first;
    double share;
};
Place place_of(double x, std::span<const double> angles) {
    if (angles.size() < 2)
        return {0, 0};
    const auto after = std::ranges::upper_bound(angles, x) - angles.begin();
    const auto first = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(angles.size()) - 2));
    return {first, (x - angles[first]) / (angles[first + 1] - angles[first])};
}

} // namespace

CandelaTable::CandelaTable(std::vector<double> gamma, std::vector<double> c,
                           std::vector<double> candela)
    : gamma_(std::move(gamma)), c_(std::move(c)), candela_(std::move(candela)) {
    if (gamma_.size() < 2 || !ascend(gamma_) || gamma_.front() < 0 || gamma_.back() > 180)
        throw std::invalid_argument("expected two or more vertical angles that ascend from 0 to "
                                    "180 degrees");
    const bool from_0 = !c_.empty() && c_.front() == 0 &&
                        (c_.size() == 1 || c_.back() == 90 || c_.back() == 180 || c_.back() == 360);
    const bool from_90 = c_.size() > 1 && c_.front() == 90 && c_.back() == 270;
    if ((!from_0 && !from_90) || !ascend(c_))
        throw std::invalid_argument("expected horizontal angles that ascend from 0 to 0, 90, 180 "
                                    "or 360 degrees, or from 90 to 270");
    if (candela_.size() != gamma_.size() * c_.size() || std::ranges::min(candela_) < 0)
        throw std::invalid_argument("expected an intensity of 0 or more for each pair of angles");
    largest_ = std::ranges::max(candela_);
}

/// Returns the angle of the table that stands for an angle from 0 to 360 degrees.
double CandelaTable::folded(double c) const {
    if (c_.front() == 90)
        return c < 90 ? 180 - c : c > 270 ? 540 - c : c;
    if (c_.back() < 360 && c > 180)
        c = 360 - c;
    return c_.back() <= 90 && c > 90 ? 180 - c : c;
}

double CandelaTable::towards(const Vec3& direction, const Vec3& axis, const Vec3& side) const {
    const double along = glm::dot(direction, axis);
    const double x = glm::dot(direction, side), y = glm::dot(direction, glm::cross(axis, side));
    // Rounded angles at the very ends are those ends.
    constexpr double rounding = 1e-9;
    double gamma = elementary::atan2(elementary::hypot(x, y), along) / degree;
    if (gamma < gamma_.front() - rounding || gamma > gamma_.back() + rounding)
        return 0;
    gamma = std::clamp(gamma, gamma_.front(), gamma_.back());
    double around = elementary::atan2(y, x) / degree;
    around = folded(around < 0 ? around + 360 : around);
    const Place v = place_of(gamma, gamma_), h = place_of(around, c_);
    const auto at = [&](std::size_t c) {
        return std::lerp(candela(c, v.first), candela(c, v.first + 1), v.share);
    };
    return c_.size() < 2 ? at(0) : std::lerp(at(h.first), at(h.first + 1), h.share);
}

/// Between two angles the intensity is a + b gamma, and the integral of that times the sine is
/// known.
double CandelaTable::flux() const {
    const auto of_plane = [&](std::size_t c) {
        double sum = 0;
        for (std::size_t k = 0; k + 1 < gamma_.size(); ++k) {
            const double from = degree * gamma_[k], to = degree * gamma_[k + 1];
            const double b = (candela(c, k + 1) - candela(c, k)) / (to - from);
            sum += candela(c, k) * elementary::cos(from) - candela(c, k + 1) * elementary::cos(to) +
                   b * (elementary::sin(to) - elementary::sin(from));
        }
        return sum;
    };
    if (c_.size() < 2)
        return 2 * std::numbers::pi * of_plane(0);
    double sum = 0;
    for (std::size_t c = 0; c + 1 < c_.size(); ++c)
        sum += .5 * (of_plane(c) + of_plane(c + 1)) * degree * (c_[c + 1] - c_[c]);
    return sum * 360 / (c_.back() - c_.front());
}

} // namespace hemilux
