#include "radiosity/answers/views/automatic_camera.h"

#include "geometry/box.h"
#include "parallel/workers.h"
#include "radiosity/answers/views/lit_patches.h"
#include "radiosity/answers/views/view_candidates.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace hemilux {
namespace {

/// Returns the box around the near patches, or around those that are lit.
Box box_of_near(const Mesh& mesh) {
    Box box;
    for (const Patch& patch : mesh.patches())
        if (!mesh.material(patch).is_far)
            box.include(box_of(patch.shape.corner));
    return box;
}
Box box_of_lit(const Mesh& mesh, std::span<const float> weight) {
    constexpr float hardly = 0.15f;
    Box box;
    for (std::size_t i = 0; i < weight.size(); ++i)
        if (weight[i] > hardly)
            box.include(box_of(mesh.patches()[i].shape.corner));
    return box;
}

/// Returns one number for surfaces that look alike: of one group and material, turned to one side.
std::uint64_t kind_of(const Mesh& mesh, const Patch& patch) {
    const int axis = largest_axis(patch.normal), side = 2 * axis + (patch.normal[axis] > 0);
    const std::uint64_t group = mesh.scene().facets[patch.facet].group;
    return (group << 32) + std::uint64_t{patch.material} * 6 + static_cast<std::uint64_t>(side);
}

/// The rays of a small picture.
struct Grid {
    int columns, rows;
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
};

/// The quality of a view, estimated by a few rays.
struct Rating {
    double score = 0;
    double met = 0;      ///< share of rays that meet the scene
    double enclosed = 0; ///< share of rays that meet a front of it
    double lit = 0;      ///< share of rays that meet what is lit, by how lit it is
};

/// What a view shows that is lit.
struct SeenLight {
    std::uint64_t kind;
    double weight, depth;
};

/// Returns how many kinds there are, as equal ones: the inverse of the chance that two parts of the
/// picture show the same.
double kinds_of(std::vector<SeenLight>& seen, double weight) {
    std::ranges::sort(seen, {}, &SeenLight::kind);
    double squares = 0;
    for (auto k = seen.begin(); k != seen.end();) {
        double of_kind = 0;
        for (const std::uint64_t kind = k->kind; k != seen.end() && k->kind == kind; ++k)
            of_kind += k->weight;
        squares += of_kind * of_kind;
    }
    return weight * weight / squares;
}

/// Returns the preference for views from outside: an open box is meant to be looked into, and not
/// from high above.
double favour(const ViewCandidate& view) {
    constexpr double steep = 0.7;
    if (view.kind != ViewKind::object)
        return 1;
    const Camera& camera = view.camera;
    return glm::dot(glm::normalize(camera.eye - camera.target), camera.up) > steep ? 1.2 : 1.5;
}

class Judge {
  public:
    Judge(const Mesh& mesh, const Tracer& tracer, std::span<const float> lit, const Box& box,
          double aspect)
        : mesh_(mesh), tracer_(tracer), lit_(lit), far_(0.6 * glm::length(box.extent())),
          aspect_(aspect) {}

    /// Rates a view, in the local frame, by how much of the picture shows lit fronts, how many
    /// kinds of them, and how far the near ones are.
    [[nodiscard]] Rating rate(const ViewCandidate& view, const Grid& grid) const {
        std::vector<SeenLight> seen;
        Rating rating = look_at(view.camera, grid, seen);
        if (!(rating.lit > 0))
            return rating;
        const double kinds = kinds_of(seen, rating.lit * static_cast<double>(grid.size()));
        std::ranges::sort(seen, {}, &SeenLight::depth);
        const double depth = std::min(seen[seen.size() / 4].depth, far_);
        rating.score = favour(view) * rating.lit * std::sqrt(kinds) * std::sqrt(depth);
        return rating;
    }

  private:
    Rating look_at(const Camera& camera, const Grid& grid, std::vector<SeenLight>& seen) const {
        const std::vector<Ray> rays = rays_of(camera, grid);
        std::vector<FacetHit> hits(rays.size());
        tracer_.closest_stream(rays, hits);
        const double share = 1.0 / static_cast<double>(rays.size());
        Rating rating;
        for (std::size_t k = 0; k < rays.size(); ++k) {
            if (hits[k].facet == none)
                continue;
            const Hit hit = tracer_.locate(rays[k], hits[k].facet);
            const std::uint32_t patch = mesh_.patch_at(hit);
            const Scene& scene = mesh_.scene();
            const bool is_near = !scene.materials[scene.facets[hit.facet].material].is_far;
            rating.met += is_near ? share : 0;
            if (patch == none)
                continue;
            rating.enclosed += is_near ? share : 0;
            if (lit_[patch] > 0) {
                seen.push_back({kind_of(mesh_, mesh_.patches()[patch]), lit_[patch], hit.t});
                rating.lit += share * lit_[patch];
            }
        }
        return rating;
    }

