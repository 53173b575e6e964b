#include "app/outputs.h"

#include "app/exit_code.h"
#include "io/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>
#include <utility>

namespace hemilux {

namespace fs = std::filesystem;

std::optional<Output> parse_output(std::string_view path) {
    static constexpr auto kinds =
        std::to_array<std::pair<std::string_view, OutputKind>>({{".png", OutputKind::png},
                                                                {".hdr", OutputKind::hdr},
                                                                {".ply", OutputKind::ply},
                                                                {".csv", OutputKind::csv},
                                                                {".json", OutputKind::json}});
    std::string extension = fs::path(path).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const auto& [known, kind] : kinds)
        if (extension == known)
            return Output{std::string(path), kind};
    return std::nullopt;
}

void check_writable(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        throw OutputError(path, "is a folder");
    const fs::path parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder, ignored))
        throw OutputError(path, "the folder '" + folder + "' does not exist");
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw OutputError(path,
                          "cannot write to the folder '" + folder + "': " + std::strerror(errno));
    if (fs::exists(path, ignored) && access(path.c_str(), W_OK) != 0)
        throw OutputError(path, std::string("cannot be replaced: ") + std::strerror(errno));
}

void check_distinct(std::span<const std::string> paths) {
    for (std::size_t i = 0; i < paths.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (fs::absolute(paths[i]).lexically_normal() ==
                fs::absolute(paths[j]).lexically_normal())
                throw UsageError("the file '" + paths[i] + "' is named twice");
}

} // namespace hemilux
