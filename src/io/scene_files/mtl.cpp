#include "io/scene_files/mtl.h"

#include "io/files/error.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <utility>

namespace hemilux {
namespace {

/// From this opacity on a surface lets no light through.
constexpr double opaque = .999;

/// Reads three numbers, or one for all channels.
Vec3 read_colour(const std::string& path, const Statement& statement) {
    const std::string expected =
        "expected 1 or 3 numbers of at least 0 after " + std::string(statement.keyword) + ", ";
    std::string_view rest = statement.rest;
    Vec3 colour(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::string_view word = take_word(rest);
        if (i == 1 && word.empty())
            return Vec3(colour.x);
        const std::optional<double> number = parse_decimal(word);
        if (!number || *number < 0)
            throw InputError(path, statement.line,
                             expected + (number ? found_instead(word) + " (it is negative)"
                                                : found_instead_of_number(word)));
        colour[i] = *number;
    }
    return colour;
}

/// Returns whether a colour is given in a way that is not read: as a spectrum or in CIE XYZ.
bool is_other_colour(const Statement& statement) {
    std::string_view rest = statement.rest;
    const std::string_view word = take_word(rest);
    return word == "xyz" || word == "spectral";
}

/// Reads three numbers, or one for all channels; what is no number is as the first.
Vec3 read_filter(std::string_view rest) {
    Vec3 filter(parse_decimal(take_word(rest)).value_or(1));
    for (const int channel : {1, 2})
        filter[channel] = parse_decimal(take_word(rest)).value_or(filter.r);
    return filter;
}

/// Adds to the material whether the surface is one that is not diffuse here.
void read_surface(const Statement& statement, MtlMaterial& material) {
    const std::string_view keyword = statement.keyword;
    std::string_view rest = statement.rest;
    const std::string_view word = take_word(rest);
    const std::optional<double> number = parse_decimal(word);
    const std::string text = std::string(keyword) + " " + std::string(word);
    if (keyword == "map_d") {
        material.cut_out = "map_d";
    } else if (!number) {
        return;
    } else if (keyword == "illum") {
        // Kinds 4 and 9 are transparent by d only; some exporters write them for all materials.
        const double kind = *number;
        if (kind == 6 || kind == 7)
            material.transparent = text;
        else if (kind == 3 || kind == 5)
            material.mirror = text;
    } else if (keyword == "Tf") {
        material.filter = read_filter(statement.rest);
    } else if (keyword == "d" || (keyword == "Tr" && !material.has_opacity)) {
        // Exporters disagree on what Tr means, so d says it alone where there is one.
        if (keyword == "d" && !std::exchange(material.has_opacity, true) &&
            material.transparent.starts_with("Tr"))
            material.transparent.clear();
        material.opacity = keyword == "d" ? *number : 1 - *number;
        if (material.opacity < opaque)
            material.transparent = text;
    } else if (keyword == "Pm") {
        constexpr double metal = .5;
        if (*number > metal)
            material.mirror = text;
    }
}

MtlMaterial new_material(const Statement& statement, std::vector<std::string>& warnings) {
    MtlMaterial material;
    material.name = name_in(statement.rest);
    material.line = statement.line;
    if (material.name.empty()) {
        material.name = unnamed_material;
        warnings.push_back(std::to_string(statement.line) +
                           ": a material without a name; it is that of faces without one");
    }
    return material;
}

bool names_texture(std::string_view keyword) {
    constexpr std::array<std::string_view, 5> others{"bump", "disp", "decal", "refl", "norm"};
    return keyword.starts_with("map_") || std::ranges::find(others, keyword) != others.end();
}

void add_textures(std::string_view rest, std::set<std::string, std::less<>>& names) {
    constexpr int max_words = 16; // of all options together
    rest = name_in(rest);
    const bool has_options = rest.starts_with('-');
    for (int words = 0; !rest.empty() && words < max_words; ++words) {
        if (!names.contains(rest))
            names.emplace(rest);
        if (!has_options)
            return;
        (void)take_word(rest);
        rest = trimmed(rest);
    }
}

/// Takes up to three numbers after an option. The first two count, and the first alone stands for
/// both where `same` is set.
void take_numbers(std::string_view& rest, Vec2& values, bool same) {
    for (int i = 0; i < 3; ++i) {
        std::string_view after = rest;
        const std::optional<double> number = parse_decimal(take_word(after));
        if (!number || trimmed(after).empty()) // a name may be a number
            return;
        rest = after;
        if (i == 0 && same)
            values = Vec2(*number);
        else if (i < 2)
            values[i] = *number;
    }
}

constexpr std::array<std::string_view, 13> options{"-blendu",  "-blendv", "-boost", "-bm",    "-cc",
                                                   "-imfchan", "-texres", "-type",  "-clamp", "-s",
                                                   "-o",       "-t",      "-mm"};

/// Returns a name without options behind it, which some exporters write there.
std::string_view without_options(std::string_view name) {
    for (std::size_t at = name.find(" -"); at != std::string_view::npos;
         at = name.find(" -", at + 1)) {
        std::string_view rest = name.substr(at);
        const std::string_view word = take_word(rest);
        if (std::ranges::find(options, word) != options.end() && !trimmed(rest).empty())
            return name.substr(0, at);
    }
    return name;
}

/// Reads the name and the options that change where the picture lies. Other known options are
/// passed over with their words. The result is empty where no name follows.
std::optional<MtlTexture> read_texture(std::string_view rest) {
    constexpr std::array<std::string_view, 9> one_word{
        "-blendu", "-blendv", "-boost", "-bm", "-cc", "-imfchan", "-texres", "-type", "-clamp"};
    MtlTexture texture;
    for (rest = name_in(rest); rest.starts_with('-'); rest = trimmed(rest)) {
        const std::string_view option = take_word(rest);
        if (option == "-s") {
            take_numbers(rest, texture.scale, true);
        } else if (option == "-o") {
            take_numbers(rest, texture.offset, false);
        } else if (option == "-t" || option == "-mm") {
            Vec2 ignored(0.0);
            take_numbers(rest, ignored, false);
        } else if (std::ranges::find(one_word, option) != one_word.end()) {
            const std::string_view word = take_word(rest);
            texture.clamp |= option == "-clamp" && word == "on";
        } else {
            break;
        }
    }
    texture.name = trimmed(without_options(trimmed(rest)));
    std::ranges::replace(texture.name, '\\', '/');
    return texture.name.empty() ? std::nullopt : std::optional(std::move(texture));
}

} // namespace

Vec3 MtlMaterial::transmittance() const {
    if (transparent.empty())
        return Vec3(0.0);
    const bool is_clear = transparent.starts_with("illum") && !(opacity < opaque);
    return glm::clamp(filter * (is_clear ? 1 : 1 - opacity), 0.0, 1.0);
}

MtlFile read_mtl(const std::string& path) {
    TextReader reader(read_text_file(path, InputKind::regular));
    MtlFile file;
    std::vector<MtlMaterial>& materials = file.materials;
    std::set<std::string, std::less<>> textures;
    Statement statement;
    while (reader.next(statement)) {
        for (const std::string_view keyword : {"newmtl", "Kd", "Ke", "map_Kd", "map_Ke"})
            if (differ_in_case(statement.keyword, keyword))
                throw InputError(path, statement.line,
                                 "expected " + std::string(keyword) + ", " +
                                     found_instead(statement.keyword) +
                                     ": capitals make a difference in keywords");
        if (names_texture(statement.keyword))
            add_textures(statement.rest, textures);
        if (statement.keyword == "newmtl")
            materials.push_back(new_material(statement, file.warnings));
        else if (materials.empty())
            continue;
        else if ((statement.keyword == "Kd" || statement.keyword == "Ke") &&
                 is_other_colour(statement))
            file.warnings.push_back(std::to_string(statement.line) + ": " +
                                    std::string(statement.keyword) +
                                    " as a spectrum or in XYZ is not read");
        else if (statement.keyword == "Kd")
            materials.back().reflectance = read_colour(path, statement);
        else if (statement.keyword == "Ke")
            materials.back().emission = read_colour(path, statement);
        else if (statement.keyword == "map_Kd")
            materials.back().reflectance_map = read_texture(statement.rest);
        else if (statement.keyword == "map_Ke")
            materials.back().emission_map = read_texture(statement.rest);
        else
            read_surface(statement, materials.back());
    }
    for (std::string name : textures) {
        std::ranges::replace(name, '\\', '/');
        file.textures.push_back(std::move(name));
    }
    return file;
}

} // namespace hemilux
