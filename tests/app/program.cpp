#include "app/program.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace test {

namespace fs = std::filesystem;

Workplace::Workplace() {
    std::string name = (fs::temp_directory_path() / "hemilux-XXXXXX").string();
    if (!mkdtemp(name.data()))
        throw std::runtime_error("cannot make a temporary folder");
    folder_ = name;
}

Workplace::~Workplace() {
    std::error_code ignored;
    fs::permissions(folder_, fs::perms::owner_all, ignored);
    fs::remove_all(folder_, ignored);
}

void Workplace::write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
}

std::string Workplace::read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
}

Workplace::Outcome Workplace::hemilux(const std::string& arguments) const {
    return run("'" HEMILUX_PROGRAM "' " + arguments);
}

/// There may be fewer cores, and the user may be root in a container.
Workplace::Outcome Workplace::hemilux_on(int ranks, const std::string& arguments) const {
    return run("mpirun --quiet --allow-run-as-root --oversubscribe -n " + std::to_string(ranks) +
               " '" HEMILUX_PROGRAM "' " + arguments);
}

Workplace::Outcome Workplace::run(const std::string& command) const {
    const std::string in_folder =
        "cd '" + folder_.string() + "' && { " + command + "; } >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(in_folder.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, read("stdout.txt"), read("stderr.txt")};
}

void Workplace::write_room() const {
    write("room.mtl", "newmtl white\nKd .5 .5 .5\nnewmtl red\nKd .6 .1 .1\n"
                      "newmtl lamp\nKd 0 0 0\nKe 10 8 6\n");
    // Each side of the unit cube as 2 x 2 quads, counter-clockwise seen from inside.
    struct Side {
        const char* group;
        const char* material;
        std::array<int, 3> origin, u, v;
    };
    const std::array<Side, 6> sides{{
        {"detail_floor", "white", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        {"walls", "white", {0, 0, 2}, {0, 1, 0}, {1, 0, 0}},
        {"walls", "red", {0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"walls", "white", {2, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {"walls", "white", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}},
        {"walls", "white", {0, 2, 0}, {1, 0, 0}, {0, 0, 1}},
    }};
    std::ostringstream text;
    text << "mtllib room.mtl\n";
    for (const Side& side : sides) {
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) {
                for (const auto& [du, dv] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                    text << "v";
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        text << ' '
                             << 0.5 * (side.origin[axis] + (i + du) * side.u[axis] +
                                       (j + dv) * side.v[axis]);
                    text << '\n';
                }
                const bool lamp = side.origin[2] == 2 && i == 0 && j == 0;
                text << "g " << (lamp ? "lamp" : side.group) << "\nusemtl "
                     << (lamp ? "lamp" : side.material) << "\nf -4 -3 -2 -1\n";
            }
        }
    }
    write("room.obj", text.str());
}

} // namespace test
