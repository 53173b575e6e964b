#include "radiosity/research/targets/target_balls.h"

#include "geometry/box.h"
#include "geometry/elementary.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t max_balls = 8;

/// The share of the target that goes into balls. For all of a picture they would have to be large,
/// as a few patches of the table count too (target_balls.h).
constexpr double share_in_balls = .75;

/// A ball is halved if this makes the sum over balls of sqrt(mass) times radius smaller by more
/// than this share. The best numbers of rays are proportional to that.
constexpr double min_gain = .1;

constexpr std::uint64_t looks = 8;

/// The patches of one ball.
struct Cluster {
    std::vector<std::uint32_t> patches;
    TargetBall ball;
    double cost; ///< root of the mass, times the radius
};

class Clusters {
  public:
    Clusters(const Mesh& mesh, std::span<const double> value) : mesh_(mesh), value_(value) {}

    [[nodiscard]] double mass(std::uint32_t i) const { return mesh_.patches()[i].area * value_[i]; }

    /// Returns the heaviest patches, which have their share of the mass.
    [[nodiscard]] std::vector<std::uint32_t> heaviest() const {
        std::vector<std::uint32_t> patches;
        double all = 0, kept = 0;
        for (std::uint32_t i = 0; i < value_.size(); ++i)
            if (mass(i) > 0) {
                patches.push_back(i);
                all += mass(i);
            }
        std::ranges::stable_sort(patches, std::greater{}, [&](auto i) { return mass(i); });
        std::size_t count = 0;
        while (count < patches.size() && kept < share_in_balls * all)
            kept += mass(patches[count++]);
        patches.resize(count);
        return patches;
    }

    [[nodiscard]] Cluster around(std::vector<std::uint32_t> patches) const {
        Box box;
        double sum = 0, squares = 0;
        for (const std::uint32_t i : patches)
            box.include(box_of(mesh_.patches()[i].shape.corner));
        const Vec3 centre = box.centre();
        for (const std::uint32_t i : patches) {
            sum += mass(i);
            for (const Vec3& corner : mesh_.patches()[i].shape.corner)
                squares = std::max(squares, glm::dot(corner - centre, corner - centre));
        }
        const double radius = std::sqrt(squares);
        return {std::move(patches), {centre, radius}, std::sqrt(sum) * radius};
    }

    /// Halves a cluster at the widest gap between the centres along the longest axis.
    [[nodiscard]] std::pair<Cluster, Cluster> halves(Cluster cluster) const {
        std::vector<std::uint32_t>& patches = cluster.patches;
        Box centres;
        for (const std::uint32_t i : patches)
            centres.include(mesh_.patches()[i].centre);
        const int axis = largest_axis(centres.extent());
        const auto place = [&](std::uint32_t i) { return mesh_.patches()[i].centre[axis]; };
        std::ranges::stable_sort(patches, {}, place);
        std::size_t middle = patches.size() / 2;
        double widest = 0;
        for (std::size_t k = 1; k < patches.size(); ++k)
            if (const double gap = place(patches[k]) - place(patches[k - 1]); gap > widest) {
                widest = gap;
                middle = k;
            }
        const auto cut = patches.begin() + static_cast<std::ptrdiff_t>(middle);
        return {around({patches.begin(), cut}), around({cut, patches.end()})};
    }

  private:
    const Mesh& mesh_;
    std::span<const double> value_;
};

} // namespace

bool TargetBall::is_near(const Vec3& to_centre) const {
    constexpr double min_radii = 1.1;
    return !(glm::length(to_centre) > min_radii * radius);
}

bool TargetBall::takes(const Vec3& origin, const Vec3& direction) const {
    const Vec3 to_centre = centre - origin;
    const double along = glm::dot(to_centre, direction);
    return along > 0 && along * along > glm::dot(to_centre, to_centre) - radius * radius &&
           !is_near(to_centre);
}

std::optional<TargetBall::Aimed> TargetBall::aim(const Vec3& origin, const Vec3& normal,
                                                 Vec2 u) const {
    const Vec3 to_centre = centre - origin;
    if (is_near(to_centre))
        return std::nullopt;
    const double distance = glm::length(to_centre), sine = radius / distance;
    const double cap = sine * sine / (1 + std::sqrt(1 - sine * sine)); // 1 - cosine
    const double z = 1 - u.x * cap, r = std::sqrt(std::max(0.0, 1 - z * z));
    const Vec2 turn = elementary::on_circle(2 * std::numbers::pi * u.y);
    const Vec3 direction =
        Frame::from_normal(to_centre / distance).to_world({r * turn.x, r * turn.y, z});
    const double power = 2 * cap * glm::dot(normal, direction); // the solid angle is 2 pi cap
    if (!(power > 0))
        return std::nullopt;
    return Aimed{direction, power};
}

