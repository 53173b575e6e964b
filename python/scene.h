#pragma once
// The scene as Python holds it: a mesh, and a tree for its rays once one is asked for.

#include "bvh/wide/wide_bvh.h"
#include "io/scene_files/read_result.h"
#include "python/arrays.h"
#include "radiosity/answers/run/problem.h"
#include "radiosity/paper/scene/mesh.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// A mesh with what the program knows of its file. All functions may be called from any thread.
class PythonMesh {
  public:
    PythonMesh(Mesh mesh, ReadResult read, std::string name, int up, std::string fault)
        : mesh_(std::make_shared<Mesh>(std::move(mesh))), read_(std::move(read)),
          name_(std::move(name)), up_(up), fault_(std::move(fault)) {}

    [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
    /// Returns the tree of the mesh; the first call builds it.
    [[nodiscard]] const WideBvh& tree(unsigned threads) const;
    /// Returns what runs solve; by a tree, where they need one, which is built once for all.
    [[nodiscard]] std::shared_ptr<const Problem> problem(bool keep_all, unsigned threads) const;
    [[nodiscard]] int up() const { return up_; } ///< axis that points to the sky
    [[nodiscard]] const std::vector<std::string>& warnings() const { return read_.warnings; }
    [[nodiscard]] const std::vector<std::uint32_t>& face_lines() const { return read_.face_lines; }
    /// Returns the path of the file, or "Mesh".
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Throws InputError where no method can solve the scene.
    void check_solvable() const;

  private:
    std::shared_ptr<Mesh> mesh_;
    ReadResult read_; ///< without its scene
    std::string name_;
    int up_;
    std::string fault_; ///< why it cannot be solved; empty: it can
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const WideBvh> tree_;
};

/// Faces as arrays. Python has checked the shapes.
struct FaceArrays {
    Doubles vertices; ///< (n, 3) [m]
    Integers faces;   ///< (m, k) corners; unused places at the end of a row are negative
    std::vector<std::string> groups;
    Integers group;                ///< (m,) indices of groups
    Doubles reflectance, emission; ///< (p, 3) of materials [-], [W/m2]
    Integers material;             ///< (m,) indices of materials
    py::array_t<bool> two_sided;   ///< (m,)
};

/// Makes a mesh of faces, which are divided into triangles and planar quads as those of files.
/// Throws InputError.
[[nodiscard]] std::unique_ptr<PythonMesh> mesh_of(const FaceArrays& arrays, double max_edge,
                                                  int up);

/// Reads a file, with the colours that replace those of its materials. Without `two_sided` faces
/// have the sides that the file gives them.
[[nodiscard]] std::unique_ptr<PythonMesh>
read_mesh(const std::string& path, const std::vector<std::pair<std::string, Vec3>>& reflectance,
          const std::vector<std::pair<std::string, Vec3>>& emission, std::optional<bool> two_sided,
          double max_edge, std::optional<int> up);

/// Adds the class to the module.
void add_mesh(py::module_& module);

} // namespace hemilux
