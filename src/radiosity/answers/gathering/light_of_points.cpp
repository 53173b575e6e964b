#include "radiosity/answers/gathering/light_of_points.h"

#include "geometry/elementary.h"
#include "parallel/asked_to_end.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace hemilux {
namespace {

/// The share of the error that the noise of the rays of points may leave.
constexpr double share_of_noise = .6;

/// The most points from which the light that all of them read is learned.
constexpr std::size_t max_learned_points = 65'536;

class PointsTarget final : public GatherTarget {
  public:
    PointsTarget(Gatherer& gatherer, std::span<const WantedPoint> points, double error_of_patches)
        : gatherer_(gatherer), points_(points), error_of_patches_(error_of_patches) {}

    [[nodiscard]] std::string name() const override { return "points"; }
    [[nodiscard]] Parts parts(const Workers& workers) override;
    std::uint64_t gather(const Round& round, const Workers& workers) override;
    [[nodiscard]] bool takes_rounds() const override { return false; }
    /// Rays at points know their noise without being judged.
    [[nodiscard]] std::optional<PictureError> judge(std::size_t places, const Workers& workers,
                                                    const PictureJudge::GoOn& go_on) override;

    GatheredPoints light;

  private:
    void limit(PointLightOptions& options) const;
    void take_light_of_patches();
    [[nodiscard]] std::string end_text() const;

