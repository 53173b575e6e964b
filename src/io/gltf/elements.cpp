#include "io/gltf/elements.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/little_endian.h"
#include "io/gltf/document/uri.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <limits>
#include <system_error>

namespace hemilux::gltf {
namespace {

template <class Whole>
double whole_number(const char* bytes, bool normalized) {
    using Bits = std::make_unsigned_t<Whole>;
    const auto value = static_cast<double>(static_cast<Whole>(bits_at<Bits>(bytes)));
    return normalized ? std::max(value / double(std::numeric_limits<Whole>::max()), -1.0) : value;
}

double number_at(const char* bytes, Component component, bool normalized) {
    switch (component) {
    case Component::int8:
        return whole_number<std::int8_t>(bytes, normalized);
    case Component::uint8:
        return whole_number<std::uint8_t>(bytes, normalized);
    case Component::int16:
        return whole_number<std::int16_t>(bytes, normalized);
    case Component::uint16:
        return whole_number<std::uint16_t>(bytes, normalized);
    case Component::uint32:
        return whole_number<std::uint32_t>(bytes, normalized);
    case Component::float32:
        break;
    }
    return std::bit_cast<float>(bits_at<std::uint32_t>(bytes));
}

} // namespace

std::string_view Buffers::view(std::size_t view) {
    const BufferView& of = document_.views[view];
    return content(of.buffer).substr(of.offset, of.length);
}

std::string_view Buffers::content(std::size_t buffer) {
    const auto& [length, uri] = document_.buffers[buffer];
    const auto check = [&, n = length](std::string_view bytes) {
        if (bytes.size() < n)
            throw InputError(path_, "/buffers/" + std::to_string(buffer) +
                                        "/byteLength: expected at most " +
                                        std::to_string(bytes.size()) +
                                        ", the bytes there are, found " + std::to_string(n));
        return bytes;
    };
    if (uri.empty() && buffer == 0 && container_.binary)
        return check(*container_.binary);
    std::optional<std::string>& content = contents_[buffer];
    if (!content) {
        content = read(buffer, uri);
        bytes_ += static_cast<double>(content->size());
    }
    return check(*content);
}

std::string Buffers::read(std::size_t buffer, const std::string& uri) {
    const std::string place = "/buffers/" + std::to_string(buffer) + "/uri";
    if (uri.empty())
        throw InputError(path_, place + ": expected a URI, as the file has no binary chunk for it");
    const auto ask = [&](double bytes) {
        if (guard_)
            guard_(static_cast<double>(container_.content.size()) + bytes_ + bytes);
    };
    ask(static_cast<double>(uri.size()));
    auto [bytes, file] = content_of_uri(uri, path_, place);
    if (bytes)
        return std::move(*bytes);
    files_.push_back(file);
    check_outside(file, place, "buffer");
    const std::uint64_t length = document_.buffers[buffer].length;
    if (std::error_code error; is_input(file, InputKind::regular))
        ask(static_cast<double>(
            std::min<std::uint64_t>(std::filesystem::file_size(file, error), length)));
    return read_input(file, InputKind::regular, {}, length);
}

Elements::Elements(Buffers& buffers, std::size_t accessor)
    : accessor_(buffers.document().accessors[accessor]), number_(accessor), path_(buffers.path()),
      element_bytes_(accessor_.components * size_of(accessor_.component)) {
    if (accessor_.span) {
        const BufferView& view = buffers.document().views[accessor_.span->view];
        first_ = buffers.view(accessor_.span->view).data() + accessor_.span->offset;
        stride_ = view.stride > 0 ? view.stride : element_bytes_;
    }
    if (!accessor_.sparse)
        return;
    const Accessor::Sparse& sparse = *accessor_.sparse;
    const char* const indices = buffers.view(sparse.indices.view).data() + sparse.indices.offset;
    sparse_values_ = buffers.view(sparse.values.view).data() + sparse.values.offset;
    for (std::size_t k = 0; k < sparse.count; ++k) {
        const double index =
            number_at(indices + k * size_of(sparse.index_component), sparse.index_component, false);
        const double low = k > 0 ? sparse_.back() + 1.0 : 0.0;
        if (index < low || index >= double(accessor_.count))
            fail("expected sparse indices that ascend and are below " +
                 std::to_string(accessor_.count) + ", found " +
                 std::to_string(static_cast<std::uint64_t>(index)));
        sparse_.push_back(static_cast<std::uint32_t>(index));
    }
}

void Elements::fail(const std::string& message) const {
    throw InputError(path_, "/accessors/" + std::to_string(number_) + ": " + message);
}

void Elements::check(const char* type, std::initializer_list<Component> components) const {
    if (accessor_.type != type)
        fail(std::string("expected the type ") + type + ", found " + accessor_.type);
    if (std::ranges::find(components, accessor_.component) == components.end())
        fail("expected another componentType, found " +
             std::to_string(static_cast<unsigned>(accessor_.component)));
}

/// Returns where an element begins; nullptr for zeros.
const char* Elements::place_of(std::size_t element) const {
    if (!sparse_.empty()) {
        const auto found = std::ranges::lower_bound(sparse_, element);
        if (found != sparse_.end() && *found == element)
            return sparse_values_ +
                   static_cast<std::size_t>(found - sparse_.begin()) * element_bytes_;
    }
    return first_ ? first_ + element * stride_ : nullptr;
}

double Elements::at(std::size_t element, std::size_t component) const {
    const char* const place = place_of(element);
    return place ? number_at(place + component * size_of(accessor_.component), accessor_.component,
                             accessor_.normalized)
                 : 0;
}

std::string Elements::bytes_at(std::size_t element) const {
    const char* const place = place_of(element);
    return place ? std::string(place, element_bytes_) : std::string(element_bytes_, '\0');
}

std::uint32_t Elements::whole_at(std::size_t element) const {
    const char* const place = place_of(element);
    return place ? static_cast<std::uint32_t>(number_at(place, accessor_.component, false)) : 0;
}

} // namespace hemilux::gltf
