#include "io/results/checkpoint.h"

#include "bvh/brute_force.h"
#include "fuzz/saved_runs.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

using namespace hemilux;

namespace {

Checkpoint example() {
    Checkpoint checkpoint;
    checkpoint.options = {{"--rays", "64"}, {"--seed", "1"}};
    checkpoint.scene = 0x123456789abcdef0;
    checkpoint.seconds = 1.5;
    StepRow row{"hemisphere", 0, {1, 1000, .25, std::numeric_limits<double>::quiet_NaN()}, {}};
    checkpoint.rows = {row, row};
    checkpoint.rows[1].error = RelativeError{.1, .2, .3};
    checkpoint.state = std::string("\0state\xff", 7);
    return checkpoint;
}

} // namespace

TEST_CASE("a checkpoint reads back as it was written", "[checkpoint]") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("saved");
    const Checkpoint written = example();
    write_checkpoint(path, written);
    CHECK(folder.files() == 1);
    const Checkpoint read = read_checkpoint(path);
    CHECK(read.options == written.options);
    CHECK(read.scene == written.scene);
    CHECK(read.seconds == written.seconds);
    CHECK(read.state == written.state);
    REQUIRE(read.rows.size() == 2);
    CHECK(read.rows[0].method == "hemisphere");
    CHECK(read.rows[0].record.rays == 1000);
    CHECK(std::isnan(read.rows[0].record.estimated_error));
    CHECK_FALSE(read.rows[0].error);
    CHECK(read.rows[1].error->detail == .2);
    CHECK(to_bytes(read) == to_bytes(written));
}

TEST_CASE("every flipped bit and every truncation is found", "[checkpoint]") {
    const std::string good = to_bytes(example());
    CHECK_NOTHROW((void)checkpoint_from(good, "saved"));
    for (std::size_t i = 0; i < 8 * good.size(); ++i) {
        std::string bad = good;
        bad[i / 8] = static_cast<char>(bad[i / 8] ^ (1 << i % 8));
        CHECK_THROWS_AS(checkpoint_from(bad, "saved"), InputError);
    }
    for (std::size_t size = 0; size < good.size(); ++size)
        CHECK_THROWS_AS(checkpoint_from(good.substr(0, size), "saved"), InputError);
}

TEST_CASE("a state is read in the order of writing, and no further", "[checkpoint]") {
    StateWriter out;
    out.add(std::uint64_t{7});
    out.add(-0.0);
    out.add(Vec3(1, 2, 3));
    out.add(std::string_view("text"));
    out.add(std::span<const double>(std::array{4.0, 5.0}));
    StateReader in(out.bytes());
    CHECK(in.whole() == 7);
    CHECK(std::signbit(in.number()));
    Vec3 vector;
    in.get(vector, bounds::finite);
    CHECK(vector == Vec3(1, 2, 3));
    CHECK(in.text() == "text");
    std::array<double, 2> numbers{};
    in.get(std::span<double>(numbers));
    CHECK(numbers[1] == 5);
    CHECK_NOTHROW(in.expect_end());
    CHECK_THROWS_AS(in.whole(), StateError);

    StateWriter large;
    large.add(~std::uint64_t{0});
    CHECK_THROWS_AS(StateReader(large.bytes()).text(), StateError);
    CHECK_THROWS_AS(StateReader(large.bytes()).count(16), StateError);
    CHECK_THROWS_AS(StateReader(large.bytes()).get(std::span<double>(numbers)), StateError);
    CHECK_THROWS_AS(StateReader(large.bytes()).expect_end(), StateError);
}

TEST_CASE("scenes that differ in anything have different hashes", "[checkpoint]") {
    const auto hash = [](const Scene& scene, const MeshOptions& options = {}) {
        return scene_hash(Mesh(scene, options));
    };
    const Scene room = test::room_with_block();
    CHECK(hash(room) == hash(room));
    CHECK(hash(room) != hash(room, {.max_edge = .5}));
    CHECK(hash(room) != hash(room, {.two_sided = true}));
    Scene other = room;
    other.materials[0].reflectance.g += 1e-12;
    CHECK(hash(room) != hash(other));
    other = room;
    other.vertices[0].x += 1e-9;
    CHECK(hash(room) != hash(other));
    other = room;
    other.facets[1].material = (other.facets[1].material + 1) % 2;
    CHECK(hash(room) != hash(other));
}

TEST_CASE("fuzzing of checkpoints begins with some that a method goes on from", "[checkpoint]") {
    const Mesh mesh(fuzz::facing_triangles());
    const BruteForce tracer(mesh.soup());
    Monitor monitor;
    const auto loads = [&](const auto& run, const std::string& state) {
        const auto& [method, options] = run;
        try {
            StateReader reader(state);
            method->make({mesh, tracer, options, monitor, everything_needed})->load(reader);
            reader.expect_end();
            return true;
        } catch (const StateError&) {
            return false;
        }
    };
    const std::string corpus = std::string(HEMILUX_SOURCE_DIR) + "/tests/fuzz/corpus/";
    std::size_t files = 0;
    for (const auto& file : std::filesystem::directory_iterator(corpus + "checkpoint_sealed")) {
        CAPTURE(file.path(), "tests/fuzz/make_checkpoints.sh makes it anew");
        const Checkpoint saved = read_checkpoint(file.path().string());
        CHECK(std::ranges::any_of(fuzz::saved_runs(),
                                  [&](const auto& run) { return loads(run, saved.state); }));
        ++files;
    }
    CHECK(files >= 6);
    const std::string content = read_input(corpus + "checkpoint/content", InputKind::regular);
    CHECK(sealed_checkpoint(content) == to_bytes(read_checkpoint(corpus + "checkpoint/whole")));
}
