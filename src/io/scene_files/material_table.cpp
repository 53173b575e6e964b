#include "io/scene_files/material_table.h"

#include "io/files/input_file.h"
#include "io/files/text_words.h"
#include "io/scene_files/glass.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t longest_name = 100; ///< bytes, in messages

std::string in_quotes(std::string_view name) { return '"' + shortened(name, longest_name) + '"'; }

std::string counted_materials(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " material" : " materials");
}

std::string without_quotes(std::string_view name) {
    if (name.size() > 1 && name.front() == '"' && name.back() == '"')
        name = name.substr(1, name.size() - 2);
    return std::string(name);
}

} // namespace

std::uint32_t MaterialTable::index_of(const std::string& name) {
    const auto next = static_cast<std::uint32_t>(result_.scene.materials.size());
    const auto [found, is_new] = index_.try_emplace(name, next);
    if (is_new) {
        result_.scene.materials.emplace_back().name = name;
        result_.material_source.emplace_back();
        entries_.emplace_back();
    }
    return found->second;
}

std::uint32_t MaterialTable::use(const std::string& name, std::size_t line) {
    const std::uint32_t index = index_of(name);
    Entry& entry = entries_[index];
    if (!entry.used)
        entry.first_use = line;
    entry.used = true;
    return index;
}

/// Returns the path of the file as named, relative to the OBJ file's folder. As paths of other
/// machines are common, it then looks for the last part of the name in that folder. The result is
/// empty where neither is a regular file.
std::string MaterialTable::find_library(std::string_view name) const {
    std::string plain = without_quotes(name);
    std::replace(plain.begin(), plain.end(), '\\', '/');
    const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
    const std::filesystem::path given(plain);
    for (const std::filesystem::path& candidate : {folder / given, folder / given.filename()}) {
        if (is_input(candidate.string(), InputKind::regular)) // a pipe might never end
            return candidate.string();
    }
    return {};
}

void MaterialTable::read_libraries(std::string_view names, std::size_t line) {
    const std::string where = path_ + ":" + std::to_string(line) + ": ";
    const std::string_view whole = name_in(names);
    if (whole.empty()) {
        if (libraries_missed_.insert("").second)
            result_.warnings.push_back(where + "no file name after mtllib");
        return;
    }
    if (const std::string file = find_library(whole); !file.empty()) {
        read_library(file, where);
        return;
    }
    std::vector<std::string> found;
    std::string missing;
    for (std::string_view rest = names, word = take_word(rest); !word.empty();
         word = take_word(rest))
        if (std::string file = find_library(word); !file.empty())
            found.push_back(std::move(file));
        else
            missing += (missing.empty() ? "" : ", ") + in_quotes(word);
    if (found.empty())
        missing = in_quotes(whole);
    for (const std::string& file : found)
        read_library(file, where);
    missing = shortened(missing, longest_name);
    if (!missing.empty() && libraries_missed_.insert(missing).second)
        result_.warnings.push_back(where + "material library " + missing +
                                   " not found or no regular file");
}

void MaterialTable::read_library(const std::string& file, const std::string& where) {
    const std::optional<FileIdentity> identity = identity_of(file);
    if (!identity || !libraries_read_.insert(*identity).second)
        return;
    outside_.check(file, where.substr(0, where.size() - 2), "material library");
    /// The memory per character of the shortest statements that make a material.
    constexpr double bytes_per_character = 16;
    std::error_code error;
    if (const std::uintmax_t size = std::filesystem::file_size(file, error);
        before_library_ && !error)
        before_library_(bytes_per_character * static_cast<double>(size));
    result_.libraries.push_back(file);
    MtlFile read = read_mtl(file);
    for (const std::string& warning : read.warnings)
        result_.warnings.push_back(file + ":" + warning);
    for (const MtlMaterial& material : read.materials)
        define(file, material);
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    for (const std::string& texture : read.textures)
        result_.textures.push_back((folder / texture).string());
}

void MaterialTable::define(const std::string& file, const MtlMaterial& material) {
    const std::string where = file + ":" + std::to_string(material.line);
    const std::uint32_t index = index_of(material.name);
    Entry& entry = entries_[index];
    if (entry.definition) {
        if (std::exchange(entry.redefined_in, file) == file)
            return;
        result_.warnings.push_back(where + ": material " + in_quotes(material.name) +
                                   " is defined in \"" + result_.material_source[index] +
                                   "\" already, which is taken");
        return;
    }
    result_.material_source[index] = where;
    Material& to = result_.scene.materials[index];
    to.reflectance = material.reflectance.value_or(to.reflectance);
    to.emission = material.emission.value_or(to.emission);
    entry.folder = std::filesystem::path(file).parent_path().string();
    entry.definition = material;
}

void MaterialTable::finish() {
    warn_of_undefined();
    find_glass();
    warn_of_surfaces();
    if (!read_textures_)
        return;
    for (std::size_t m = 0; m < entries_.size(); ++m) {
        const Entry& entry = entries_[m];
        if (!entry.used || !entry.definition)
            continue;
        const MtlMaterial& of = *entry.definition;
        add_texture(m, of.reflectance_map, &Material::reflectance, &MaterialTextures::reflectance,
                    of.reflectance);
        add_texture(m, of.emission_map, &Material::emission, &MaterialTextures::emission,
                    of.emission);
    }
    warn_of_textures();
}

