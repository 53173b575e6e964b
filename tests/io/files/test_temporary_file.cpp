// What killed processes leave behind is removed; what others write to is not.
#include "io/files/atomic_file.h"
#include "io/files/temporary_file.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <csignal>
#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

using namespace hemilux;
namespace fs = std::filesystem;

TEST_CASE("names of temporary files are distinguished from others", "[atomic]") {
    for (const char* name : {".hemilux-1-0.tmp", ".hemilux-4194303-123.tmp"})
        CHECK(is_temporary_name(name));
    for (const char* name :
         {"", ".tmp", ".hemilux-.tmp", ".hemilux-1.tmp", ".hemilux-1-.tmp", ".hemilux--1.tmp",
          ".hemilux-1-2.tmp.bak", "a.hemilux-1-2.tmp", ".hemilux-1-x.tmp", ".hemilux-1-2-3.tmp",
          ".hemilux-tmp", "hemilux-1-2.tmp", ".hemilux-1 -2.tmp"})
        CHECK_FALSE(is_temporary_name(name));
}

TEST_CASE("the next output removes what a killed process left, and nothing else", "[atomic]") {
    const test::TemporaryFolder folder;
    folder.write(".hemilux-1-0.tmp", "left"); // of a process that lives, but does not hold it
    folder.write(".hemilux-1-0.tmp.bak", "the user's");
    folder.write("target", "the user's");
    fs::create_directory(folder.path(".hemilux-2-0.tmp"));
    fs::create_symlink(folder.path("target"), folder.path(".hemilux-3-0.tmp"));
    const TemporaryFile held = make_temporary(folder.path(""));
    REQUIRE(held.descriptor >= 0);
    write_atomically(folder.path("a.txt"), "new");
    CHECK_FALSE(fs::exists(folder.path(".hemilux-1-0.tmp")));
    CHECK(fs::exists(folder.path(".hemilux-1-0.tmp.bak")));
    CHECK(fs::exists(folder.path(".hemilux-2-0.tmp")));
    CHECK(fs::is_symlink(folder.path(".hemilux-3-0.tmp")));
    CHECK(fs::exists(folder.path("target")));
    CHECK(fs::exists(held.path));
    ::close(held.descriptor);
    remove_stale_temporaries(folder.path(""));
    CHECK_FALSE(fs::exists(held.path));
}

TEST_CASE("a lock ends with the process that held it", "[atomic]") {
    const test::TemporaryFolder folder;
    int ready[2];
    REQUIRE(pipe(ready) == 0);
    const pid_t child = fork();
    if (child == 0) {
        const TemporaryFile file = make_temporary(folder.path(""));
        (void)!::write(ready[1], "x", 1);
        for (;;)
            pause();
    }
    char byte = 0;
    REQUIRE(::read(ready[0], &byte, 1) == 1);
    remove_stale_temporaries(folder.path(""));
    CHECK_FALSE(fs::is_empty(folder.path("")));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    remove_stale_temporaries(folder.path(""));
    CHECK(fs::is_empty(folder.path("")));
    ::close(ready[0]);
    ::close(ready[1]);
}
