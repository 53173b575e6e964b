#include "app/lamps/dimmed_table.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"
#include "io/results/csv.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t absent = static_cast<std::size_t>(-1);

std::string text_of(double value) {
    std::string text;
    csv::append_number(text, value);
    return text;
}

/// Returns the name of the layer whose first column this is; empty where it is none.
std::string layer_of(const std::string& column) {
    const std::string_view end = ".r", error = ".stderr.r";
    if (!column.ends_with(end) || column.ends_with(error))
        return "";
    return column.substr(0, column.size() - end.size());
}

} // namespace

LampTable::LampTable(const std::string& path) : path_(path) {
    const std::string content = read_text_file(path, InputKind::stream);
    constexpr double bytes_per_byte = 8; // texts of fields are kept
    ask_for_input(path, bytes_per_byte * static_cast<double>(content.size()));
    csv::Reader reader(path, content);
    if (!reader.next(header_))
        throw InputError(path, "is empty; expected a table of solve --layers");
    for (std::vector<std::string> row; reader.next(row);) {
        if (row.size() != header_.size())
            throw InputError(path, reader.line(),
                             "expected " + std::to_string(header_.size()) + " fields, got " +
                                 std::to_string(row.size()));
        rows_.push_back(std::move(row));
        lines_.push_back(reader.line());
    }
    for (std::size_t k = 0; k < header_.size(); ++k)
        if (const std::string name = layer_of(header_[k]); !name.empty()) {
            names_.push_back(name);
            layers_.push_back({k, column(name + ".stderr.r")});
            if (column(name + ".g") != k + 1 || column(name + ".b") != k + 2)
                throw InputError(path, 1, "expected columns " + name + ".g and .b after .r");
        }
    of_points_ = column("irradiance_r") != absent;
    const char* const needed[] = {of_points_ ? "irradiance_r" : "emission_r", "radiosity_r",
                                  "stderr_r", of_points_ ? "point" : "lamp"};
    for (const char* const name : needed)
        if (column(name) == absent || layers_.empty())
            throw InputError(path, 1,
                             "expected a table of patches or points that solve --layers wrote");
}

std::size_t LampTable::column(const std::string& name) const {
    const auto found = std::ranges::find(header_, name);
    return found == header_.end() ? absent : static_cast<std::size_t>(found - header_.begin());
}

Vec3 LampTable::colour(std::size_t row, std::size_t column) const {
    Vec3 colour(0.0);
    for (int c = 0; c < 3; ++c) {
        const std::string& field = rows_[row][column + std::size_t(c)];
        const std::optional<double> value = parse_decimal(field);
        if (!value)
            throw InputError(path_, lines_[row],
                             header_[column + std::size_t(c)] + ": " + "expected a number, " +
                                 found_instead(field));
        colour[c] = *value;
    }
    return colour;
}

void LampTable::set(std::size_t row, std::size_t column, const Vec3& colour) {
    for (int c = 0; c < 3; ++c)
        rows_[row][column + std::size_t(c)] = text_of(colour[c]);
}

std::vector<WishedPlace> LampTable::places(const std::string& wishes) const {
    if (!of_points_)
        throw InputError(path_, "is a table of patches; wishes are for that of --points-output");
    const std::string content = read_text_file(wishes, InputKind::stream);
    csv::Reader reader(wishes, content);
    std::vector<WishedPlace> places;
    bool is_first = true;
    for (std::vector<std::string> row; reader.next(row);) {
        const auto refuse = [&](const std::string& what) {
            throw InputError(wishes, reader.line(), what);
        };
        std::vector<double> numbers;
        for (const std::string& field : row)
            if (const std::optional<double> number = parse_decimal(trimmed(field)))
                numbers.push_back(*number);
        const std::string_view first = trimmed(row[0]);
        if (std::exchange(is_first, false) && !first.empty() &&
            std::isalpha(static_cast<unsigned char>(first[0])) != 0)
            continue; // a header
        if (numbers.size() != row.size() || (row.size() != 2 && row.size() != 4))
            refuse("expected point,wish or point,r,g,b");
        const auto point = static_cast<std::size_t>(std::max(numbers[0], 0.0));
        if (double(point) != numbers[0] || point >= rows_.size())
            refuse("expected a point from 0 to " + std::to_string(rows_.size() - 1));
        if (rows_[point][column("irradiance_r")].empty())
            refuse("point " + std::to_string(point) + " has no light in " + path_);
        if (*std::ranges::min_element(numbers) < 0)
            refuse("expected light of 0 or more [W/m2]");
        const bool by_channel = row.size() == 4;
        for (int c = 0; c < (by_channel ? 3 : 1); ++c) {
            WishedPlace& place = places.emplace_back();
            place.wish = numbers[std::size_t(c) + 1];
            for (const auto& [light, error] : layers_) {
                const Vec3 brought = colour(point, light),
                           off = error == absent ? Vec3(0.0) : colour(point, error);
                place.brought.push_back(by_channel ? brought[c]
                                                   : (brought.x + brought.y + brought.z) / 3);
                place.error.push_back(by_channel ? off[c] : (off.x + off.y + off.z) / 3);
            }
        }
    }
    if (places.empty())
        throw InputError(wishes, "there is no wish; expected rows point,wish");
    return places;
}

void LampTable::dim_row(std::size_t row, const std::vector<Vec3>& factors) {
    const std::size_t whole = column(of_points_ ? "irradiance_r" : "radiosity_r");
    if (rows_[row][whole].empty())
        return;
    const Vec3 before = colour(row, whole);
    Vec3 sum(0.0), squares(0.0);
    for (std::size_t k = 0; k < layers_.size(); ++k) {
        const auto& [light, error] = layers_[k];
        const Vec3 dimmed = factors[k] * colour(row, light);
        set(row, light, dimmed);
        sum += dimmed;
        if (error == absent)
            continue;
        const Vec3 off = factors[k] * colour(row, error);
        set(row, error, off);
        squares += off * off;
    }
    set(row, whole, sum);
    set(row, column("stderr_r"), glm::sqrt(squares));
    if (of_points_) {
        for (std::size_t c = 0; c < 3; ++c)
            rows_[row][column("radiosity_r") + c].clear();
        return;
    }
    const std::size_t emission = column("emission_r");
    const Vec3 emitted = colour(row, emission);
    const auto lamp = std::ranges::find(names_, rows_[row][column("lamp")]);
    const Vec3 now =
        lamp == names_.end() ? emitted : factors[std::size_t(lamp - names_.begin())] * emitted;
    set(row, emission, now);
    const std::size_t gradient = column("gradient_r_x");
    for (int c = 0; gradient != absent && c < 3; ++c) {
        const double reflected = before[c] - emitted[c];
        const double scale = reflected > 0 ? (sum[c] - now[c]) / reflected : 0;
        set(row, gradient + std::size_t(3 * c), scale * colour(row, gradient + std::size_t(3 * c)));
    }
}

void LampTable::dim(const std::vector<Vec3>& factors) {
    for (std::size_t row = 0; row < rows_.size(); ++row)
        dim_row(row, factors);
}

void LampTable::write(const std::string& path) const {
    AtomicFile file(path);
    const auto write_row = [&](const std::vector<std::string>& row) {
        std::string text;
        for (const std::string& field : row) {
            if (!text.empty() || &field != &row.front())
                text += ',';
            if (parse_decimal(field)) // text of a number stays as it is
                text += field;
            else
                csv::append_text(text, field);
        }
        file.write(text + "\n");
    };
    write_row(header_);
    for (const std::vector<std::string>& row : rows_)
        write_row(row);
    file.commit();
}

} // namespace hemilux