/// Returns a texture of a material's library; empty where there is none. As paths of other machines
/// are common, the last part of the name is looked for too.
std::shared_ptr<const Texture> MaterialTable::texture_of(std::size_t material,
                                                         const std::string& name) {
    const std::filesystem::path folder(entries_[material].folder), given(name);
    for (const std::filesystem::path& candidate : {folder / given, folder / given.filename()}) {
        const std::string file = candidate.string();
        if (is_input(file, InputKind::regular))
            outside_.check(file, result_.material_source[material], "texture");
        if (std::shared_ptr<const Texture> read = texture_files_.read(file))
            return read;
    }
    return nullptr;
}

/// Kd or Ke is a factor of its texture, 1 where there is none. The picture's lower left corner is
/// the origin of coordinates.
void MaterialTable::add_texture(std::size_t material, const std::optional<MtlTexture>& texture,
                                Vec3 Material::*colour, TextureMap MaterialTextures::*map,
                                const std::optional<Vec3>& factor) {
    if (!texture)
        return;
    const std::shared_ptr<const Texture> read = texture_of(material, texture->name);
    if (!read) {
        if (missing_++ == 0)
            first_missing_ = texture->name;
        return;
    }
    SceneTextures& textures = own_textures_of(result_.scene);
    textures.of_material.resize(result_.scene.materials.size());
    TextureMap& to = textures.of_material[material].*map;
    to.texture = read;
    to.factor = factor.value_or(Vec3(1.0));
    if (texture->clamp)
        to.wraps = {Wrap::clamp, Wrap::clamp};
    to.origin = {texture->offset.x, 1 - texture->offset.y};
    to.x = {texture->scale.x, 0};
    to.y = {0, -texture->scale.y};
    result_.scene.materials[material].*colour = to.factor * read->mean();
}

void MaterialTable::warn_of_undefined() {
    std::vector<std::string> names;
    std::string where;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (entries_[i].definition || entries_[i].first_use == 0)
            continue;
        if (names.empty())
            where = path_ + ":" + std::to_string(entries_[i].first_use) + ": ";
        names.push_back(in_quotes(result_.scene.materials[i].name));
    }
    if (!names.empty())
        result_.warnings.push_back(where + counted_materials(names.size()) +
                                   " used but not defined (" + list_names(names) +
                                   "): reflectance 0.5, no emission");
}

/// A material with holes is no glass: what of it lets light through is not known.
void MaterialTable::find_glass() {
    for (std::uint32_t m = 0; m < entries_.size(); ++m) {
        const std::optional<MtlMaterial>& of = entries_[m].definition;
        if (!entries_[m].used || !of || !of->cut_out.empty())
            continue;
        if (const Vec3 transmittance = of->transmittance(); transmittance != Vec3(0.0))
            result_.glass.push_back({m, transmittance, of->transparent});
    }
    warn_of_solid_glass(result_);
}

/// Warns of materials in use that do not send light as the file says.
void MaterialTable::warn_of_surfaces() {
    const auto warn = [&](const auto& statement_of, const std::string& one,
                          const std::string& many) {
        std::vector<std::string> names;
        std::string where;
        for (std::size_t m = 0; m < entries_.size(); ++m) {
            if (!entries_[m].used || !entries_[m].definition)
                continue;
            const std::string statement = statement_of(*entries_[m].definition);
            if (statement.empty())
                continue;
            if (names.empty())
                where = result_.material_source[m] + ": ";
            names.push_back(in_quotes(result_.scene.materials[m].name) + ": " + statement);
        }
        if (!names.empty())
            result_.warnings.push_back(
                where + (names.size() == 1 ? one : std::to_string(names.size()) + " " + many) +
                " (" + list_names(names, 4) + ")");
    };
    warn([](const MtlMaterial& of) { return of.cut_out; },
         "a material has holes by a texture; it is whole here",
         "materials have holes by textures; they are whole here");
    warn([](const MtlMaterial& of) { return of.mirror; },
         "a material is a mirror or a metal; it reflects diffusely here, by Kd",
         "materials are mirrors or metals; they reflect diffusely here, by Kd");
    warn(
        [](const MtlMaterial& of) {
            return std::string(of.reflectance_map && of.reflectance == Vec3(0.0) ? "Kd 0" : "");
        },
        "a material has Kd 0 and a map_Kd, which it multiplies: it is black",
        "materials have Kd 0 and a map_Kd, which it multiplies: they are black");
}

void MaterialTable::warn_of_textures() {
    if (missing_ > 0)
        result_.warnings.push_back(
            path_ + ": " + std::to_string(missing_) +
            (missing_ == 1 ? " texture is" : " textures are") +
            " not found, or neither PNG, JPEG nor TGA; colours are Kd and Ke alone there (" +
            in_quotes(first_missing_) + (missing_ == 1 ? ")" : " is the first)"));
}

} // namespace hemilux
