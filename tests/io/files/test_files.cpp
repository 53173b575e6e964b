// Which file a path names, what may be read, and what a replaced file keeps.
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/file_identity.h"
#include "io/scene_files/mtl.h"
#include "io/scene_files/obj.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <filesystem>
#include <sys/stat.h>

using namespace hemilux;
using hemilux::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string faces = "v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n";

} // namespace

TEST_CASE("paths of one file have one identity", "[files]") {
    const TemporaryFolder folder;
    const std::string file = folder.write("a", "");
    fs::create_symlink("a", folder.path("link"));
    fs::create_hard_link(file, folder.path("hard"));
    fs::create_directory(folder.path("sub"));
    fs::create_symlink("../none", folder.path("sub/dangling"));
    fs::create_symlink("loop", folder.path("loop"));
    for (const char* same : {"link", "hard", "./a", "sub/../a"})
        CHECK(identity_of(folder.path(same)) == identity_of(file));
    CHECK(identity_of(folder.write("b", "")) != identity_of(file));
    CHECK(identity_of(folder.path("none")).has_value());
    CHECK(identity_of(folder.path("sub/dangling")) == identity_of(folder.path("none")));
    CHECK(identity_of(folder.path("sub/none")) != identity_of(folder.path("none")));
    CHECK(fs::path(creation_path(folder.path("sub/dangling"))).lexically_normal() ==
          folder.path("none"));
    CHECK(creation_path(folder.path("loop")) == folder.path("loop"));
    CHECK_FALSE(identity_of("/dev/null").has_value());
    CHECK_FALSE(identity_of(folder.path("no/folder")).has_value());
    CHECK_FALSE(identity_of("").has_value());
}

TEST_CASE("a file that replaces another keeps its mode", "[files]") {
    const TemporaryFolder folder;
    const std::string file = folder.write("a", "old");
    for (const mode_t mode : {0600u, 0640u, 0664u, 0755u}) {
        REQUIRE(::chmod(file.c_str(), mode) == 0);
        write_atomically(file, "new");
        struct stat status {};
        REQUIRE(::stat(file.c_str(), &status) == 0);
        CHECK((status.st_mode & 07777) == mode);
    }
}

TEST_CASE("a link to a file that does not exist makes that file and stays a link", "[files]") {
    const TemporaryFolder folder;
    fs::create_directory(folder.path("sub"));
    fs::create_symlink("sub/new", folder.path("link"));
    write_atomically(folder.path("link"), "new");
    CHECK(fs::is_symlink(folder.path("link")));
    CHECK(hemilux::test::content_of(folder.path("sub/new")) == "new");
}

TEST_CASE("a library outside the scene's folder is read and reported once", "[files]") {
    const TemporaryFolder folder;
    const std::string library = folder.write("outside.mtl", "newmtl a\nKd .25\n");
    folder.write("scene/inside.mtl", "newmtl a\nKd .25\n");
    fs::create_symlink("../outside.mtl", folder.path("scene/link.mtl"));
    fs::create_symlink("scene", folder.path("other"));
    for (const auto& [name, is_outside] :
         {std::pair<std::string, bool>{"inside.mtl", false},
          {"../scene/inside.mtl", false},
          {"../other/inside.mtl", false},
          {"../outside.mtl", true},
          {"link.mtl", true},
          {library, true},
          {"../outside.mtl\nmtllib link.mtl\nmtllib " + library, true}}) {
        CAPTURE(name);
        const ReadResult read =
            read_obj(folder.write("scene/s.obj", "mtllib " + name + "\n" + faces));
        CHECK(read.scene.materials.at(0).reflectance.r == .25);
        CHECK(read.libraries.size() == 1);
        CHECK(read.warnings.size() == (is_outside ? 1 : 0));
        for (const std::string& warning : read.warnings)
            CHECK_THAT(warning, Catch::Contains("s.obj:1: ") &&
                                    Catch::Contains("outside the scene's folder"));
    }
}

TEST_CASE("only regular files are libraries", "[files]") {
    const TemporaryFolder folder;
    for (const char* name : {"/proc/kmsg", "/proc/self/status", "/sys/kernel/notes", "/dev/zero",
                             "/dev/null", "../../../../../../proc/kmsg"}) {
        CAPTURE(name);
        const ReadResult read =
            read_obj(folder.write("s.obj", std::string("mtllib ") + name + "\n" + faces));
        CHECK(read.libraries.empty());
        CHECK_THAT(read.warnings.at(0), Catch::Contains("not found or no regular file"));
    }
}

TEST_CASE("a file of zeros is read no further than to the first", "[files]") {
    const TemporaryFolder folder;
    const std::string sparse = folder.write("s.obj", faces);
    fs::resize_file(sparse, std::uintmax_t{1} << 40);
    CHECK_THROWS_WITH(read_obj(sparse), Catch::Contains("NUL byte"));
}

TEST_CASE("a library names its textures", "[files]") {
    const TemporaryFolder folder;
    const MtlFile read = read_mtl(folder.write(
        "m.mtl", "newmtl a\nmap_Kd wood grain.png # oak\nmap_Ke dir\\lamp.png\nmap_Bump -bm 2 "
                 "dents.png\nmap_Kd wood grain.png\nmap_Kd\nKd .5\nrefl -type sphere sky.hdr\n"));
    for (const char* name : {"wood grain.png", "dir/lamp.png", "dents.png", "sky.hdr"})
        CHECK(std::ranges::count(read.textures, name) == 1);
    CHECK(read.materials.size() == 1);
}

TEST_CASE("lines of faces are remembered", "[files]") {
    const TemporaryFolder folder;
    const ReadResult read =
        read_obj(folder.write("s.obj", faces + "# comment\nf 1 \\\n2 3\nf 1 1 1\nf 3 2 1\n"));
    CHECK(read.face_lines == std::vector<std::uint32_t>{5, 7, 9, 10});
}