    Gatherer& gatherer_;
    std::span<const WantedPoint> points_;
    double error_of_patches_;
    std::size_t gathered_ = 0;
    std::atomic<double> share_{0};
};

/// Finds the faces that points lie on.
GatherTarget::Parts PointsTarget::parts(const Workers& workers) {
    constexpr std::size_t points_per_chunk = 1024;
    const auto& [mesh, tracer, radiosity, threads] = gatherer_.scene();
    std::vector<Sensor>& sensors = light.sensors;
    sensors.resize(points_.size());
    workers.for_chunks(points_.size(), points_per_chunk,
                       [&, &mesh = mesh, &tracer = tracer](std::size_t begin, std::size_t end) {
                           for (std::size_t k = begin; k < end; ++k)
                               sensors[k] = sensor_at(mesh, tracer,
                                                      mesh.frame().to_local(points_[k].position),
                                                      points_[k].normal);
                       });
    Parts found{{}, gatherer_.seed_of(3), gatherer_.asked().seconds};
    const std::size_t each = (sensors.size() + max_learned_points - 1) / max_learned_points;
    for (std::size_t k = 0; k < sensors.size(); k += std::max<std::size_t>(each, 1))
        found.parts.push_back({{sensors[k].at}, {Vec3(1.0)}});
    return found;
}

/// Without a limit of the user's, points take at most so many rays: as many as a run of some
/// minutes has, or some times those of the solution, or of what each point needs at the least.
void PointsTarget::limit(PointLightOptions& options) const {
    constexpr std::uint64_t least = 50'000'000, times_solution = 4, times_first = 64;
    const Asked& asked = gatherer_.asked();
    options.seconds = gatherer_.seconds_left();
    options.max_all_rays = gatherer_.rays_left().value_or(options.max_all_rays);
    if (!asked.seconds && !asked.max_rays && !asked.rays)
        options.max_all_rays =
            std::max({least, times_solution * gatherer_.solution().rays_energy,
                      times_first * first_rays_of_point * std::uint64_t(light.sensors.size())});
    if (asked.rays)
        options.rays = rays_of_point_per_gather_ray * *asked.rays;
}

std::uint64_t PointsTarget::gather(const Round& round, const Workers& workers) {
    const auto& [mesh, tracer, radiosity, threads] = gatherer_.scene();
    const double read_error = round.read.error;
    // The noise of few points is hardly known, and so its bound is larger.
    const double in_doubt = 1 + 1 / std::sqrt(double(std::max<std::size_t>(points_.size(), 1)));
    PointLightOptions options{
        .noise = share_of_noise * round.error / in_doubt,
        .read_error = std::isfinite(read_error) ? read_error : 0,
        .seed = gatherer_.seed_of(2),
        .give_up = [this] { return is_asked_to_end(gatherer_.wishes_to_end()); },
        .share = &share_};
    limit(options);
    {
        const auto stage = gatherer_.watcher().begin("gathering at points", &share_);
        light.found =
            light_at(light.sensors, mesh, tracer, gatherer_.cache().light(), options, workers);
    }
    // Where a signal came before what is read was judged, its error is that of the patches.
    if (!std::isfinite(read_error) && std::isfinite(error_of_patches_))
        for (PointLight& at : light.found.lights)
            for (int c = 0; c < 3; ++c)
                at.standard_error[c] =
                    elementary::hypot(at.standard_error[c], error_of_patches_ * at.irradiance[c]);
    gathered_ = light.found.lights.size();
    take_light_of_patches();
    if (light.found.end != PointsEnd::right)
        gatherer_.watcher().tell(Finding::Kind::warning, end_text());
    return light.found.rays;
}

std::optional<PictureError> PointsTarget::judge(std::size_t, const Workers&,
                                                const PictureJudge::GoOn&) {
    const LightAtPoints& found = light.found;
    PictureError error;
    error.error = gathered_ == points_.size() ? found.noise : AnswerError::unknown;
    error.uncertainty = found.noise_uncertainty;
    error.bound = error.error + error.uncertainty;
    error.local = found.noise_local;
    return error;
}

/// Gives the points at which nothing was gathered the light of the patch on which they lie. How far
/// such light is off is seen at the points that were gathered; without any, it may be all wrong.
void PointsTarget::take_light_of_patches() {
    std::vector<PointLight>& lights = light.found.lights;
    const auto of_patch = [&](const Sensor& sensor) {
        return gatherer_.cache().light().irradiance(sensor.patch, sensor.at.position).value;
    };
    Vec3 squares(0.0);
    double count = 0;
    for (std::size_t k = 0; k < gathered_; ++k) {
        const Sensor& sensor = light.sensors[k];
        if (sensor.patch == none)
            continue;
        const Vec3 off = of_patch(sensor) - lights[k].irradiance;
        squares += off * off + lights[k].standard_error * lights[k].standard_error;
        ++count;
    }
    for (std::size_t k = gathered_; k < light.sensors.size(); ++k) {
        const Sensor& sensor = light.sensors[k];
        PointLight& at = lights.emplace_back();
        at.is_known = sensor.patch != none;
        if (!at.is_known)
            continue;
        at.irradiance = of_patch(sensor);
        at.standard_error = count > 0 ? glm::sqrt(squares / count) : at.irradiance;
    }
}

/// Returns why rays ended before the light was as exact as asked for, and what the points have.
std::string PointsTarget::end_text() const {
    const LightAtPoints& found = light.found;
    const bool by_default = !gatherer_.asked().max_rays;
    const std::size_t points = found.lights.size();
    std::string text = "the light at points: ";
    switch (found.end) {
    case PointsEnd::right:
        break;
    case PointsEnd::gave_up:
        text += "interrupted";
        break;
    case PointsEnd::rays:
        text += (by_default ? "it ended" : "--max-rays ended it") + std::string(" after ") +
                short_counted(found.rays, "ray", "rays");
        text +=
            by_default ? ", which is the limit by default; --max-rays or --time sets another" : "";
        break;
    case PointsEnd::time:
        text += "it took as long as --time lets it";
        break;
    }
    if (gathered_ == points)
        text += "; its noise is " + percent(found.noise);
    else if (gathered_ > 0)
        text += "; points 0 to " + grouped(gathered_ - 1) + " of " + grouped(points) +
                " are gathered, the others have the light of the patches that they lie on";
    else
        text += "; all points have the light of the patches that they lie on";
    if (const auto empty = std::ranges::count(found.lights, false, &PointLight::is_known);
        empty > 0)
        text += "; the rows of " + counted(static_cast<std::uint64_t>(empty), "point", "points") +
                " away from them hold no light";
    return text;
}

} // namespace

Answer<GatheredPoints> gather_points(Gatherer& gatherer, std::span<const WantedPoint> points,
                                     double error_of_patches,
                                     const std::optional<WholeLight>& whole) {
    PointsTarget target(gatherer, points, error_of_patches);
    const auto [errors, level, work] = gatherer.gather(target, whole);
    target.light.level = level;
    return {std::move(target.light), errors.of_answer(), work};
}

} // namespace hemilux
