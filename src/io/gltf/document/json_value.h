#pragma once
// JSON that is read with its path in mind. Whatever is missing or of another kind than expected is
// an InputError such as "room.gltf: /accessors/3/count: expected a whole number from 1 to 12, found
// 40".

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux::gltf {

/// The bound of a whole number that may be any: doubles hold all up to it.
inline constexpr std::size_t no_limit = std::size_t{1} << 53;

/// A value within a document.
class JsonValue {
  public:
    JsonValue(const nlohmann::json& node, const std::string& file, std::string path)
        : node_(&node), file_(&file), path_(std::move(path)) {}

    /// Throws the error of this value.
    [[noreturn]] void fail(const std::string& message) const;

    /// Returns the member of an object; empty where there is none.
    [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const;
    [[nodiscard]] JsonValue at(std::string_view key) const;
    /// Returns the elements of an array.
    [[nodiscard]] std::vector<JsonValue> elements() const;

    /// Returns a text; its control characters are replaced by a mark (single_line, printable.h).
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool flag() const;
    /// Returns a finite number whose absolute value is at most `largest_number` (text_words.h).
    [[nodiscard]] double number() const;
    /// Returns a whole number from `low` to `high`.
    [[nodiscard]] std::size_t whole(std::size_t low, std::size_t high) const;
    /// Returns an index into an array of `count` elements; `of` says of what, for messages.
    [[nodiscard]] std::size_t index(std::size_t count, const char* of) const;
    /// Reads an array of just so many numbers.
    void numbers(std::span<double> values) const;

    /// These read members that may be missing.
    [[nodiscard]] std::vector<JsonValue> elements_of(std::string_view key) const;
    [[nodiscard]] std::string text_or(std::string_view key, std::string otherwise) const;
    [[nodiscard]] bool flag_or(std::string_view key, bool otherwise) const;
    [[nodiscard]] double number_or(std::string_view key, double otherwise) const;
    [[nodiscard]] std::size_t whole_or(std::string_view key, std::size_t otherwise,
                                       std::size_t high) const;
    [[nodiscard]] std::optional<std::size_t> index_in(std::string_view key, std::size_t count,
                                                      const char* of) const;
    void numbers_of(std::string_view key, std::span<double> values) const;
    /// Returns the extension of this name.
    [[nodiscard]] std::optional<JsonValue> extension(std::string_view name) const;

  private:
    [[nodiscard]] JsonValue child(const nlohmann::json& node, std::string_view name) const;
    [[noreturn]] void fail_kind(const char* expected) const;

    const nlohmann::json* node_;
    const std::string* file_;
    std::string path_;
};

/// A JSON text that was read.
class JsonDocument {
  public:
    /// Throws InputError with the line for what is no JSON. `file` is for messages.
    JsonDocument(std::string_view text, std::string file);
    ~JsonDocument();
    JsonDocument(const JsonDocument&) = delete;
    JsonDocument& operator=(const JsonDocument&) = delete;

    [[nodiscard]] JsonValue root() const;

    /// The bytes that a character of JSON takes at most, about, once it is read.
    static constexpr double bytes_per_character = 40;

  private:
    std::string file_;
    std::unique_ptr<nlohmann::json> json_;
};

} // namespace hemilux::gltf
