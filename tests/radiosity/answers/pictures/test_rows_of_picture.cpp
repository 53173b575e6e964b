// Pictures and lightmaps that end before all of their rows are gathered.
#include "parallel/asked_to_end.h"
#include "parallel/workers.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/answers/lightmaps/lightmap_target.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <atomic>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// Sees much of the room, with edges of shadows in all rows.
const Camera in_room{.eye = {2.8, 1.8, 2.8}, .target = {.5, .4, .5}, .vertical_fov_degrees = 80};

constexpr int width = 56, height = 200;

struct Lit {
    Model model{room_with_block()};
    Solution solution = solve(model, *find_method("stored-transport"), {}, steps(2));

    [[nodiscard]] RowsOfPicture rows(RenderOptions options) const {
        options.width = width;
        options.height = height;
        options.gather = 8;
        return render_rows(model.mesh, model.bvh, solution.radiosity, in_room, options);
    }
};

bool same_rows(const Image& a, const Image& b, int rows) {
    return std::equal(a.pixels.begin(),
                      a.pixels.begin() + static_cast<std::ptrdiff_t>(a.index(0, rows)),
                      b.pixels.begin());
}

} // namespace

TEST_CASE("a picture that is given up has the rows from the top as the whole one has them") {
    const Lit lit;
    std::atomic<long> all{0};
    const RowsOfPicture whole = lit.rows({.threads = 1, .give_up = [&] { return ++all < 0; }});
    REQUIRE(whole.rows == height);
    REQUIRE(all > 100);
    int before = 0, some = 0;
    for (const unsigned threads : {1u, 3u})
        for (long part = 0; part <= 10; ++part) {
            std::atomic<long> left{part * all / 10};
            const RowsOfPicture found =
                lit.rows({.threads = threads, .give_up = [&] { return --left < 0; }});
            CAPTURE(threads, part, found.rows);
            if (threads == 1) {
                CHECK(found.rows >= before);
                before = found.rows;
            }
            CHECK(found.rows <= height);
            some += found.rows > 0 && found.rows < height;
            CHECK((found.rows == 0 || same_rows(found.image, whole.image, found.rows)));
        }
    CHECK(some >= 4);
}

TEST_CASE("rows are told as they are finished, and end with all of them") {
    const Lit lit;
    std::vector<int> told;
    const RowsOfPicture whole =
        lit.rows({.threads = 2, .rows_done = [&](const Image& image, int n) {
                      CHECK(image.height == height);
                      told.push_back(n);
                  }});
    CHECK(std::ranges::is_sorted(told));
    CHECK(told.size() > 2);
    CHECK(told.back() == height);
    CHECK(whole.rows == height);
}

TEST_CASE("a picture of squares has in each what its middle shows") {
    const Lit lit;
    const auto picture = [&](int square) {
        return render(
            lit.model.mesh, lit.model.bvh, lit.solution.radiosity, in_room,
            {.width = width, .height = height, .samples = 1, .threads = 1, .square = square});
    };
    const Image all = picture(1), squares = picture(5);
    int same = 0, count = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            CHECK(squares.at(x, y) == squares.at(x / 5 * 5, y / 5 * 5));
            if (x % 5 != 2 || y % 5 != 2)
                continue;
            ++count;
            same +=
                glm::distance(squares.at(x, y), all.at(x, y)) <= 1e-4f * glm::length(all.at(x, y));
        }
    CHECK(count == (width / 5) * (height / 5));
    CHECK(same > .99 * count);
    CHECK(square_for_speed(6000, 6000) == 6);
    CHECK(square_for_speed(800, 600) == 1);
}

TEST_CASE(
    "a lightmap that is given up has its first rows as the whole one, then those of patches") {
    constexpr int size = 96;
    const Lit lit;
    const Mesh& mesh = lit.model.mesh;
    const TexelMap texels(mesh, placed_triangles(mesh, find_charts(mesh, size)), size);
    const SurfaceLight light(mesh, PatchLight(lit.solution));
    const std::vector<bool> covered(texels.count());
    std::atomic<long> all{0};
    const auto gather = [&](std::atomic<long>& polls, long end) {
        return gather_texels(mesh, lit.model.bvh, light, texels, covered,
                             {.rays = 4,
                              .check =
                                  [&polls, end] {
                                      if (++polls > end)
                                          throw Interrupted();
                                  }},
                             Workers(1));
    };
    const GatheredLightmap whole = gather(all, 1'000'000);
    REQUIRE(whole.rows == size);
    GatheredLightmap of_patches(texels);
    complete_by_patches(of_patches, mesh, light, texels, Bake::radiosity, Workers(2));
    int some = 0;
    for (long part = 0; part <= 8; ++part) {
        std::atomic<long> polls{0};
        GatheredLightmap found = gather(polls, part * all / 8);
        some += found.rows > 0 && found.rows < size;
        const std::size_t end = texels.index(0, found.rows);
        for (std::size_t k = end; k < texels.count(); ++k)
            REQUIRE_FALSE(found.known[k]);
        complete_by_patches(found, mesh, light, texels, Bake::radiosity, Workers(1));
        for (std::size_t k = 0; k < texels.count(); ++k) {
            const GatheredLightmap& same = k < end ? whole : of_patches;
            REQUIRE(found.known[k] == texels.shows(k));
            if (texels.shows(k))
                REQUIRE(found.image.pixels[k] == same.image.pixels[k]);
        }
    }
    CHECK(some >= 3);
}
