#include "io/scene_files/glass.h"

#include "io/files/text_words.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>

namespace hemilux {
namespace {

constexpr std::size_t longest_glass_name = 100; ///< bytes, in messages

std::string three_numbers(const Vec3& v) {
    constexpr int digits = 3;
    std::string text;
    for (int channel = 0; channel < 3; ++channel) {
        std::array<char, 32> number{};
        const auto end = std::to_chars(number.data(), number.data() + number.size(), v[channel],
                                       std::chars_format::general, digits);
        text += (channel > 0 ? " " : "") + std::string(number.data(), end.ptr);
    }
    return text;
}

bool shines(const Material& material) { return material.emission != Vec3(0.0); }

bool is_coloured(const Vec3& v) {
    constexpr double hardly = .01;
    return std::max({v.r, v.g, v.b}) - std::min({v.r, v.g, v.b}) > hardly;
}

/// Returns whether glass that were a surface of these colours would reflect noticeably.
bool would_reflect(const Material& material, const GlassMaterial& glass) {
    constexpr double hardly = .05;
    const Vec3 reflected = material.reflectance * (1.0 - glass.transmittance);
    return std::max({reflected.r, reflected.g, reflected.b}) > hardly;
}

/// Returns a warning that names the glass for which text_for() is not empty; empty for none.
template <class TextFor>
std::string warning_of(const ReadResult& read, const TextFor& text_for, const std::string& one,
                       const std::string& many) {
    constexpr std::size_t max_names = 4;
    std::vector<std::string> names;
    std::string where;
    for (const GlassMaterial& glass : read.glass) {
        const std::string text = text_for(read.scene.materials[glass.material], glass);
        if (text.empty())
            continue;
        if (names.empty())
            where = read.material_source[glass.material] + ": ";
        names.push_back('"' +
                        shortened(read.scene.materials[glass.material].name, longest_glass_name) +
                        "\": " + text);
    }
    if (names.empty())
        return "";
    return where + (names.size() == 1 ? one : std::to_string(names.size()) + " " + many) + " (" +
           list_names(names, max_names) + ")";
}

void add_warning(ReadResult& read, const std::string& text) {
    if (!text.empty())
        read.warnings.push_back(text);
}

void warn_of_open_glass(ReadResult& read) {
    add_warning(read, warning_of(
                          read,
                          [](const Material& material, const GlassMaterial& glass) {
                              return shines(material) ? glass.said_by : "";
                          },
                          "a material emits and lets light through; it is opaque here",
                          "materials emit and let light through; they are opaque here"));
    add_warning(read,
                warning_of(
                    read,
                    [](const Material&, const GlassMaterial& glass) {
                        return glass.open && is_coloured(glass.transmittance)
                                   ? three_numbers(glass.transmittance)
                                   : "";
                    },
                    "a glass is coloured; the mean of its channels comes through here",
                    "kinds of glass are coloured; the mean of their channels comes through here"));
    add_warning(read,
                warning_of(
                    read,
                    [](const Material& material, const GlassMaterial& glass) {
                        return glass.open && would_reflect(material, glass)
                                   ? "reflectance " + three_numbers(material.reflectance)
                                   : "";
                    },
                    "a glass reflects nothing here; it absorbs what does not come through",
                    "kinds of glass reflect nothing here; they absorb what does not come through"));
}

/// Moves the facets of open glass out of the scene.
void take_out(Scene& scene, const std::vector<const GlassMaterial*>& open) {
    auto panes = std::make_shared<std::vector<Pane>>();
    const bool textured = !textures_of(scene).texcoords.empty();
    std::size_t kept = 0;
    for (std::size_t f = 0; f < scene.facets.size(); ++f) {
        const Facet& facet = scene.facets[f];
        if (const GlassMaterial* const glass = open[facet.material]) {
            const Vec3& t = glass->transmittance;
            panes->push_back(
                {polygon_of(scene.vertices, facet.vertex).corner, (t.r + t.g + t.b) / 3});
            continue;
        }
        if (textured)
            for (std::vector<Texcoords>& set : own_textures_of(scene).texcoords)
                set[kept] = set[f];
        scene.facets[kept++] = facet;
    }
    scene.facets.resize(kept);
    if (textured)
        for (std::vector<Texcoords>& set : own_textures_of(scene).texcoords)
            set.resize(kept);
    if (!panes->empty())
        scene.panes = std::move(panes);
}

} // namespace

void warn_of_solid_glass(ReadResult& read) {
    read.glass_warning = warning_of(
        read, [](const Material&, const GlassMaterial& glass) { return glass.said_by; },
        "a material lets light through; it is opaque here; solve and bake open it by --glass open",
        "materials let light through; they are opaque here; solve and bake open them by --glass "
        "open");
    add_warning(read, read.glass_warning);
}

void open_glass(ReadResult& read) {
    std::erase(read.warnings, read.glass_warning);
    read.glass_warning.clear();
    std::vector<const GlassMaterial*> open(read.scene.materials.size());
    for (GlassMaterial& glass : read.glass) {
        glass.open = !shines(read.scene.materials[glass.material]);
        if (glass.open)
            open[glass.material] = &glass;
    }
    take_out(read.scene, open);
    warn_of_open_glass(read);
}

} // namespace hemilux
