#include "radiosity/engine/emitters/point_emitters.h"

#include "geometry/numeric.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hemilux {

PointEmitters::PointEmitters(const Mesh& mesh) {
    const std::span<const PointEmitter> of_scene = point_emitters_of(mesh.scene());
    emitters_.assign(of_scene.begin(), of_scene.end());
    const double scale = mesh.frame().scale;
    for (PointEmitter& emitter : emitters_) {
        emitter.position = mesh.frame().to_local(emitter.position);
        emitter.intensity *= scale * scale;
        balance_ = glm::max(balance_, emitter.intensity);
    }
    balance_ = ratio_or_zero(Vec3(1.0), balance_);
}

std::optional<PointEmitters::Arriving> PointEmitters::at(std::size_t k,
                                                         const SurfacePoint& point) const {
    const PointEmitter& emitter = emitters_[k];
    const Vec3 way = emitter.position - point.position;
    const double distance = glm::length(way);
    const Vec3 direction = way / distance;
    const double cosine = glm::dot(direction, point.normal);
    if (!(cosine > 0)) // also where the point is the light
        return std::nullopt;
    const double light = relative_intensity(emitter, -direction) * cosine / (distance * distance);
    if (!(light > 0))
        return std::nullopt;
    Ray ray = point.ray(direction);
    ray.t_max = std::max(distance - near_light, 0.0);
    return Arriving{ray, light * emitter.intensity};
}

void PointEmitters::add_rays(const SurfacePoint& point, std::size_t max_rays, double u,
                             const Vec3& share, std::uint32_t place,
                             ShadowRays<LightAtPlace>& rays) const {
    double sum = 0;
    std::size_t shining = 0;
    for (std::size_t k = 0; k < count() && count() > max_rays; ++k)
        if (const auto arriving = at(k, point)) {
            sum += balanced(arriving->irradiance);
            ++shining;
        }
    const double tooth = sum / static_cast<double>(max_rays); // from one of the comb to the next
    double before = 0, next = u * tooth;
    for (std::size_t k = 0; k < count(); ++k) {
        const auto arriving = at(k, point);
        if (!arriving)
            continue;
        if (shining <= max_rays) {
            rays.add(arriving->ray, none, {place, share * arriving->irradiance});
            continue;
        }
        const double light = balanced(arriving->irradiance);
        unsigned teeth = 0;
        for (before += light; next < before; next += tooth)
            ++teeth;
        if (teeth > 0)
            rays.add(arriving->ray, none,
                     {place, share * arriving->irradiance * (teeth * tooth / light)});
    }
}

PowerOfPoints power_of_points(const Mesh& mesh, const Tracer& tracer) {
    constexpr std::size_t max_rays = 1u << 18, max_each = 1u << 12, min_each = 1u << 6;
    const PointEmitters emitters(mesh);
    PowerOfPoints power;
    if (emitters.empty())
        return power;
    const std::size_t each = std::clamp(max_rays / emitters.count(), min_each, max_each);
    for (std::size_t k = 0; k < emitters.count(); ++k) {
        const PointEmitter& emitter = emitters[k];
        SobolBlocks<4> numbers(k);
        std::vector<Ray> rays;
        std::vector<double> light;
        double sum = 0;
        for (std::uint32_t n = 0; n < each; ++n) {
            const auto u = numbers.at(n);
            const Vec3 direction = random_direction(emitter, {u[0], u[1]});
            rays.push_back({.origin = emitter.position, .direction = direction});
            light.push_back(relative_intensity(emitter, direction));
            sum += light.back();
        }
        std::vector<std::uint32_t> receivers;
        find_receivers(rays, mesh, tracer, receivers);
        double out = 0, behind = 0;
        for (std::size_t n = 0; n < each; ++n) {
            out += receivers[n] == escaped ? light[n] : 0;
            behind += receivers[n] == absorbed ? light[n] : 0;
        }
        const Vec3 sent = power_per_intensity(emitter) * emitter.intensity;
        power.sent += sent;
        if (sum > 0) {
            power.escaped += sent * (out / sum);
            power.left_behind += sent * (behind / sum);
        }
    }
    return power;
}

} // namespace hemilux
