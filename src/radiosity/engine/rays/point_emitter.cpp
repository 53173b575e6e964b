#include "radiosity/engine/rays/point_emitter.h"

#include "geometry/elementary.h"
#include "geometry/frame.h"
#include "geometry/numeric.h"
#include "radiosity/engine/rays/candela_table.h"
#include "radiosity/paper/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace hemilux {
namespace {

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double within_cone(const PointEmitter& emitter, double cosine) {
    if (cosine >= emitter.cos_inner)
        return 1;
    if (!(cosine > emitter.cos_outer))
        return 0;
    const double share = (cosine - emitter.cos_outer) / (emitter.cos_inner - emitter.cos_outer);
    return share * share;
}

} // namespace

double relative_intensity(const PointEmitter& emitter, const Vec3& direction) {
    if (emitter.table)
        return emitter.table->towards(direction, emitter.axis, emitter.side);
    return within_cone(emitter, glm::dot(direction, emitter.axis));
}

double max_relative_intensity(const PointEmitter& emitter) {
    return emitter.table ? emitter.table->largest() : 1;
}

/// The nearest direction to the axis is turned towards it by the whole angle.
double max_relative_intensity(const PointEmitter& emitter, const Vec3& direction, double cosine,
                              double sine) {
    if (emitter.table)
        return emitter.table->largest();
    const double from_axis = glm::dot(direction, emitter.axis);
    if (from_axis >= cosine)
        return 1;
    return within_cone(emitter, from_axis * cosine + safe_sqrt(1 - from_axis * from_axis) * sine);
}

Vec3 random_direction(const PointEmitter& emitter, Vec2 u) {
    const double least = std::max(emitter.cos_outer, -1.0);
    const double cosine = 1 - u.x * (1 - least);
    const Vec2 around = elementary::on_circle(2 * std::numbers::pi * u.y);
    const double sine = safe_sqrt(1 - cosine * cosine);
    return Frame::from_normal(emitter.axis).to_world({sine * around.x, sine * around.y, cosine});
}

/// The integral of the square between the cones, over the cosine, is a third.
double power_per_intensity(const PointEmitter& emitter) {
    if (emitter.table)
        return emitter.table->flux();
    const double inner = std::max(emitter.cos_inner, -1.0),
                 outer = std::max(emitter.cos_outer, -1.0);
    return 2 * std::numbers::pi * (1 - inner + (inner - outer) / 3);
}

std::span<const PointEmitter> point_emitters_of(const Scene& scene) {
    return scene.point_emitters ? std::span<const PointEmitter>(*scene.point_emitters)
                                : std::span<const PointEmitter>{};
}

Vec3 power_of_point_emitters(const Scene& scene) {
    Vec3 power(0.0);
    for (const PointEmitter& emitter : point_emitters_of(scene))
        power += power_per_intensity(emitter) * emitter.intensity;
    return power;
}

void add_point_emitter(Scene& scene, const PointEmitter& emitter) {
    const Vec3& i = emitter.intensity;
    if (!is_finite(emitter.position) || !is_finite(i) || std::min({i.x, i.y, i.z}) < 0)
        throw std::invalid_argument("light '" + emitter.name +
                                    "' has a place or an intensity that is no number to go on "
                                    "with, or an intensity below 0");
    auto all = scene.point_emitters
                   ? std::make_shared<std::vector<PointEmitter>>(*scene.point_emitters)
                   : std::make_shared<std::vector<PointEmitter>>();
    all->push_back(emitter);
    scene.point_emitters = std::move(all);
}

} // namespace hemilux
