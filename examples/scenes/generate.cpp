// Writes the example scenes:
//     generate_scenes FOLDER           writes NAME.obj and NAME.mtl of each scene
//     generate_scenes --check FOLDER   compares instead; fails if a file would differ

#include "scenes.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>

namespace {

using namespace hemilux;

struct PromisedScene {
    SceneWriter (*make)();
    std::size_t patches;
};

constexpr std::array promised{
    PromisedScene{make_cornell_box, 1005}, PromisedScene{make_room, 1002},
    PromisedScene{make_office, 3576},      PromisedScene{make_wall_before_crowd, 1462},
    PromisedScene{make_building, 6068},    PromisedScene{make_open_scene, 856},
    PromisedScene{make_furnace_box, 150},  PromisedScene{make_furnace_lshape, 150},
    PromisedScene{make_cube, 96},          PromisedScene{make_cube_of_six, 6},
};

void write(const std::string& path, const std::string& content) {
    std::ofstream file(path, std::ios::binary);
    file << content;
    if (!file.flush())
        throw std::runtime_error("cannot write " + path);
}

void check(const std::string& path, const std::string& content) {
    std::ifstream file(path, std::ios::binary);
    if (std::string(std::istreambuf_iterator<char>(file), {}) != content)
        throw std::runtime_error(path + " is not what the generator makes");
}

void deliver(const PromisedScene& scene, const std::string& folder, bool only_check) {
    const SceneWriter made = scene.make();
    std::cout << made.name() << ": " << made.patches() << " patches\n";
    if (made.patches() != scene.patches)
        throw std::runtime_error(made.name() + " should have " + std::to_string(scene.patches));
    const auto output = only_check ? check : write;
    output(folder + '/' + made.name() + ".obj", made.obj());
    output(folder + '/' + made.name() + ".mtl", made.mtl());
}

} // namespace

int main(int argc, char** argv) {
    const bool only_check = argc == 3 && std::string_view(argv[1]) == "--check";
    if (argc != 2 && !only_check) {
        std::cerr << "usage: generate_scenes [--check] FOLDER\n";
        return 1;
    }
    int failures = 0;
    for (const PromisedScene& scene : promised)
        try {
            deliver(scene, argv[argc - 1], only_check);
        } catch (const std::exception& error) {
            std::cerr << "generate_scenes: " << error.what() << '\n';
            ++failures;
        }
    return failures == 0 ? 0 : 1;
}
