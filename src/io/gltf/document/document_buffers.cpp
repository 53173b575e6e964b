// Buffers, their views and the accessors of these (sections 3.6.1 and 3.6.2).

#include "io/gltf/document/document.h"

#include <algorithm>
#include <utility>

namespace hemilux::gltf {
namespace {

/// Accessors without data are all zeros but for sparse elements. No model has many of these, and a
/// few characters could ask for any number.
constexpr std::size_t max_zeros = std::size_t{1} << 20;

struct ElementType {
    std::string_view name;
    std::size_t components, columns;
};
constexpr std::array<ElementType, 7> element_types{{{"SCALAR", 1, 1},
                                                    {"VEC2", 2, 1},
                                                    {"VEC3", 3, 1},
                                                    {"VEC4", 4, 1},
                                                    {"MAT2", 4, 2},
                                                    {"MAT3", 9, 3},
                                                    {"MAT4", 16, 4}}};

Component read_component(const JsonValue& value) {
    const std::size_t code = value.whole(0, no_limit);
    for (const Component known : {Component::int8, Component::uint8, Component::int16,
                                  Component::uint16, Component::uint32, Component::float32})
        if (code == static_cast<std::size_t>(known))
            return known;
    value.fail("expected 5120, 5121, 5122, 5123, 5125 or 5126, found " + std::to_string(code));
}

const ElementType& read_type(const JsonValue& value) {
    const std::string name = value.text();
    for (const ElementType& type : element_types)
        if (type.name == name)
            return type;
    value.fail("expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4, found \"" + name + "\"");
}

/// Each column of a matrix begins at a multiple of four bytes.
std::size_t element_size(const ElementType& type, Component component) {
    const std::size_t column = type.components / type.columns * size_of(component);
    return type.columns == 1 ? column : type.columns * ((column + 3) / 4 * 4);
}

/// Reads where `count` elements of this size lie; throws where they do not fit into their view.
Span read_span(const JsonValue& value, const Document& document, std::size_t element,
               const JsonValue& count) {
    Span span;
    span.view = value.at("bufferView").index(document.views.size(), "bufferViews");
    const BufferView& view = document.views[span.view];
    if (element > view.length)
        value.at("bufferView")
            .fail("expected a view of at least " + std::to_string(element) +
                  " bytes, one element, found " + std::to_string(view.length));
    span.offset = value.whole_or("byteOffset", 0, view.length - element);
    const std::size_t stride = view.stride > 0 ? view.stride : element;
    if (stride < element)
        value.at("bufferView")
            .fail("expected a byteStride of at least " + std::to_string(element) + ", found " +
                  std::to_string(stride));
    const std::size_t most = (view.length - element - span.offset) / stride + 1;
    if (const std::size_t n = count.whole(0, no_limit); n > most)
        count.fail("expected at most " + std::to_string(most) + ", as bufferView " +
                   std::to_string(span.view) + " has " + std::to_string(view.length) +
                   " bytes, found " + std::to_string(n));
    return span;
}

Accessor::Sparse read_sparse(const JsonValue& value, const Document& document,
                             const Accessor& accessor, std::size_t element) {
    Accessor::Sparse sparse;
    const JsonValue count = value.at("count");
    sparse.count = count.whole(1, accessor.count);
    const JsonValue indices = value.at("indices");
    sparse.index_component = read_component(indices.at("componentType"));
    if (sparse.index_component != Component::uint8 && sparse.index_component != Component::uint16 &&
        sparse.index_component != Component::uint32)
        indices.at("componentType").fail("expected 5121, 5123 or 5125");
    sparse.indices = read_span(indices, document, size_of(sparse.index_component), count);
    sparse.values = read_span(value.at("values"), document, element, count);
    return sparse;
}

Accessor read_accessor(const JsonValue& value, const Document& document) {
    Accessor accessor;
    accessor.component = read_component(value.at("componentType"));
    const ElementType& type = read_type(value.at("type"));
    accessor.type = type.name;
    accessor.components = type.components;
    accessor.normalized = value.flag_or("normalized", false);
    const JsonValue count = value.at("count");
    accessor.count = count.whole(1, no_limit);
    const std::size_t element = element_size(type, accessor.component);
    if (value.find("bufferView"))
        accessor.span = read_span(value, document, element, count);
    else if (accessor.count > max_zeros)
        count.fail("expected at most " + std::to_string(max_zeros) +
                   " where there is no bufferView, found " + std::to_string(accessor.count));
    if (const auto sparse = value.find("sparse"))
        accessor.sparse = read_sparse(*sparse, document, accessor, element);
    return accessor;
}

BufferView read_view(const JsonValue& value, const Document& document) {
    constexpr std::size_t min_stride = 4, max_stride = 252;
    BufferView view;
    view.buffer = value.at("buffer").index(document.buffers.size(), "buffers");
    const std::size_t bytes = document.buffers[view.buffer].length;
    view.offset = value.whole_or("byteOffset", 0, bytes);
    view.length = value.at("byteLength").whole(1, bytes - view.offset);
    if (const auto stride = value.find("byteStride"))
        view.stride = stride->whole(min_stride, max_stride);
    return view;
}

} // namespace

std::size_t size_of(Component component) {
    switch (component) {
    case Component::int8:
    case Component::uint8:
        return 1;
    case Component::int16:
    case Component::uint16:
        return 2;
    default:
        return 4;
    }
}

void read_buffers(const JsonValue& root, Document& document) {
    for (const JsonValue& value : root.elements_of("buffers"))
        document.buffers.push_back(
            {value.at("byteLength").whole(1, no_limit), value.text_or("uri", "")});
    for (const JsonValue& value : root.elements_of("bufferViews"))
        document.views.push_back(read_view(value, document));
    for (const JsonValue& value : root.elements_of("accessors"))
        document.accessors.push_back(read_accessor(value, document));
}

} // namespace hemilux::gltf