    [[nodiscard]] std::vector<Ray> rays_of(Camera camera, const Grid& grid) const {
        camera.eye = mesh_.frame().to_world(camera.eye);
        camera.target = mesh_.frame().to_world(camera.target);
        const CameraRays view(camera, mesh_, aspect_);
        std::vector<Ray> rays;
        rays.reserve(grid.size());
        for (int y = 0; y < grid.rows; ++y)
            for (int x = 0; x < grid.columns; ++x)
                rays.push_back(view.ray((x + 0.5) / grid.columns, (y + 0.5) / grid.rows));
        return rays;
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::span<const float> lit_;
    double far_; ///< depth beyond which things are not seen better for it
    double aspect_;
};

/// Returns whether a sun or a sky lights a scene so that most of what views from outside show of it
/// is lit.
bool is_lit_from_outside(const Mesh& mesh, std::span<const ViewCandidate> views,
                         std::span<const Rating> ratings) {
    constexpr double most = 0.5;
    const auto& materials = mesh.scene().materials;
    if (std::ranges::none_of(materials, &Material::is_far))
        return false;
    double lit = 0, met = 0;
    for (std::size_t i = 0; i < views.size(); ++i)
        if (views[i].kind == ViewKind::object) {
            lit += ratings[i].lit;
            met += ratings[i].met;
        }
    return lit > most * met;
}

/// Returns whether hardly any view from within the scene's box shows walls all around that are lit
/// beside what is seen from outside.
bool has_no_rooms(std::span<const ViewCandidate> views, std::span<const Rating> ratings) {
    constexpr double all_around = 0.8, as_lit = 0.1, min_of_rooms = 0.1;
    double lit_outside = 0;
    for (std::size_t i = 0; i < views.size(); ++i)
        if (views[i].kind == ViewKind::object)
            lit_outside = std::max(lit_outside, ratings[i].lit);
    double enclosed = 0, within = 0;
    for (std::size_t i = 0; i < views.size(); ++i)
        if (views[i].kind == ViewKind::within) {
            enclosed += ratings[i].enclosed > all_around && ratings[i].lit >= as_lit * lit_outside;
            within += 1;
        }
    return enclosed < min_of_rooms * within;
}

/// Rates the views `which` with this many rays each.
void rate(const Judge& judge, std::span<const ViewCandidate> views,
          std::span<const std::size_t> which, const Grid& grid, std::vector<Rating>& ratings,
          unsigned threads) {
    Workers(threads).for_chunks(which.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            ratings[which[k]] = judge.rate(views[which[k]], grid);
    });
}

/// Returns the first of the views that are about the best, so that rounding chooses none.
std::size_t best_of(std::span<const std::size_t> which, std::span<const Rating> ratings) {
    constexpr double about = 0.999;
    double best = 0;
    for (const std::size_t i : which)
        best = std::max(best, ratings[i].score);
    return *std::ranges::find_if(which,
                                 [&](std::size_t i) { return ratings[i].score >= about * best; });
}

} // namespace

AutomaticView automatic_view(const Mesh& mesh, const Tracer& tracer,
                             std::span<const Vec3> radiosity, const ViewWish& wish) {
    constexpr Grid coarse{8, 6}, fine{24, 18};
    constexpr std::size_t finalists = 48;
    const LitPatches lit = lit_patches(mesh, radiosity);
    const int up = wish.up ? *wish.up : guess_up(mesh, wish.usual_up);
    const Box box = box_of_near(mesh);
    const std::vector<ViewCandidate> views = view_candidates(
        mesh, tracer, {box, box_of_lit(mesh, lit.weight), up, wish.aspect, lit.brightest});
    const Judge judge(mesh, tracer, lit.weight, box, wish.aspect);
    std::vector<Rating> ratings(views.size());
    std::vector<std::size_t> which(views.size());
    std::iota(which.begin(), which.end(), std::size_t{0});
    rate(judge, views, which, coarse, ratings, wish.threads);
    const bool object = has_no_rooms(views, ratings) || is_lit_from_outside(mesh, views, ratings);
    if (object)
        std::erase_if(which, [&](std::size_t i) { return views[i].kind != ViewKind::object; });
    std::ranges::stable_sort(which, std::greater(),
                             [&](std::size_t i) { return ratings[i].score; });
    which.resize(std::min(which.size(), finalists));
    std::ranges::sort(which);
    rate(judge, views, which, fine, ratings, wish.threads);
    if (object)
        for (const std::size_t i : which)
            ratings[i].score *= views[i].taste / std::sqrt(std::max(ratings[i].lit, 1e-9));
    const std::size_t best = best_of(which, ratings);
    AutomaticView view{views[best].camera, ratings[best].lit};
    view.camera.eye = mesh.frame().to_world(view.camera.eye);
    view.camera.target = mesh.frame().to_world(view.camera.target);
    return view;
}

Camera automatic_camera(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                        double aspect, std::optional<int> up, unsigned threads) {
    return automatic_view(mesh, tracer, radiosity, {aspect, up, {}, threads}).camera;
}

} // namespace hemilux
