#include "radiosity/engine/densities/subdivision_1997.h"

#include "geometry/frame.h"
#include "parallel/workers.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/scene/needs.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <stdexcept>
#include <string>

namespace hemilux {
namespace {

constexpr std::size_t octant_vertices = 5;

void check_choice(const char* what, std::uint32_t number, std::span<const std::uint32_t> choices) {
    if (std::ranges::find(choices, number) == choices.end())
        throw std::invalid_argument(std::string(what) + " of the technique of 1997 may not be " +
                                    std::to_string(number));
}

} // namespace

void Subdivision1997::check(const Subdivision1997Options& options) {
    check_choice("stored steps", options.stored_steps, stored_choices);
    check_choice("estimated steps", options.estimated_steps, estimated_choices);
    check_choice("parts", options.parts, part_choices);
    const std::uint32_t level = options.stored_steps + options.estimated_steps;
    const std::uint64_t wanted = options.parts * (std::uint64_t{4} << (2 * level));
    if (wanted > max_triangles)
        throw std::invalid_argument(
            std::to_string(options.stored_steps) + " stored and " +
            std::to_string(options.estimated_steps) + " estimated steps make " +
            std::to_string(wanted) + " triangles over " + std::to_string(options.parts) +
            " parts of a patch; expected " + std::to_string(max_triangles) + " at most");
}

Subdivision1997::Subdivision1997(const Mesh& mesh, const Needs& needs,
                                 const Subdivision1997Options& options)
    : mesh_(mesh), options_((check(options), options)), topology_(stored_levels()) {
    std::size_t hemispheres = mesh.patches().size();
    if (!needs.visibility || !needs.idle.empty()) {
        hemispheres_of_.assign(hemispheres, 0);
        patch_of_ = {none};
        for (std::uint32_t i = 0; needs.visibility && i < hemispheres_of_.size(); ++i)
            if (needs.power(i)) {
                hemispheres_of_[i] = static_cast<std::uint32_t>(patch_of_.size());
                patch_of_.push_back(i);
            }
        hemispheres = patch_of_.size();
    }
    direction_.resize(hemispheres * parts() * topology_.vertices().size());
    count_.resize(direction_.size(), 1);
}

double Subdivision1997::bytes_of_patch(const Subdivision1997Options& options) {
    const Hemisphere topology(static_cast<int>(options.stored_steps));
    constexpr double bytes_of_vertex = sizeof(direction_[0]) + sizeof(count_[0]);
    return bytes_of_vertex * double(options.parts) * double(topology.vertices().size());
}

void Subdivision1997::find(int level, const Tracer& tracer, const Workers& workers,
                           Monitor& monitor) {
    const std::size_t hemispheres = count_.size() / (parts() * topology_.vertices().size());
    for (const int last = std::min(level, stored_levels()); found_ < last; ++found_) {
        std::atomic<std::uint64_t> counted{0};
        workers.for_chunks(hemispheres, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !monitor.interrupted; ++i)
                for (std::size_t part = 0; part < parts(); ++part)
                    counted += find_level(found_ + 1, i, part, tracer);
        });
        rays_ += counted;
        monitor.rays += counted;
    }
}

std::size_t Subdivision1997::find_level(int level, std::size_t index, std::size_t part,
                                        const Tracer& tracer) {
    const std::uint32_t patch =
        patch_of_.empty() ? static_cast<std::uint32_t>(index) : patch_of_[index];
    const Patch& from = mesh_.patches()[patch == none ? 0 : patch];
    const Vec3 origin = part_of(from.shape, parts(), part).centre();
    const Frame frame = mesh_.hemisphere_frame(patch == none ? 0 : patch);
    const std::size_t begin = place_of_hemispheres(index, part);
    const auto keep = [&](std::size_t vertex, const Vec3& v) {
        direction_[begin + vertex] = {static_cast<float>(v.x), static_cast<float>(v.y),
                                      static_cast<float>(v.z)};
        if (patch == none)
            return;
        const Ray ray{.origin = origin,
                      .direction = frame.to_world(density_direction(v)),
                      .from = from.facet};
        count_[begin + vertex] = static_cast<std::uint8_t>(std::min(tracer.count(ray), 255u));
    };
    if (level == 0) {
        for (std::size_t v = 0; v < octant_vertices; ++v)
            keep(v, topology_.vertices()[v]);
        return patch == none ? 0 : octant_vertices;
    }
    // Vertices are numbered in the order in which triangles need them.
    const auto& cells = topology_.cells();
    const std::size_t first = cells[Hemisphere::cells_up_to(level - 2)].midpoint[0];
    std::size_t known = first;
    for (std::size_t c = Hemisphere::cells_up_to(level - 2); c < Hemisphere::cells_up_to(level - 1);
         ++c)
        for (std::size_t edge = 0; edge < 3; ++edge) {
            if (cells[c].midpoint[edge] < known)
                continue;
            const CountedDirection p1 = stored(begin + cells[c].vertex[edge]);
            const CountedDirection p2 = stored(begin + cells[c].vertex[(edge + 1) % 3]);
            keep(known++, point_on_arc(p1.direction, p2.direction,
                                       division_share(p1.surfaces, p2.surfaces)));
        }
    return patch == none ? 0 : known - first;
}

CountedDirection Subdivision1997::stored(std::size_t at) const {
    const auto& [x, y, z] = direction_[at];
    return {glm::normalize(Vec3(x, y, z)), static_cast<double>(count_[at])};
}

std::vector<CountedDirection> Subdivision1997::counted(std::uint32_t patch,
                                                       std::size_t part) const {
    std::vector<CountedDirection> directions;
    for (std::size_t v = 0; v < topology_.vertices().size(); ++v)
        directions.push_back(stored(place(patch, part) + v));
    return directions;
}

CountedTriangle Subdivision1997::triangle(std::uint32_t patch, std::size_t part, int level,
                                          std::size_t index) const {
    const int stored_level = std::min(level, stored_levels());
    int below = 2 * (level - stored_level); // bits of the path from the stored triangle on
    const auto& vertex =
        topology_.cells()[Hemisphere::cells_up_to(stored_level - 1) + (index >> below)].vertex;
    const std::size_t begin = place(patch, part);
    CountedTriangle corner = {stored(begin + vertex[0]), stored(begin + vertex[1]),
                              stored(begin + vertex[2])};
    for (; below > 0; below -= 2)
        corner = estimated_child(corner, (index >> (below - 2)) % 4);
    return corner;
}

/// Two corners of a child at a corner are new, and all three of the middle child.
std::vector<std::size_t> Subdivision1997::corners_found(int level, std::size_t index) const {
    if (level > stored_levels())
        return {};
    const std::size_t child = index % 4;
    std::vector<std::size_t> found;
    for (std::size_t corner = 0; corner < 3; ++corner)
        if (level <= 1 || child != corner)
            found.push_back(corner);
    return found;
}

} // namespace hemilux
