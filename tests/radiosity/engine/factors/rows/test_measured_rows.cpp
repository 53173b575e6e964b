// Rows of view factors as bytes: what is read goes on as if it had not been interrupted.
#include "radiosity/engine/factors/rows/find_exchange.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <string>

using namespace hemilux;

namespace {

Scene blocks() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, 20, 20, 0);
    for (int k = 0; k < 9; ++k) {
        const Vec3 low(.5 + 3 * (k % 3), .5 + 3 * (k / 3), 0); // NOLINT(bugprone-integer-division)
        test::add_block(scene, low, low + Vec3(1.3, 1.8, .7 + .6 * (k % 4)));
    }
    return scene;
}

std::string bytes_of(std::span<const MeasuredRow> rows) {
    StateWriter bytes;
    save_rows(rows, bytes);
    return std::move(bytes).bytes();
}

std::vector<MeasuredRow> some_rows() {
    std::vector<MeasuredRow> rows(4);
    rows[0].scale = 1;
    rows[0].work = {
        .rays = 1, .lines = 2, .exact_pairs = 3, .line_pairs = 4, .ray_pairs = 5, .clear_pairs = 6};
    rows[0].pairs = {{1, 0, 1e-300}, {3, .5f, 0}};
    rows[0].missed = {0, .25f};
    rows[2].scale = 4;
    return rows;
}

} // namespace

TEST_CASE("Rows that are read are those that were written") {
    const std::vector<MeasuredRow> rows = some_rows();
    const std::string bytes = bytes_of(rows);
    std::vector<MeasuredRow> read(4);
    StateReader reader(bytes);
    load_rows(reader, read);
    reader.expect_end();
    CHECK(bytes_of(read) == bytes);
    CHECK((read[0].is_measured() && !read[1].is_measured() && read[2].scale == 4));
    CHECK((read[0].pairs[1].to == 3 && read[0].missed[1] == .25f && read[0].work.lines == 2));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        std::vector<MeasuredRow> none(4);
        StateReader cut(std::string_view(bytes).substr(0, length));
        CHECK_THROWS_AS(load_rows(cut, none), StateError);
    }
    std::vector<MeasuredRow> more(5);
    StateReader again(bytes);
    CHECK_THROWS_AS(load_rows(again, more), StateError);
}

TEST_CASE("Rows that name patches which are not there, or no numbers, are refused") {
    const auto refuses = [](const auto& spoil) {
        std::vector<MeasuredRow> rows = some_rows(), read(4);
        spoil(rows);
        const std::string bytes = bytes_of(rows);
        StateReader reader(bytes);
        CHECK_THROWS_AS(load_rows(reader, read), StateError);
    };
    refuses([](auto& rows) { rows[0].pairs[1].to = 4; });
    refuses([](auto& rows) { rows[0].pairs[1].to = 1; });
    refuses([](auto& rows) { rows[0].pairs[0].to = 0; });
    refuses([](auto& rows) { rows[0].pairs[0].exchange = -1; });
    refuses([](auto& rows) { rows[0].pairs[0].exchange = NAN; });
    refuses([](auto& rows) { rows[0].pairs[0].deviation = NAN; });
    refuses([](auto& rows) { rows[0].missed[0] = -1; });
    refuses([](auto& rows) { rows[0].scale = -1; });
}

TEST_CASE(
    "A search that goes on from rows of another finds the same, and does no more than is left") {
    const test::Model model{blocks()};
    std::vector<std::string> kept;
    const auto find = [&](unsigned threads, std::vector<double> before, const std::string& from) {
        Monitor monitor;
        ExchangeOptions options{
            .rays = 256, .tolerance = relative_above(.02, 1e-2), .before = std::move(before)};
        options.keep = [&](std::span<const MeasuredRow> rows, bool) {
            kept.push_back(bytes_of(rows));
        };
        if (!from.empty())
            options.load = [&](std::span<MeasuredRow> rows) {
                StateReader reader(from);
                load_rows(reader, rows);
            };
        kept.clear();
        const FoundExchange found =
            find_exchange(model.mesh, model.bvh, options, Workers(threads), monitor);
        CHECK(found.work.rows_left == 0);
        return std::pair(kept.back(), found.list.unlisted_bound);
    };
    const auto whole = find(1, {}, {});
    const std::vector<std::string> parts = kept;
    REQUIRE(parts.size() >= 3); // 256 rows at a time, and the last
    CHECK(find(2, {}, parts.front()) == whole);
    CHECK(kept.size() < parts.size()); // 512 rows at a time
    CHECK(find(1, {}, whole.first) == whole);
    for (const std::string& rows : kept)
        CHECK(rows == whole.first);
    // The rows of a coarser pass are measured again; their rays and lines count.
    (void)find(1, {4}, {});
    const std::string coarse = kept[1];
    const auto [after, bound] = find(1, {}, coarse);
    CHECK(bound == whole.second);
    CHECK(after != whole.first);
}
