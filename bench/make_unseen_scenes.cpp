// Writes the scenes of unseen_scenes.h as OBJ files:
//
//     make_unseen_scenes FOLDER [SEEDS]
//
// FOLDER/wall_KIND_HIDDEN_SEED.obj for each kind of wall and what it hides,
// FOLDER/obstacle_KIND_HIDDEN_SEED.obj for each kind of obstacle, and FOLDER/furnished_SEED.obj,
// for the seeds 1 to SEEDS (2).
#include "unseen_scenes.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

using namespace hemilux;
using namespace hemilux::bench;

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    if (!(file << text).flush())
        throw std::runtime_error(path.string() + ": cannot be written");
}

void write(const std::filesystem::path& folder, const SceneWriter& scene) {
    write(folder / (scene.name() + ".obj"), scene.obj());
    write(folder / (scene.name() + ".mtl"), scene.mtl());
}

void write_all(const std::filesystem::path& folder, std::uint64_t seeds) {
    std::filesystem::create_directories(folder);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        for (std::size_t wall = 0; wall < wall_names.size(); ++wall)
            for (std::size_t hidden = 0; hidden < hidden_names.size(); ++hidden)
                write(folder, make_wall_scene(Wall{wall}, Hidden{hidden}, seed));
        for (std::size_t obstacle = 0; obstacle < obstacle_names.size(); ++obstacle)
            for (std::size_t hidden = 0; hidden < hidden_names.size(); ++hidden)
                write(folder, make_obstacle_scene(Obstacle{obstacle}, Hidden{hidden}, seed));
        write(folder, make_furnished_room(seed));
    }
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fputs("usage: make_unseen_scenes FOLDER [SEEDS]\n", stderr);
        return 1;
    }
    write_all(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "make_unseen_scenes: %s\n", error.what());
    return 2;
}
