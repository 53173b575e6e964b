#pragma once
// Builds an OBJ scene in which each face is one patch: grids, boxes and prisms of quads.
//
// Every solid is closed and a vertex is written once however many faces share it. Only + - * / and
// sqrt are used, and coordinates are rounded to a picometre, so that any machine writes the same
// bytes and turned furniture stays planar.

#include "radiosity/paper/scene/scene.h"

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// Where an object stands: turned about the vertical axis, then moved.
class Placement {
  public:
    Placement() = default;
    explicit Placement(const Vec3& origin) : origin_(origin) {}
    Placement(double x, double y, double z) : origin_(x, y, z) {}

    /// The same place, the object's x axis turned to the horizontal direction (dx, 0, dz).
    [[nodiscard]] Placement facing(double dx, double dz) const;
    [[nodiscard]] Vec3 to_world(const Vec3& local) const;
    /// Of an object that stands in this one's frame.
    [[nodiscard]] Placement operator()(const Placement& inner) const;

  private:
    Vec3 origin_{0.0};
    double cosine_ = 1, sine_ = 0; ///< counter-clockwise seen from above
};

struct BoxShape {
    Vec3 low, size;
    std::array<int, 3> divisions{1, 1, 1};
};

/// Faces of a box, to be added up.
enum BoxFace : unsigned {
    face_left = 1,   ///< -x
    face_right = 2,  ///< +x
    face_bottom = 4, ///< -y
    face_top = 8,    ///< +y
    face_back = 16,  ///< -z
    face_front = 32, ///< +z
    all_faces = 63
};

/// Which side of a box is air.
enum class BoxAir { outside, inside };

/// A frustum of a regular polygon about the vertical axis, base at the origin.
struct PrismShape {
    double base_radius, top_radius, height;
    int sides; ///< 4, 6, 8 or 12
    int rows = 1;
};

class SceneWriter {
  public:
    explicit SceneWriter(std::string name) : name_(std::move(name)) {}

    void define(const Material& material) { materials_.push_back(material); }
    /// Of the faces that follow. Throws std::invalid_argument if it is not defined.
    void use(std::string_view material);
    void group(std::string_view name) { group_ = name; }

    /// Counter-clockwise seen from the air.
    void add_face(std::span<const Vec3> corners);
    /// The parallelogram corner + [0,1] u + [0,1] v; its front is where u x v points.
    void add_grid(const Placement& at, const Vec3& corner, const Vec3& u, const Vec3& v, int nu,
                  int nv);
    void add_box(const Placement& at, const BoxShape& shape, unsigned faces = all_faces,
                 BoxAir air = BoxAir::outside);
    void add_prism(const Placement& at, const PrismShape& shape);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::size_t patches() const { return faces_.size(); }
    [[nodiscard]] std::string obj() const;
    [[nodiscard]] std::string mtl() const;

  private:
    struct Face {
        std::vector<std::size_t> vertex;
        std::size_t material;
        std::string group;
    };

    void add_box_side(const Placement& at, const BoxShape& shape, std::size_t side, BoxAir air);
    std::size_t vertex(const Vec3& position);

    std::string name_, group_ = "scene";
    std::vector<Material> materials_;
    std::size_t material_ = 0;
    std::vector<Vec3> vertices_;
    std::map<std::array<double, 3>, std::size_t> vertex_index_;
    std::vector<Face> faces_;
};

} // namespace hemilux
