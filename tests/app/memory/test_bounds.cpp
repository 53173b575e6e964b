// Memory is a bound: every file asks for its bytes before they are taken, and no run takes more
// than it is estimated to need.
#include "app/program.h"
#include "app/running.h"
#include "support/catch.h"

#include <cstdio>
#include <filesystem>
#include <string>

using Catch::Contains;
using test::Running;
using test::Workplace;

namespace {

constexpr std::uintmax_t terabyte = std::uintmax_t{1} << 40, megabyte = std::uintmax_t{1} << 20;

/// A file of this size that begins with these bytes and takes no room on the disk.
void write_sparse(const Workplace& place, const std::string& name, const std::string& begin,
                  std::uintmax_t size) {
    place.write(name, begin);
    std::filesystem::resize_file(place.path(name), size);
}

void check_ends(const Workplace& place, const std::string& arguments, int code,
                const std::string& message) {
    CAPTURE(arguments);
    const Workplace::Outcome outcome = place.hemilux(arguments);
    CHECK(outcome.code == code);
    CHECK_THAT(outcome.err, Contains(message));
}

const std::string signature = "\x89PNG\r\n\x1a\n";

void write_textured(const Workplace& place) {
    place.write_room();
    std::string library = place.read("room.mtl");
    library.insert(library.find("newmtl red"), "map_Kd big.png\n");
    place.write("room.mtl", library);
}

} // namespace

TEST_CASE("a picture far too large is not read to its end") {
    const Workplace place;
    write_textured(place);
    write_sparse(place, "big.png", "", terabyte);
    check_ends(place, "info room.obj", 0, "neither PNG, JPEG nor TGA");
    write_sparse(place, "big.png", signature, terabyte);
    check_ends(place, "info room.obj", 2, "big.png: expected a picture in a file of at most 1 GiB");
    write_sparse(place, "big.png", signature, 300 * megabyte);
    check_ends(place, "solve room.obj -o a.csv --memory 100M", 3, "--memory is 105 MB");
}

TEST_CASE("of a buffer no more is read than the model says, and not more than there is memory") {
    const Workplace place;
    const auto model = [&](const std::string& length) {
        place.write("m.gltf",
                    R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + length +
                        R"(,"uri":"b.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
                        R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3",)"
                        R"("count":3}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                        R"("nodes":[{"mesh":0}]})");
    };
    const std::string corners("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0"
                              "\0\0\0\0\0\0\x80\x3f\0\0\0\0",
                              36);
    write_sparse(place, "b.bin", corners, terabyte);
    model("36");
    CHECK(place.hemilux("info m.gltf").code == 0);
    model("1099511627776");
    check_ends(place, "info m.gltf", 3, "to be read alone, and this machine has");
    model("314572800");
    check_ends(place, "solve m.gltf -o a.csv --memory 100M", 3, "--memory is 105 MB");
}

