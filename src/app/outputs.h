#pragma once
// Where results go. Each file is checked before the work begins, so that an hour of computing is
// not lost to a mistyped folder.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hemilux {

enum class OutputKind { png, hdr, ply, csv, json };

/// A file that the user asked for.
struct Output {
    std::string path;
    OutputKind kind;
};

[[nodiscard]] constexpr bool is_picture(OutputKind kind) {
    return kind == OutputKind::png || kind == OutputKind::hdr;
}

/// By the extension of the path, in small or capital letters; empty where it is none of ours.
[[nodiscard]] std::optional<Output> parse_output(std::string_view path);

/// Throws OutputError where no file can be made or replaced at the path.
void check_writable(const std::string& path);

/// Throws UsageError where two of the paths name the same file.
void check_distinct(std::span<const std::string> paths);

} // namespace hemilux
