// Rays in closed meshes: does one get out?
//
//     hemilux_escapes [--rays N] [--threads N] [--seed N] [--scene FILE.obj ...]
//
// N rays (a million by default) through the fast tracer in each mesh: a sphere of triangles and a
// box of slivers, or with --scene the closed parts of that scene. Half of the rays leave patches
// cosine distributed; half are aimed exactly at vertices and at points of edges, which is where
// tracers leak. Ends with 1 if a ray has hit nothing.
#include "bvh/wide/wide_bvh.h"
#include "closed_meshes.h"
#include "io/scene_files/obj.h"
#include "parallel/workers.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

using namespace hemilux;
using namespace hemilux::bench;

namespace {

constexpr std::size_t rays_a_chunk = 1 << 15;

struct Settings {
    std::vector<std::string> files;
    double rays = 1e6;
    unsigned threads = 0;
    std::uint64_t seed = 1;
};

class Inside {
  public:
    Inside(Scene scene, unsigned threads)
        : mesh_(std::move(scene)), bvh_(mesh_.soup(), {.threads = threads}) {
        double area = 0;
        for (const Patch& patch : mesh_.patches())
            area_before_.push_back(area += patch.area);
    }

    /// A chunk's rays, always the same for the same stream. Returns how many hit nothing.
    [[nodiscard]] std::size_t chunk(std::uint64_t stream) const {
        Rng rng(stream);
        return shoot(rays_a_chunk / 2, [&] { return cosine_ray(rng); }) +
               shoot(rays_a_chunk / 2, [&] { return aimed_ray(rng); });
    }

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }

  private:
    [[nodiscard]] std::uint32_t any_patch(Rng& rng) const {
        const double at = rng.uniform() * area_before_.back();
        const auto found = std::ranges::upper_bound(area_before_, at) - area_before_.begin();
        return std::min(static_cast<std::uint32_t>(found),
                        static_cast<std::uint32_t>(area_before_.size() - 1));
    }

    [[nodiscard]] Ray cosine_ray(Rng& rng) const {
        return PatchStart(mesh_, any_patch(rng)).cosine_ray(rng);
    }

    /// At a vertex, or a point between two. Not along the patch's own plane: the point that the ray
    /// leaves from may lie outside by a rounding error, or by what a quad may be bent.
    [[nodiscard]] Ray aimed_ray(Rng& rng) const {
        constexpr double min_sine = 1e-5;
        for (;;) {
            Ray ray = cosine_ray(rng);
            const Vec3 normal = mesh_.patches()[mesh_.patch_of(ray.from, true)].normal;
            const Patch& to = mesh_.patches()[any_patch(rng)];
            const auto corners = static_cast<std::size_t>(to.shape.size());
            const auto c = static_cast<std::size_t>(rng.uniform() * double(corners));
            const double share = std::max(2 * rng.uniform() - 1, 0.0); // half of them: a vertex
            const Vec3 &a = to.shape.corner[c], &b = to.shape.corner[(c + 1) % corners];
            ray.direction = a + share * (b - a) - ray.origin;
            if (glm::dot(normal, ray.direction) > min_sine * glm::length(ray.direction))
                return ray;
        }
    }

    template <class Make>
    [[nodiscard]] std::size_t shoot(std::size_t count, const Make& make) const {
        std::vector<Ray> rays;
        for (std::size_t k = 0; k < count; ++k)
            rays.push_back(make());
        std::vector<FacetHit> hits(count);
        bvh_.closest_stream(rays, hits);
        return missed(hits);
    }

    [[nodiscard]] static std::size_t missed(std::span<const FacetHit> hits) {
        return static_cast<std::size_t>(
            std::ranges::count_if(hits, [](const FacetHit& s) { return s.facet == none; }));
    }

    Mesh mesh_;
    WideBvh bvh_;
    std::vector<double> area_before_; ///< running sums
};

/// How many rays escaped.
std::size_t test_mesh(const std::string& name, Scene scene, const Settings& settings) {
    if (scene.facets.empty()) {
        std::printf("%-24s no part of it is closed\n", name.c_str());
        return 0;
    }
    const Inside inside(std::move(scene), settings.threads);
    const auto chunks = static_cast<std::size_t>(std::ceil(settings.rays / rays_a_chunk));
    std::atomic<std::size_t> escaped{0};
    const auto start = std::chrono::steady_clock::now();
    Workers(settings.threads).for_chunks(chunks, 1, [&](std::size_t k, std::size_t) {
        escaped += inside.chunk(hash_words({settings.seed, k}));
    });
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const double rays = double(chunks) * rays_a_chunk;
    std::printf("%-24s %9zu facets %14.0f rays %8.2f Mrays/s %6zu escaped\n", name.c_str(),
                inside.mesh().soup().facets.size(), rays, 1e-6 * rays / elapsed.count(),
                escaped.load());
    std::fflush(stdout);
    return escaped;
}

Settings read_settings(int argc, char** argv) {
    Settings settings;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (i + 1 == argc)
            throw std::runtime_error(word + ": expected an option and its value");
        const std::string value = argv[++i];
        if (word == "--rays")
            settings.rays = std::stod(value);
        else if (word == "--threads")
            settings.threads = static_cast<unsigned>(std::stoul(value));
        else if (word == "--seed")
            settings.seed = std::stoull(value);
        else if (word == "--scene")
            settings.files.push_back(value);
        else
            throw std::runtime_error("unknown option " + word);
    }
    return settings;
}

} // namespace

int main(int argc, char** argv) try {
    const Settings settings = read_settings(argc, argv);
    std::size_t lost = 0;
    for (const std::string& file : settings.files)
        lost += test_mesh(file.substr(file.rfind('/') + 1), closed_parts(read_obj(file).scene),
                          settings);
    if (settings.files.empty()) {
        lost += test_mesh("sphere", closed_sphere(7), settings);
        lost += test_mesh("box of slivers", box_of_slivers(50'000), settings);
    }
    return lost == 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "hemilux_escapes: %s\n", error.what());
    return 2;
}
