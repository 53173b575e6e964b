// The class of meshes, as the package's own Mesh wraps it.

#include "python/scene.h"

#include <pybind11/stl.h>

namespace hemilux {
namespace {

Vec3 vector_of(const std::array<double, 3>& numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

using NamedColours = std::vector<std::pair<std::string, std::array<double, 3>>>;

std::vector<std::pair<std::string, Vec3>> named(const NamedColours& colours) {
    std::vector<std::pair<std::string, Vec3>> result;
    for (const auto& [name, colour] : colours)
        result.emplace_back(name, vector_of(colour));
    return result;
}

/// Returns an array with make(patch) for each patch.
template <class T, class Make>
auto by_patch(const PythonMesh& self, const Make& make) {
    const std::span<const Patch> patches = self.mesh().patches();
    return array_by<T>(patches.size(), [&](std::size_t i) { return make(patches[i]); });
}

py::dict patches_of(const PythonMesh& self) {
    const Mesh& mesh = self.mesh();
    const LocalFrame& frame = mesh.frame();
    const auto facet = [&](const Patch& patch) -> const Facet& {
        return mesh.scene().facets[patch.facet];
    };
    py::dict result;
    result["face"] = by_patch<std::int64_t>(self, [&](const Patch& p) { return facet(p).face; });
    result["group"] = by_patch<std::int64_t>(self, [&](const Patch& p) { return facet(p).group; });
    result["material"] = by_patch<std::int64_t>(self, [](const Patch& p) { return p.material; });
    result["back"] = by_patch<std::uint8_t>(
        self, [](const Patch& p) { return static_cast<std::uint8_t>(p.back); });
    result["area"] =
        by_patch<double>(self, [&](const Patch& p) { return frame.area_to_world(p.area); });
    result["centre"] =
        by_patch<Vec3>(self, [&](const Patch& p) { return frame.to_world(p.centre); });
    result["normal"] = by_patch<Vec3>(self, [](const Patch& p) { return p.normal; });
    result["reflectance"] =
        by_patch<Vec3>(self, [&](const Patch& p) { return mesh.material(p).reflectance; });
    result["emission"] =
        by_patch<Vec3>(self, [&](const Patch& p) { return mesh.material(p).emission; });
    return result;
}

std::vector<std::string> materials_of(const PythonMesh& self) {
    std::vector<std::string> names;
    for (const Material& material : self.mesh().scene().materials)
        names.push_back(material.name);
    return names;
}

} // namespace

void add_mesh(py::module_& module) {
    py::class_<PythonMesh>(module, "Mesh")
        .def_property_readonly("groups",
                               [](const PythonMesh& self) { return self.mesh().scene().groups; })
        .def_property_readonly("materials", &materials_of)
        .def_property_readonly("warnings", &PythonMesh::warnings)
        .def_property_readonly("up", &PythonMesh::up)
        .def_property_readonly("faces",
                               [](const PythonMesh& self) { return self.mesh().scene().faces; })
        .def("__len__", [](const PythonMesh& self) { return self.mesh().patches().size(); })
        .def("patches", &patches_of);
    module.def("mesh_of",
               [](const Doubles& vertices, const Integers& faces,
                  const std::vector<std::string>& groups, const Integers& group,
                  const Doubles& reflectance, const Doubles& emission, const Integers& material,
                  const py::array_t<bool>& two_sided, double max_edge, int up) {
                   const FaceArrays arrays{vertices,    faces,    groups,   group,
                                           reflectance, emission, material, two_sided};
                   const py::gil_scoped_release unlocked;
                   return mesh_of(arrays, max_edge, up);
               });
    module.def("read", [](const std::string& path, const NamedColours& reflectance,
                          const NamedColours& emission, std::optional<bool> two_sided,
                          double max_edge, std::optional<int> up) {
        const py::gil_scoped_release unlocked;
        return read_mesh(path, named(reflectance), named(emission), two_sided, max_edge, up);
    });
}

} // namespace hemilux
