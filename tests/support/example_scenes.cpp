#include "support/example_scenes.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hemilux::test {
namespace {

/// Calls take(word, rest of the line) for each line that is neither empty nor a comment.
template <class Take>
void for_lines(const std::string& path, const Take& take) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("no scene " + path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream rest(line);
        std::string word;
        if (rest >> word && word[0] != '#')
            take(word, rest);
    }
}

Vec3 vector_of(std::istream& rest) {
    Vec3 v;
    rest >> v.x >> v.y >> v.z;
    return v;
}

std::vector<Material> materials_of(const std::string& path) {
    std::vector<Material> materials;
    for_lines(path, [&](const std::string& word, std::istream& rest) {
        if (word == "newmtl") {
            materials.push_back({"", Vec3(0.0), Vec3(0.0)});
            rest >> materials.back().name;
        } else if (word == "Kd")
            materials.back().reflectance = vector_of(rest);
        else if (word == "Ke")
            materials.back().emission = vector_of(rest);
        else
            throw std::runtime_error(path + ": " + word);
    });
    return materials;
}

} // namespace

Scene example_scene(const std::string& name) {
    const std::string path = HEMILUX_SOURCE_DIR "/examples/scenes/" + name;
    Scene scene;
    std::uint32_t material = 0;
    for_lines(path + ".obj", [&](const std::string& word, std::istream& rest) {
        if (word == "v") {
            scene.vertices.push_back(vector_of(rest));
        } else if (word == "g") {
            rest >> scene.groups.emplace_back();
        } else if (word == "usemtl") {
            std::string wanted;
            rest >> wanted;
            const auto found = std::ranges::find(scene.materials, wanted, &Material::name);
            material = static_cast<std::uint32_t>(found - scene.materials.begin());
        } else if (word == "f") {
            Facet facet{{}, scene.faces++, material, 0};
            std::size_t corner = 0;
            for (std::uint32_t v = 0; corner < 4 && rest >> v; ++corner)
                facet.vertex[corner] = v - 1;
            if (corner == 3)
                facet.vertex[3] = facet.vertex[2];
            if (scene.groups.empty())
                scene.groups.push_back("default");
            facet.group = static_cast<std::uint32_t>(scene.groups.size() - 1);
            scene.facets.push_back(facet);
        } else if (word == "mtllib") {
            scene.materials = materials_of(path + ".mtl");
        } else
            throw std::runtime_error(path + ".obj: " + word);
    });
    return scene;
}

} // namespace hemilux::test
