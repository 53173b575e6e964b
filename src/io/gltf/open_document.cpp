#include "io/gltf/open_document.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/meshes/glb_container.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace hemilux::gltf {
namespace {

constexpr int linear_filter = 9729, clamp_to_edge = 33071; // names of OpenGL's constants

std::optional<std::size_t> whole_of(const Json& object, const char* key) {
    return object.is_object() && object.contains(key) ? whole_number(object[key]) : std::nullopt;
}

const char* type_of_picture(const std::string& name, std::string_view bytes) {
    return bytes.starts_with("\x89PNG") ? "image/png"
           : name.ends_with(".webp")    ? "image/webp"
           : name.ends_with(".ktx2")    ? "image/ktx2"
                                        : "image/jpeg";
}

} // namespace

std::optional<std::size_t> whole_number(const Json& value) {
    constexpr double limit = 1LL << 53; // doubles hold all up to it
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= limit && std::floor(number) == number))
        return std::nullopt;
    return static_cast<std::size_t>(number);
}

OpenDocument::OpenDocument(LitSource& source)
    : path_(source.path()), root_(Json::parse(source.container().json)) {
    // Members lie in one array: with room for all that are added, references to them stay valid.
    constexpr std::size_t most_added = 16;
    root_.get_ref<Json::object_t&>().reserve(root_.size() + most_added);
    join_buffers(source);
    embed_pictures(source);
}

Json& OpenDocument::array_in(Json& object, const char* name, const std::string& place) const {
    Json& member = object[name];
    if (member.is_null())
        member = Json::array();
    if (!member.is_array())
        throw InputError(path_, place + "/" + name + ": expected an array");
    return member;
}

Json& OpenDocument::extension_of(Json& object, const char* name, const std::string& place) const {
    Json* member = &object;
    std::string path = place;
    for (const char* const key : {"extensions", name}) {
        member = &(*member)[key];
        path += std::string("/") + key;
        if (member->is_null())
            *member = Json::object();
        if (!member->is_object())
            throw InputError(path_, path + ": expected an object");
    }
    return *member;
}

void OpenDocument::use_extension(const char* name) {
    Json& used = array_of("extensionsUsed");
    if (std::ranges::find(used, name) == used.end())
        used.push_back(name);
}

void OpenDocument::forget_extension(const char* name) {
    for (const char* const list : {"extensionsUsed", "extensionsRequired"})
        if (root_.contains(list)) {
            Json& names = array_of(list);
            names.erase(std::remove(names.begin(), names.end(), name), names.end());
            if (names.empty())
                root_.erase(list);
        }
}

/// The buffers follow each other in one.
void OpenDocument::join_buffers(LitSource& source) {
    std::vector<std::size_t> begin;
    for (std::size_t b = 0; b < source.document().buffers.size(); ++b) {
        begin.push_back(binary_.size());
        binary_ += source.buffers().content(b);
        pad();
    }
    Json& buffers = array_of("buffers");
    if (buffers.empty())
        buffers.push_back(Json::object());
    const auto move = [&](Json& view) {
        const std::size_t b = whole_of(view, "buffer").value_or(0);
        if (b == 0 || b >= begin.size())
            return;
        view["byteOffset"] = whole_of(view, "byteOffset").value_or(0) + begin[b];
        view["buffer"] = 0;
    };
    for (Json& view : array_of("bufferViews")) {
        move(view);
        if (view.contains("extensions") && view["extensions"].is_object())
            for (Json& extension : view["extensions"]) // as of compressed views
                if (extension.is_object())
                    move(extension);
    }
    buffers.erase(buffers.begin() + 1, buffers.end());
    buffers[0].erase("uri");
}

void OpenDocument::embed_pictures(const LitSource& source) {
    for (std::size_t i = 0; i < source.pictures().size(); ++i) {
        const std::string& name = source.pictures()[i];
        if (name.empty())
            continue;
        Json& image = root_["images"][i];
        const std::string bytes = read_input(name, InputKind::regular, {});
        image["bufferView"] = add_view(bytes);
        if (!image.contains("mimeType"))
            image["mimeType"] = type_of_picture(name, bytes);
        if (!image.contains("name"))
            image["name"] = std::filesystem::path(name).stem().string();
        image.erase("uri");
    }
}

std::size_t OpenDocument::add_view(std::string_view bytes) {
    Json& views = array_of("bufferViews");
    views.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_ += bytes;
    pad();
    return views.size() - 1;
}

std::size_t OpenDocument::add_accessor(std::string_view bytes, int target, const Json& elements) {
    const std::size_t view = add_view(bytes);
    root_["bufferViews"][view]["target"] = target;
    Json accessor{{"bufferView", view}};
    accessor.update(elements);
    Json& accessors = array_of("accessors");
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
}

std::size_t OpenDocument::add_texture(const std::string& name, std::string_view png, Json extras) {
    const std::size_t view = add_view(png);
    Json& images = array_of("images");
    images.push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
    if (!sampler_) {
        Json& samplers = array_of("samplers");
        sampler_ = samplers.size();
        samplers.push_back({{"magFilter", linear_filter},
                            {"minFilter", linear_filter},
                            {"wrapS", clamp_to_edge},
                            {"wrapT", clamp_to_edge}});
    }
    Json& textures = array_of("textures");
    textures.push_back({{"name", name},
                        {"sampler", *sampler_},
                        {"source", images.size() - 1},
                        {"extras", {{"hemilux", std::move(extras)}}}});
    return textures.size() - 1;
}

void OpenDocument::write(const std::string& path) {
    root_["buffers"][0]["byteLength"] = binary_.size();
    // A name that is not UTF-8 must not cost the user the file.
    write_glb_container(path, root_.dump(-1, ' ', false, Json::error_handler_t::replace),
                        std::array<std::string_view, 1>{binary_});
}

} // namespace hemilux::gltf