TEST_CASE("tables, checkpoints and options are counted before they are read") {
    const Workplace place;
    place.write_room();
    write_sparse(place, "big", "x,y,z,nx,ny,nz\n", 300 * megabyte);
    const std::string solve = "solve room.obj --steps 1 -q -o a.csv --memory 100M ";
    for (const char* const option : {"--reference big", "--points big --points-output p.csv",
                                     "--for points:big", "--resume big"}) {
        CAPTURE(option);
        check_ends(place, solve + option, 3, "big: needs 327 MB to be read alone");
    }
    write_sparse(place, "big", "seed = 1\n#", 300 * megabyte);
    check_ends(place, solve + "--config big", 2, "expected the options of a run");
    // A million rows of few letters take more than their file.
    std::string rows;
    for (int i = 0; i < 400'000; ++i)
        rows += "1,1,1,0,0,1\n";
    place.write("rows", rows);
    check_ends(place, "solve room.obj --points rows --points-output p.csv --memory 30M", 3,
               "rows: needs ");
}

TEST_CASE("a million points are read in a moment") {
    const Workplace place;
    place.write_room();
    std::string rows;
    for (int i = 0; i < 1'000'000; ++i)
        rows += ".1,.1,.1,0,0,1\n";
    place.write("rows", rows + "no number");
    check_ends(place, "solve room.obj --points rows --points-output p.csv", 2, "rows:1000001:");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Asks how much the run needs, and runs it with that.
void check_peak(const Workplace& place, const std::string& arguments) {
    const std::string message = place.hemilux(arguments + " --memory 12.5M").err;
    double need = 0;
    char unit = 0;
    REQUIRE(std::sscanf(message.c_str(), "hemilux: room.obj: needs about %lf %cB", &need, &unit) ==
            2);
    need *= unit == 'G' ? 1.01e9 : 1.01e6; // as rounded
    Running bounded(place, arguments + " --memory " + std::to_string(static_cast<long>(need)),
                    place.path("stderr.txt").c_str());
    CHECK(bounded.wait() == 0);
    CHECK(bounded.peak_bytes() < need);
}

TEST_CASE("no run takes more memory than the least --memory that lets it begin", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string run = GENERATE(
        "solve room.obj --method matrix --rays 4", "solve room.obj --method progressive",
        "solve room.obj --method monte-carlo --rays 4",
        "solve room.obj --method progressive-monte-carlo --rays 4",
        "solve room.obj --method hemisphere-1997 --rays 4",
        "solve room.obj --method hemisphere --rays 4",
        "solve room.obj --method stratified --rays 4", "solve room.obj --rays 4",
        "solve room.obj --rays 4 -o a.csv", "solve room.obj --rays 4 -o a.ply",
        "solve room.obj --rays 4 -o a.glb", "solve room.obj --rays 4 -o a.vtu",
        "solve room.obj --rays 4 --report r.html", "solve room.obj --rays 4 --checkpoint saved",
        "solve room.obj --rays 4 -o a.glb --bake indirect --gather 1");
    const std::string size = GENERATE("--max-edge .1", "--max-edge .05", "--max-edge .025");
    const std::string arguments = run + " --steps 1 -q -o a.json " + size;
    CAPTURE(arguments);
    check_peak(place, arguments);
}

/// Runs it with more and more memory until it is not refused: it then takes no more than that.
void check_some_bound(const Workplace& place, const std::string& arguments) {
    constexpr double first = 12.5e6, growth = 1.5, enough = 1e9;
    for (double limit = first; limit < enough; limit *= growth) {
        Running bounded(place, arguments + " --memory " + std::to_string(static_cast<long>(limit)),
                        place.path("stderr.txt").c_str());
        const int code = bounded.wait();
        if (code == 3) {
            const std::string message = place.read("stderr.txt");
            CHECK_THAT(message, Contains(": needs ") && Contains(", and --memory is "));
            continue;
        }
        CHECK(code == 0);
        CHECK(limit > first); // some were refused
        CHECK(bounded.peak_bytes() < limit);
        return;
    }
    FAIL("a gigabyte is not enough");
}

TEST_CASE("no command that solves nothing takes more than --memory", "[slow]") {
    const Workplace place;
    place.write_room();
    SECTION("info, form factors and densities") {
        const std::string run =
            GENERATE("info room.obj --json", "formfactors room.obj --rays 64 -q -o f.csv",
                     "formfactors room.obj --rays 1024 -q -o f.npy",
                     "formfactors room.obj --factors hemicube:32 -q -o f.csv",
                     "density room.obj -q -o d.svg", "density room.obj -q -o d.png --size 640x480",
                     "density room.obj -q --depth 4 --threshold 0 --rays 20000 -o d.svg -o d.png",
                     "density room.obj -q --method hemisphere-1997 -o d.svg");
        const std::string size = GENERATE(" --max-edge .2", " --max-edge .1", " --max-edge .05");
        CAPTURE(run, size);
        check_some_bound(place, run + size + " >info.txt");
    }
    SECTION("exact factors and view factors") {
        const std::string run =
            GENERATE("formfactors room.obj --exact --rays 64 -q -o f.csv",
                     "viewfactors room.obj -q --error 5% -o f.npz",
                     "viewfactors room.obj -q --error 5% --by group --sky -o f.npy -o f.csv",
                     "viewfactors room.obj -q --error 5% -o f.vtu --legend f.csv",
                     "viewfactors room.obj -q --of sky -o f.vtu");
        const std::string size = GENERATE(" --max-edge .4", " --max-edge .3", " --max-edge .2");
        CAPTURE(run, size);
        check_some_bound(place, run + size);
    }
}

TEST_CASE("many points take no more than the least --memory that lets them begin", "[slow]") {
    const Workplace place;
    place.write_room();
    const int count = GENERATE(10'000, 100'000, 300'000);
    std::string rows;
    for (int i = 0; i < count; ++i)
        rows += ".5 .5 .5 0 0 1\n";
    place.write("p.txt", rows);
    check_some_bound(place, "solve room.obj --divide none -q --max-rays 200000 --points p.txt "
                            "--points-output light.csv");
}

TEST_CASE("no run with --layers takes more memory than the least that lets it begin", "[slow]") {
    const Workplace place;
    place.write_room();
    std::string room = place.read("room.obj"), rows;
    for (int lamp = 0; lamp < 12; ++lamp) {
        const std::string x0 = std::to_string(.1 + .06 * lamp),
                          x1 = std::to_string(.14 + .06 * lamp);
        room += "v " + x0 + " .5 .01\nv " + x1 + " .5 .01\nv " + x1 + " .54 .01\nv " + x0 +
                " .54 .01\n";
        room += "g desk" + std::to_string(lamp) + "\nusemtl lamp\nf -4 -3 -2 -1\n";
    }
    place.write("room.obj", room);
    for (int k = 0; k < 50'000; ++k)
        rows += ".5 .5 .5 0 0 1\n";
    place.write("p.txt", rows);
    const std::string picture = "--divide none --size 256x256 -o a.exr " + test::camera_in_room;
    const std::string output =
        GENERATE_COPY(picture + "--gather 1", picture + "--no-gather", "--max-edge .02 -o a.csv",
                      "--max-edge .02 --report r.html", "--divide none --lightmap 256 -o a.glb",
                      "--divide none --points p.txt --points-output light.csv");
    check_some_bound(place, "solve room.obj --layers lamp -q --max-rays 200000 " + output);
}

TEST_CASE("no picture takes more memory than the least --memory that lets it begin", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string output = GENERATE("-o a.png", "-o a.hdr", "-o a.exr", "-o a.exr -o a.png",
                                        "--error-map a.png -o a.csv", "--lightmap 256 -o a.glb");
    const std::string gather = GENERATE("--no-gather", "--gather 1");
    const int side = GENERATE(64, 128, 256);
    const std::string arguments = "solve room.obj --error 5% --max-rays 100000 -q " + output + " " +
                                  gather + " " + test::camera_in_room + "--size " +
                                  std::to_string(side) + "x" + std::to_string(side);
    CAPTURE(arguments);
    check_peak(place, arguments);
}
#endif
