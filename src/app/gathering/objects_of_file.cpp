#include "app/gathering/objects_of_file.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hemilux {
namespace {

bool is_kept(unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c >= 0x80;
}

std::string in_small_letters(std::string name) {
    for (char& c : name)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return name;
}

/// Returns the name with a number where it is taken, also in other letters: some systems take
/// these for the same.
std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    std::string unique = name;
    for (std::size_t k = 2; !taken.insert(in_small_letters(unique)).second; ++k)
        unique = name + "_" + std::to_string(k);
    return unique;
}

} // namespace

std::string name_for_file(const std::string& name) {
    constexpr std::size_t most = 60;
    std::string safe;
    for (const char c : name)
        safe += is_kept(static_cast<unsigned char>(c)) ? c : '_';
    if (safe.size() > most) {
        std::size_t end = most; // not within a letter of several bytes
        while (end > 0 && (static_cast<unsigned char>(safe[end]) & 0xc0) == 0x80)
            --end;
        safe.resize(end);
    }
    return safe.empty() ? "object" : safe;
}

std::vector<ObjectOfFile> objects_of(const gltf::LitSource& source, const Mesh& mesh) {
    const std::vector<std::uint32_t> by_face = gltf::facets_by_face(mesh);
    std::map<std::pair<std::size_t, std::optional<std::size_t>>, std::size_t> number; // by node
    std::set<std::string> taken;
    std::vector<ObjectOfFile> objects;
    for (std::size_t o = 0; o < source.origins().size(); ++o) {
        const PrimitiveOrigin& origin = source.origins()[o];
        double area = 0;
        std::uint32_t group = none;
        for (std::uint32_t t = 0; t < origin.faces; ++t)
            if (const std::uint32_t f = by_face[origin.first_face + t]; f != none) {
                area += glm::length(mesh.shape_of(f).area_vector());
                group = mesh.scene().facets[f].group;
            }
        if (group == none)
            continue;
        const auto [found, is_new] =
            number.try_emplace({origin.node, origin.instance}, objects.size());
        if (is_new)
            objects.push_back(
                {unique_name(name_for_file(mesh.scene().groups[group]), taken), {}, 0});
        objects[found->second].origins.push_back(o);
        objects[found->second].area += area;
    }
    return objects;
}

} // namespace hemilux
