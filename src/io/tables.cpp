#include "io/tables.h"

#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/error.h"
#include "radiosity/mesh.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

namespace hemilux {
namespace {

constexpr std::string_view patch_header =
    "patch,face,material,group,area,x,y,z,nx,ny,nz,reflectance_r,reflectance_g,reflectance_b,"
    "emission_r,emission_g,emission_b,radiosity_r,radiosity_g,radiosity_b,stderr_r,stderr_g,"
    "stderr_b\n";
constexpr std::string_view steps_header =
    "method,run,step,rays,seconds,estimated_error,true_error,true_error_detail,true_error_rest\n";

/// Fields that follow a comma.
void add(std::string& line, double value) {
    line += ',';
    csv::append_number(line, value);
}
void add(std::string& line, std::uint64_t value) {
    line += ',';
    csv::append_number(line, value);
}
void add(std::string& line, const Vec3& v) {
    for (int i = 0; i < 3; ++i)
        add(line, v[i]);
}
void add_if_known(std::string& line, double value) {
    line += ',';
    if (!std::isnan(value))
        csv::append_number(line, value);
}

/// The texts that many rows share are made once.
struct SharedFields {
    std::vector<std::string> material, colours, group;

    explicit SharedFields(const Scene& scene) {
        for (const Material& m : scene.materials) {
            csv::append_text(material.emplace_back(","), m.name);
            std::string& text = colours.emplace_back();
            add(text, m.reflectance);
            add(text, m.emission);
        }
        for (const std::string& name : scene.groups)
            csv::append_text(group.emplace_back(","), name);
    }
};

} // namespace

void write_patch_table(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity,
                       std::span<const Vec3> standard_error) {
    const std::span<const Patch> patches = mesh.patches();
    assert(radiosity.size() == patches.size());
    assert(standard_error.empty() || standard_error.size() == patches.size());
    const Scene& scene = mesh.scene();
    const LocalFrame& frame = mesh.frame();
    const SharedFields shared(scene);
    AtomicFile file(path);
    file.write(patch_header);
    std::string line;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const Patch& patch = patches[i];
        const Facet& facet = scene.facets[patch.facet];
        line.clear();
        csv::append_number(line, std::uint64_t{i});
        add(line, std::uint64_t{facet.face});
        line += shared.material[patch.material];
        line += facet.group < shared.group.size() ? shared.group[facet.group] : ",";
        add(line, frame.area_to_world(patch.area));
        add(line, frame.to_world(patch.centre));
        add(line, patch.normal);
        line += shared.colours[patch.material];
        add(line, radiosity[i]);
        add(line, standard_error.empty() ? Vec3(0.0) : standard_error[i]);
        line += '\n';
        file.write(line);
    }
    file.commit();
}

void write_steps_log(const std::string& path, std::span<const StepRow> rows) {
    std::string text(steps_header);
    for (const StepRow& row : rows) {
        csv::append_text(text, row.method);
        add(text, std::uint64_t{row.run});
        add(text, std::uint64_t{row.record.step});
        add(text, row.record.rays);
        add(text, row.record.seconds);
        add_if_known(text, row.record.estimated_error);
        constexpr double absent = std::numeric_limits<double>::quiet_NaN();
        const RelativeError error = row.error.value_or(RelativeError{absent, absent, absent});
        add_if_known(text, error.all);
        add_if_known(text, error.detail);
        add_if_known(text, error.rest);
        text += '\n';
    }
    write_atomically(path, text);
}

} // namespace hemilux
