#include "io/results/points.h"

#include "geometry/numeric.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"
#include "io/results/csv.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string_view>

namespace hemilux {
namespace {

constexpr std::string_view points_header =
    "point,x,y,z,nx,ny,nz,irradiance_r,irradiance_g,irradiance_b,radiosity_r,radiosity_g,"
    "radiosity_b,stderr_r,stderr_g,stderr_b";

/// Takes the next word of a row, which a comma or blanks end; empty where there is none.
std::string_view next_field(std::string_view& row) {
    row = trimmed(row);
    const std::size_t size = std::min(row.find_first_of(", \t\v\f"), row.size());
    const std::string_view field = row.substr(0, size);
    row = trimmed(row.substr(size));
    if (row.starts_with(','))
        row.remove_prefix(1);
    return field;
}

/// Returns whether a row has words and no number among them: `nan,0,0,0,0,1` is a row that is
/// wrong.
bool is_header(std::string_view row) {
    while (!row.empty()) {
        const std::string_view field = next_field(row);
        if (parse_decimal(field) || (!field.empty() && field.front() != '"' &&
                                     std::isalpha(static_cast<unsigned char>(field.front())) == 0))
            return false;
    }
    return true;
}

/// Reads a row of `count` numbers, which `form` describes.
template <std::size_t count>
std::array<double, count> numbers_from(const std::string& path, std::size_t line,
                                       std::string_view row, const std::string& form) {
    const auto refuse = [&](const std::string& found) {
        throw InputError(path, line, "expected " + form + ", " + found);
    };
    std::array<double, count> numbers{};
    for (double& number : numbers) {
        const std::string_view field = next_field(row);
        const std::optional<double> value = parse_decimal(field);
        if (!value)
            refuse(found_instead_of_number(field));
        number = value.value_or(0);
    }
    if (!row.empty())
        refuse("then " + found_instead(row));
    return numbers;
}

NamedPoint point_from(const std::string& path, std::size_t line, std::string_view row) {
    const auto [x, y, z, nx, ny, nz] =
        numbers_from<6>(path, line, row, "six numbers x,y,z,nx,ny,nz");
    const Vec3 normal(nx, ny, nz);
    if (normal == Vec3(0.0))
        throw InputError(path, line, "expected a normal nx,ny,nz that is not 0,0,0");
    return {{x, y, z}, normal, direction_of(normal), line};
}

Vec3 towards(const std::string& path, std::size_t line, std::string_view row) {
    const auto [x, y, z] = numbers_from<3>(path, line, row, "three numbers x,y,z");
    const Vec3 direction(x, y, z);
    if (direction == Vec3(0.0))
        throw InputError(path, line, "expected a direction x,y,z that is not 0,0,0");
    return direction_of(direction);
}

/// Reads all rows of a file by from_row(path, line, row).
template <class Row, class FromRow>
std::vector<Row> read_rows(const std::string& path, const FromRow& from_row) {
    const std::string content = read_text_file(path, InputKind::stream);
    const auto count = static_cast<std::size_t>(std::ranges::count(content, '\n')) + 1;
    ask_for_input(path, static_cast<double>(content.size() + count * sizeof(Row)));
    std::vector<Row> rows;
    rows.reserve(count);
    bool first = true;
    std::size_t line = 0;
    for (std::string_view left = content; !left.empty();) {
        const std::size_t size = std::min(left.find_first_of("\r\n"), left.size());
        const std::string_view whole = left.substr(0, size);
        const std::string_view row = trimmed(whole.substr(0, whole.find('#')));
        left.remove_prefix(size);
        left.remove_prefix(left.starts_with("\r\n") ? 2 : left.empty() ? 0 : 1);
        ++line;
        if (row.empty() || (std::exchange(first, false) && is_header(row)))
            continue;
        rows.push_back(from_row(path, line, row));
    }
    return rows;
}

/// Appends the row of a point; its light is empty where there is none.
void append_row(const Mesh& mesh, std::uint64_t number, const NamedPoint& point,
                const Sensor& sensor, const PointLight* light, const csv::MoreColumns& more,
                std::string& text) {
    csv::append_number(text, number);
    csv::append_fields(text, point.position);
    csv::append_fields(text, point.given_normal);
    if (!light) {
        text.append(9 + 3 * more.colours.size(), ',');
        text += '\n';
        return;
    }
    csv::append_fields(text, light->irradiance);
    if (sensor.patch != none) {
        const Colours here = colours_at(mesh, mesh.patches()[sensor.patch], sensor.at.position);
        csv::append_fields(text, here.emission + here.reflectance * light->irradiance);
    } else {
        text += ",,,";
    }
    csv::append_fields(text, light->standard_error);
    csv::append_fields(text, more, number);
    text += '\n';
}

} // namespace

std::vector<NamedPoint> read_points(const std::string& path) {
    std::vector<NamedPoint> points = read_rows<NamedPoint>(path, point_from);
    if (points.empty())
        throw InputError(path, "there is no point; expected rows x,y,z,nx,ny,nz");
    return points;
}

std::vector<Vec3> read_directions(const std::string& path) {
    std::vector<Vec3> directions = read_rows<Vec3>(path, towards);
    if (directions.empty())
        throw InputError(path, "there is no direction; expected rows x,y,z");
    return directions;
}

void write_points_table(const std::string& path, const Mesh& mesh,
                        std::span<const NamedPoint> points, std::span<const Sensor> sensors,
                        std::span<const PointLight> lights, const Workers& workers,
                        const csv::MoreColumns& more) {
    std::string header(points_header);
    csv::append_names(header, more);
    csv::write_table(path, header, points.size(), workers, [&](std::size_t i, std::string& text) {
        append_row(mesh, i, points[i], sensors[i],
                   i < lights.size() && lights[i].is_known ? &lights[i] : nullptr, more, text);
    });
}

} // namespace hemilux
