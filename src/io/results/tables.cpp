#include "io/results/tables.h"

#include "geometry/frame.h"
#include "io/files/atomic_file.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string_view>

namespace hemilux {
namespace {

constexpr std::string_view patch_header =
    "patch,face,material,group,area,x,y,z,nx,ny,nz,reflectance_r,reflectance_g,reflectance_b,"
    "emission_r,emission_g,emission_b,radiosity_r,radiosity_g,radiosity_b,stderr_r,stderr_g,"
    "stderr_b";
constexpr std::string_view gradient_header =
    ",gradient_r_x,gradient_r_y,gradient_r_z,gradient_g_x,gradient_g_y,gradient_g_z,gradient_b_x,"
    "gradient_b_y,gradient_b_z";

/// The rows of a patch table. The texts that many of them share are made once.
class PatchRows {
  public:
    PatchRows(const Mesh& mesh, std::span<const Vec3> radiosity,
              std::span<const Vec3> standard_error, std::span<const Slope> slope,
              std::span<const double> weight, const csv::MoreColumns& more)
        : mesh_(mesh), radiosity_(radiosity), standard_error_(standard_error), slope_(slope),
          weight_(weight), more_(more) {
        for (const Material& m : mesh.scene().materials) {
            csv::append_field(material_.emplace_back(), m.name);
            std::string& text = colours_.emplace_back();
            csv::append_fields(text, m.reflectance);
            csv::append_fields(text, m.emission);
        }
        for (const std::string& name : mesh.scene().groups)
            csv::append_field(group_.emplace_back(), name);
    }

    void append(std::size_t i, std::string& text) const {
        const Patch& patch = mesh_.patches()[i];
        const Facet& facet = mesh_.scene().facets[patch.facet];
        const LocalFrame& frame = mesh_.frame();
        csv::append_number(text, std::uint64_t{i});
        csv::append_field(text, std::uint64_t{facet.face});
        text += material_[patch.material];
        text += facet.group < group_.size() ? group_[facet.group] : ",";
        csv::append_field(text, frame.area_to_world(patch.area));
        csv::append_fields(text, frame.to_world(patch.centre));
        csv::append_fields(text, patch.normal);
        if (patch.colours == patch.material) {
            text += colours_[patch.material];
        } else {
            csv::append_fields(text, mesh_.material(patch).reflectance);
            csv::append_fields(text, mesh_.material(patch).emission);
        }
        csv::append_fields(text, radiosity_[i]);
        csv::append_fields(text, standard_error_.empty() ? Vec3(0.0) : standard_error_[i]);
        if (!slope_.empty()) {
            const Frame axes = Frame::from_normal(patch.normal);
            for (int channel = 0; channel < 3; ++channel)
                csv::append_fields(text, frame.scale * (slope_[i].x[channel] * axes.x +
                                                        slope_[i].y[channel] * axes.y));
        }
        if (!weight_.empty())
            csv::append_field(text, weight_[i]);
        csv::append_fields(text, more_, i);
        text += '\n';
    }

  private:
    const Mesh& mesh_;
    std::span<const Vec3> radiosity_, standard_error_;
    std::span<const Slope> slope_;
    std::span<const double> weight_;
    const csv::MoreColumns& more_;
    std::vector<std::string> material_, colours_, group_;
};

} // namespace

void write_patch_table(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity,
                       std::span<const Vec3> standard_error, const Workers& workers,
                       std::span<const Slope> slope, std::span<const double> weight,
                       const csv::MoreColumns& more) {
    const std::size_t rows = mesh.patches().size();
    assert(radiosity.size() == rows);
    assert(standard_error.empty() || standard_error.size() == rows);
    const PatchRows table(mesh, radiosity, standard_error, slope, weight, more);
    std::string header(patch_header);
    if (!slope.empty())
        header += gradient_header;
    if (!weight.empty())
        header += ",target";
    csv::append_names(header, more);
    csv::write_table(path, header, rows, workers,
                     [&](std::size_t row, std::string& text) { table.append(row, text); });
}

void write_steps_log(const std::string& path, std::span<const StepRow> rows) {
    std::string text(steps_columns);
    text += '\n';
    for (const StepRow& row : rows) {
        csv::append_text(text, row.method);
        csv::append_field(text, std::uint64_t{row.run});
        csv::append_field(text, std::uint64_t{row.record.step});
        csv::append_field(text, row.record.rays);
        csv::append_field(text, row.record.seconds);
        csv::append_known(text, row.record.estimated_error);
        constexpr double absent = std::numeric_limits<double>::quiet_NaN();
        const RelativeError error = row.error.value_or(RelativeError{absent, absent, absent});
        csv::append_known(text, error.all);
        csv::append_known(text, error.detail);
        csv::append_known(text, error.rest);
        csv::append_known(text, row.total_error.value_or(absent));
        text += '\n';
    }
    write_atomically(path, text);
}

} // namespace hemilux