std::vector<TargetBall> find_balls(const Mesh& mesh, std::span<const double> value) {
    const Clusters clusters(mesh, value);
    std::vector<std::uint32_t> patches = clusters.heaviest();
    if (patches.empty())
        return {};
    std::vector<Cluster> found{clusters.around(std::move(patches))};
    while (found.size() < max_balls) {
        double cost = 0, gain = 0;
        std::size_t best = 0;
        std::pair<Cluster, Cluster> halves;
        for (std::size_t k = 0; k < found.size(); ++k) {
            cost += found[k].cost;
            if (found[k].patches.size() < 2)
                continue;
            std::pair<Cluster, Cluster> two = clusters.halves(found[k]);
            if (found[k].cost - two.first.cost - two.second.cost > gain) {
                gain = found[k].cost - two.first.cost - two.second.cost;
                best = k;
                halves = std::move(two);
            }
        }
        if (!(gain > min_gain * cost))
            break;
        found[best] = std::move(halves.first);
        found.push_back(std::move(halves.second));
    }
    std::vector<TargetBall> balls;
    for (const Cluster& cluster : found)
        balls.push_back(cluster.ball);
    return balls;
}

TargetBalls::TargetBalls(const Mesh& mesh, std::span<const double> value)
    : balls_(find_balls(mesh, value)), times_(value.size() * balls_.size()) {}

unsigned TargetBalls::takers(std::uint32_t patch, const Vec3& origin, const Vec3& direction) const {
    unsigned result = 0;
    for (std::size_t k = 0; k < count(); ++k)
        result += times(patch, k) > 0 && balls_[k].takes(origin, direction);
    return result;
}

std::optional<TargetBalls::Shot> TargetBalls::draw(const PatchStart& start, std::size_t ball,
                                                   std::uint64_t key) const {
    Rng rng(key);
    const auto square = [&rng] {
        const double u = rng.uniform(), v = rng.uniform();
        return Vec2(u, v);
    };
    const Vec3 origin = start.points.sample(square());
    const auto aimed = balls_[ball].aim(origin, start.frame.z, square());
    if (!aimed)
        return std::nullopt;
    return Shot{{.origin = origin, .direction = aimed->direction, .from = start.facet},
                aimed->power};
}

/// Looks from all patches. For each ball, one ray more is assumed to have found what all rays find
/// on average.
TargetBalls::Visibility TargetBalls::look(const SolverInput& input, std::span<const double> value,
                                          const Workers& workers) const {
    constexpr std::uint64_t stream = 0xba11; // of no step
    const Mesh& mesh = input.mesh;
    std::vector<double> squares(times_.size()), values(times_.size());
    std::vector<std::uint64_t> rays_from(mesh.patches().size());
    Visibility visibility{values, values, 0};
    workers.for_chunks(mesh.patches().size(), 64, [&](std::size_t begin, std::size_t end) {
        std::vector<Ray> rays;
        std::vector<double> power;
        std::vector<std::size_t> place;
        std::vector<std::uint32_t> receivers;
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            if (!input.needs.power(i) || !(mesh.patches()[i].area > 0))
                continue;
            const PatchStart start(mesh, i);
            for (std::size_t k = 0; k < count(); ++k)
                for (std::uint64_t look = 0; look < looks; ++look)
                    if (const auto shot =
                            draw(start, k, hash_words({input.options.seed, stream, i, k, look}))) {
                        rays.push_back(shot->ray);
                        power.push_back(shot->power);
                        place.push_back(i * count() + k);
                        ++rays_from[i];
                    }
        }
        find_receivers(rays, mesh, input.tracer, receivers);
        for (std::size_t r = 0; r < rays.size(); ++r) {
            const double square = power[r] * power[r] / double(looks);
            visibility.power[place[r]] += power[r] / double(looks);
            squares[place[r]] += square;
            if (receivers[r] < value.size())
                values[place[r]] += square * value[receivers[r]];
        }
    });
    double all_squares = 0, all_values = 0;
    for (std::size_t k = 0; k < squares.size(); ++k) {
        all_squares += squares[k];
        all_values += values[k];
    }
    const double mean = all_squares > 0 ? all_values / all_squares : 0;
    for (std::size_t k = 0; k < squares.size(); ++k)
        visibility.root_of_value[k] =
            std::sqrt((double(looks) * values[k] + mean * squares[k]) / double(looks + 1));
    for (const std::uint64_t rays : rays_from)
        visibility.rays += rays;
    return visibility;
}

} // namespace hemilux
