// Bad files: one clear message with file and line, never a crash.

#include "io/files/error.h"
#include "io/scene_files/obj.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <string>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

const std::string triangle_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// The message without the folder; empty where nothing was thrown.
std::string error_of(const std::string& content) {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.obj", content);
    try {
        (void)read_obj(path);
    } catch (const InputError& error) {
        const std::string message = error.what();
        const std::string prefix = path.substr(0, path.size() - 5);
        return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
    }
    return {};
}

bool starts_with_line(const std::string& message, int line) {
    return message.starts_with("s.obj:" + std::to_string(line) + ": expected ");
}

} // namespace

TEST_CASE("malformed numbers are refused with file and line", "[obj]") {
    for (const std::string number : {"nan", "inf", "-inf", "1e300", "1e400", "0x10", "1.0D0", "1,5",
                                     "1..2", "--1", "+-1", "1e", ".", "-", "abc", "1_0"}) {
        const std::string message = error_of(triangle_vertices + "v 0 " + number + " 0\nf 1 2 3\n");
        INFO(number << " -> " << message);
        CHECK(starts_with_line(message, 4));
        CHECK(message.find("found \"" + number + "\"") != std::string::npos);
    }
    CHECK(error_of("v 1 2\n") ==
          "s.obj:1: expected three numbers after v, found the end of the line");
    CHECK(error_of("v 1,5 2,5 3,5\n") == "s.obj:1: expected three numbers after v, found \"1,5\" "
                                         "(decimals are written with a point)");
}

TEST_CASE("malformed faces are refused with file and line", "[obj]") {
    for (const std::string face :
         {"f", "f # none", "f 0 1 2", "f 1 2 4", "f 1 2 -4", "f 1 2 x", "f 1/x 2 3",
          "f 1/1/1/1 2 3", "f 1 2 1.5", "f 1,2,3", "f /1 2 3", "f 1 2 99999999999",
          "f 1 2 99999999999999999999999", "f 1 2 -99999999999999999999999", "f 1 2 4294967296",
          "f 1 2 4294967298", "f 1 2 3 \\ 3"}) {
        const std::string message = error_of("\r\n" + triangle_vertices + face + "\nf 1 2 3\n");
        INFO(face << " -> " << message);
        CHECK(starts_with_line(message, 5));
    }
}

TEST_CASE("lines are counted across continuations and every line end", "[obj]") {
    CHECK(starts_with_line(error_of("v 0 \\\n0 \\\r\n0\rv 1 0 0\r\n\r\nf x\n"), 6));
}

TEST_CASE("long and unprintable words are shown in short", "[obj]") {
    const std::string message = error_of("v 1 " + std::string(100000, '9') + "\x01 3\n");
    CHECK(message.size() < 200);
    CHECK(error_of("v \x01\x1b 0 0\n").find("found \"??\"") != std::string::npos);
}

TEST_CASE("files that are no OBJ files are refused", "[obj]") {
    CHECK(error_of("").find("no faces") != std::string::npos);
    CHECK(error_of("v 0 0 0\n").find("no faces") != std::string::npos);
    CHECK(error_of("solid of another format\n").find("no faces") != std::string::npos);
    CHECK(error_of(triangle_vertices + "f 1 2 2\n") == "s.obj: none of the faces has an area");
    CHECK(error_of(std::string("\xff\xfev\0 \0", 6)).find("UTF-16") != std::string::npos);
    CHECK(error_of(std::string("\xfe\xff\0v", 4)).find("UTF-16") != std::string::npos);
    CHECK(starts_with_line(error_of("v 0 0 0\n" + std::string("v 0\0 0\n", 7)), 2));

    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_obj(folder.path("missing.obj")), InputError);
    CHECK_THROWS_AS(read_obj(folder.path(".")), InputError);
    CHECK_THROWS_AS(read_obj(""), InputError);
    CHECK_THROWS_AS(read_obj("/dev/zero"), InputError);
}

TEST_CASE("an error in a library names the library", "[obj]") {
    const TemporaryFolder folder;
    const std::string library = folder.write("m.mtl", "newmtl a\nKd 0.5 -1 0\n");
    const std::string scene =
        folder.write("s.obj", "mtllib m.mtl\n" + triangle_vertices + "f 1 2 3\n");
    CHECK_THROWS_WITH(read_obj(scene), Catch::StartsWith(library + ":2: expected"));
}

TEST_CASE("damaged files are read or refused, nothing else", "[obj]") {
    const std::string intact = "# box\r\nmtllib a.mtl\n" + triangle_vertices +
                               "v 1 1 .5e-1\ng one two\nusemtl m\nf 1/1 2//3 4 -2\nf 1 \\\n2 3\n";
    Rng rng(17);
    std::size_t refused = 0;
    constexpr int trials = 400;
    for (int i = 0; i < trials; ++i) {
        std::string damaged = intact;
        for (int k = 0; k < 3; ++k) {
            const auto at = static_cast<std::size_t>(rng.uniform() * double(damaged.size()));
            if (k == 0)
                damaged.erase(at, 1);
            else
                damaged[at] = static_cast<char>(rng.bits() & 0x7f);
        }
        refused += !error_of(damaged).empty();
    }
    CHECK(refused > 0);
    CHECK(refused < trials);
}
