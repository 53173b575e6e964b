#include "io/meshes/vtu.h"

#include "geometry/frame.h"
#include "io/files/provenance.h"
#include "io/meshes/vtk_grid.h"
#include "radiosity/paper/scene/mesh.h"

#include <span>
#include <vector>

namespace hemilux {
namespace {

/// The patches that are cells, as columns.
class Cells {
  public:
    Cells(const Mesh& mesh, const CornerClasses& classes) : mesh_(mesh), classes_(classes) {
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
            if (!mesh.material(mesh.patches()[i]).is_far)
                patch_.push_back(i);
    }

    [[nodiscard]] std::size_t size() const { return patch_.size(); }

    /// Returns `value` of each patch that is a cell, given its number.
    template <class Value>
    auto column(Value value) const {
        std::vector<decltype(value(std::uint32_t{}))> values;
        values.reserve(patch_.size());
        for (const std::uint32_t i : patch_)
            values.push_back(value(i));
        return values;
    }

    void add_shapes(VtkGrid& grid) const {
        constexpr std::uint8_t vtk_triangle = 5, vtk_polygon = 7, vtk_quad = 9;
        std::vector<std::uint32_t> corners;
        std::vector<std::uint64_t> ends;
        for (const std::uint32_t i : patch_) {
            const auto size = static_cast<std::size_t>(mesh_.patches()[i].shape.size());
            const Outline* const outline = outline_of(classes_, i);
            const auto vertices = outline ? std::span<const std::uint32_t>(outline->classes)
                                          : std::span(classes_.of_patch[i]).first(size);
            corners.insert(corners.end(), vertices.begin(), vertices.end());
            ends.push_back(corners.size());
        }
        grid.add("connectivity", 1, corners);
        grid.add("offsets", 1, ends);
        grid.add("types", 1, column([&](std::uint32_t i) {
                     return outline_of(classes_, i)                  ? vtk_polygon
                            : mesh_.patches()[i].shape.is_triangle() ? vtk_triangle
                                                                     : vtk_quad;
                 }));
    }

    void add_columns(VtkGrid& grid, const Solution& solution) const {
        const auto patch = [&](std::uint32_t i) -> const Patch& { return mesh_.patches()[i]; };
        const auto facet = [&](std::uint32_t i) { return mesh_.scene().facets[patch(i).facet]; };
        const LocalFrame& frame = mesh_.frame();
        grid.add("patch", 1, patch_);
        grid.add("face", 1, column([&](std::uint32_t i) { return facet(i).face; }));
        grid.add("material", 1, column([&](std::uint32_t i) { return patch(i).material; }));
        grid.add("group", 1, column([&](std::uint32_t i) { return facet(i).group; }));
        grid.add("area", 1,
                 column([&](std::uint32_t i) { return frame.area_to_world(patch(i).area); }));
        grid.add("normal", column([&](std::uint32_t i) { return patch(i).normal; }));
        grid.add("reflectance",
                 column([&](std::uint32_t i) { return mesh_.material(patch(i)).reflectance; }));
        grid.add("emission",
                 column([&](std::uint32_t i) { return mesh_.material(patch(i)).emission; }));
        grid.add("radiosity", column([&](std::uint32_t i) { return solution.radiosity[i]; }));
        grid.add("stderr", column([&](std::uint32_t i) {
                     return solution.standard_error.empty() ? Vec3(0.0)
                                                            : solution.standard_error[i];
                 }));
        for (int channel = 0; channel < 3 && !solution.slope.empty(); ++channel)
            grid.add(std::string("gradient_") + "rgb"[channel], column([&](std::uint32_t i) {
                         const Frame axes = Frame::from_normal(patch(i).normal);
                         const Slope& slope = solution.slope[i];
                         return frame.scale *
                                (slope.x[channel] * axes.x + slope.y[channel] * axes.y);
                     }));
        if (!solution.weight.empty())
            grid.add("target", 1, column([&](std::uint32_t i) { return solution.weight[i]; }));
    }

  private:
    const Mesh& mesh_;
    const CornerClasses& classes_;
    std::vector<std::uint32_t> patch_;
};

void add_names(VtkGrid& grid, const Scene& scene, const Provenance& from) {
    std::vector<std::string> materials;
    for (const Material& material : scene.materials)
        materials.push_back(material.name);
    grid.add_texts("material_names", materials);
    grid.add_texts("group_names", scene.groups);
    grid.add_texts("program", {from.program});
    grid.add_texts("command", {from.command});
    grid.add_texts("seed", {std::to_string(from.seed)});
}

} // namespace

void write_vtu(const std::string& path, const Mesh& mesh, const CornerClasses& classes,
               const Solution& solution, const Provenance& from) {
    const Cells cells(mesh, classes);
    std::vector<Vec3> points;
    for (const Vec3& local : classes.position)
        points.push_back(mesh.frame().to_world(local));
    VtkGrid grid;
    grid.add("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
             "<FieldData>");
    add_names(grid, mesh.scene(), from);
    grid.add("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points.size()) +
             "\" NumberOfCells=\"" + std::to_string(cells.size()) + "\">\n<Points>");
    grid.add("points", points);
    grid.add("</Points>\n<PointData Scalars=\"light\">");
    grid.add("light", smooth(mesh, classes, solution.radiosity, solution.slope));
    grid.add("</PointData>\n<Cells>");
    cells.add_shapes(grid);
    grid.add("</Cells>\n<CellData Scalars=\"radiosity\">");
    cells.add_columns(grid, solution);
    grid.add("</CellData>\n</Piece>\n</UnstructuredGrid>");
    grid.write(path);
}

} // namespace hemilux
