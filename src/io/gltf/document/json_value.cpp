#include "io/gltf/document/json_value.h"

#include "io/files/error.h"
#include "io/files/printable.h"
#include "io/files/text_words.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace hemilux::gltf {
namespace {

/// Returns a value as words for a message.
std::string text_of(const nlohmann::json& node) {
    constexpr std::size_t longest = 40;
    if (node.is_object())
        return "an object";
    if (node.is_array())
        return "an array of " + std::to_string(node.size());
    return shortened(node.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace), longest);
}

} // namespace

void JsonValue::fail(const std::string& message) const {
    throw InputError(*file_, (path_.empty() ? "/" : path_) + ": " + message);
}

void JsonValue::fail_kind(const char* expected) const {
    fail(std::string("expected ") + expected + ", found " + text_of(*node_));
}

JsonValue JsonValue::child(const nlohmann::json& node, std::string_view name) const {
    return {node, *file_, path_ + "/" + std::string(name)};
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
    if (!node_->is_object())
        fail_kind("an object");
    const auto found = node_->find(key);
    return found == node_->end() ? std::nullopt : std::optional(child(*found, key));
}

JsonValue JsonValue::at(std::string_view key) const {
    std::optional<JsonValue> found = find(key);
    if (!found)
        fail("expected a member \"" + std::string(key) + "\", there is none");
    return *found;
}

std::vector<JsonValue> JsonValue::elements() const {
    if (!node_->is_array())
        fail_kind("an array");
    std::vector<JsonValue> values;
    values.reserve(node_->size());
    for (const nlohmann::json& element : *node_)
        values.push_back(child(element, std::to_string(values.size())));
    return values;
}

std::string JsonValue::text() const {
    if (!node_->is_string())
        fail_kind("a text");
    return single_line(node_->get_ref<const std::string&>());
}

bool JsonValue::flag() const {
    if (!node_->is_boolean())
        fail_kind("true or false");
    return node_->get<bool>();
}

double JsonValue::number() const {
    if (!node_->is_number())
        fail_kind("a number");
    const auto value = node_->get<double>();
    if (!(std::abs(value) <= largest_number))
        fail_kind("a number whose absolute value is at most 1e100");
    return value;
}

std::size_t JsonValue::whole(std::size_t low, std::size_t high) const {
    const double value = node_->is_number() ? node_->get<double>() : -1;
    const bool is_whole = value >= 0 && value <= double(no_limit) && std::floor(value) == value;
    if (!is_whole || value < double(low) || value > double(high))
        fail_kind(("a whole number " +
                   (high < no_limit ? "from " + std::to_string(low) + " to " + std::to_string(high)
                                    : "of at least " + std::to_string(low)))
                      .c_str());
    return static_cast<std::size_t>(value);
}

std::size_t JsonValue::index(std::size_t count, const char* of) const {
    if (count == 0)
        fail(std::string("expected no index, as there are no ") + of + ", found " +
             text_of(*node_));
    return whole(0, count - 1);
}

void JsonValue::numbers(std::span<double> values) const {
    if (!node_->is_array() || node_->size() != values.size())
        fail_kind(("an array of " + std::to_string(values.size()) + " numbers").c_str());
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = child((*node_)[k], std::to_string(k)).number();
}

std::vector<JsonValue> JsonValue::elements_of(std::string_view key) const {
    const std::optional<JsonValue> found = find(key);
    return found ? found->elements() : std::vector<JsonValue>{};
}

std::string JsonValue::text_or(std::string_view key, std::string otherwise) const {
    const std::optional<JsonValue> found = find(key);
    return found ? found->text() : std::move(otherwise);
}

bool JsonValue::flag_or(std::string_view key, bool otherwise) const {
    const std::optional<JsonValue> found = find(key);
    return found ? found->flag() : otherwise;
}

double JsonValue::number_or(std::string_view key, double otherwise) const {
    const std::optional<JsonValue> found = find(key);
    return found ? found->number() : otherwise;
}

std::size_t JsonValue::whole_or(std::string_view key, std::size_t otherwise,
                                std::size_t high) const {
    const std::optional<JsonValue> found = find(key);
    return found ? found->whole(0, high) : otherwise;
}

std::optional<std::size_t> JsonValue::index_in(std::string_view key, std::size_t count,
                                               const char* of) const {
    const std::optional<JsonValue> found = find(key);
    return found ? std::optional(found->index(count, of)) : std::nullopt;
}

void JsonValue::numbers_of(std::string_view key, std::span<double> values) const {
    if (const std::optional<JsonValue> found = find(key))
        found->numbers(values);
}

std::optional<JsonValue> JsonValue::extension(std::string_view name) const {
    const std::optional<JsonValue> all = find("extensions");
    return all ? all->find(name) : std::nullopt;
}

JsonDocument::JsonDocument(std::string_view text, std::string file) : file_(std::move(file)) {
    try {
        json_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(text));
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t at = std::min(error.byte, text.size());
        const auto lines = std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
        std::string what = error.what();
        if (const std::size_t detail = what.find(": "); detail != std::string::npos)
            what.erase(0, detail + 2);
        throw InputError(file_, static_cast<std::size_t>(lines) + 1, "expected JSON, " + what);
    } catch (const nlohmann::json::exception& error) { // a number beyond doubles
        throw InputError(file_, std::string("expected JSON, ") + error.what());
    }
}

JsonDocument::~JsonDocument() = default;

JsonValue JsonDocument::root() const { return {*json_, file_, ""}; }

} // namespace hemilux::gltf
