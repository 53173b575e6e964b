#include "app/settings/outputs.h"

#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/printable.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <unistd.h>
#include <utility>

namespace hemilux {

namespace fs = std::filesystem;

std::optional<Output> parse_output(std::string_view path) {
    static constexpr auto kinds =
        std::to_array<std::pair<std::string_view, OutputKind>>({{".png", OutputKind::png},
                                                                {".hdr", OutputKind::hdr},
                                                                {".exr", OutputKind::exr},
                                                                {".ply", OutputKind::ply},
                                                                {".glb", OutputKind::glb},
                                                                {".vtu", OutputKind::vtu},
                                                                {".csv", OutputKind::csv},
                                                                {".json", OutputKind::json}});
    const fs::path name(path);
    const bool is_stream = name.stem() == standard_output && !name.has_parent_path();
    const std::string extension =
        path == standard_output ? ".csv" : extension_of(std::string(path));
    for (const auto& [known, kind] : kinds)
        if (extension == known)
            return Output{std::string(is_stream ? standard_output : path), kind};
    return std::nullopt;
}

std::string lightmap_path(const std::string& glb) {
    return fs::path(glb).replace_extension(".lightmap.exr").string();
}

std::string lightmap_path(const std::string& glb, const std::string& object) {
    return fs::path(glb).replace_extension("." + object + ".lightmap.exr").string();
}

void check_writable(const std::string& path) {
    if (writes_no_files())
        return;
    if (const std::optional<int> own = own_descriptor(path)) {
        if (const std::string reason = why_unwritable(*own); !reason.empty())
            throw OutputError(path == standard_output ? "standard output" : path, reason);
        return;
    }
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status))
        throw OutputError(path, "is a folder");
    if (fs::is_socket(status) || fs::is_block_file(status))
        throw OutputError(path, "is a socket or a disk; expected a file, a pipe or a terminal");
    if (!fs::exists(status) && status.type() != fs::file_type::not_found)
        throw OutputError(path, "cannot be made: " + error.message());
    if (fs::exists(status) && access(path.c_str(), W_OK) != 0)
        throw OutputError(path, std::string("cannot be replaced: ") + std::strerror(errno));
    if (fs::exists(status) && !fs::is_regular_file(status))
        return; // is not replaced
    const fs::path target =
        fs::exists(status) ? fs::canonical(path, error) : fs::path(creation_path(path));
    const fs::path parent = target.parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder, error))
        throw OutputError(path, "the folder '" + folder + "' does not exist");
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw OutputError(path,
                          "cannot write to the folder '" + folder + "': " + std::strerror(errno));
}

namespace {

/// Returns whether a name is like room-0012.png of room.png: the stem with a dash, digits, the
/// extension.
bool has_step_name(std::string_view name, std::string_view stem, std::string_view extension) {
    constexpr std::size_t min_digits = 4;
    if (!name.starts_with(stem) || !name.ends_with(extension) ||
        name.size() < stem.size() + extension.size() + min_digits)
        return false;
    name.remove_prefix(stem.size());
    name.remove_suffix(extension.size());
    return std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

bool same_name(const std::string& a, const std::string& b) {
    return fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

} // namespace

void RunFiles::write(const std::string& role, const std::string& path) {
    const Entry entry{role, path, identity_of(path)};
    check(entry);
    written_.push_back(entry);
}

void RunFiles::write_steps(const std::string& path) {
    const fs::path whole(path);
    const fs::path folder = whole.parent_path();
    const std::string stem = whole.stem().string() + "-", extension = whole.extension().string();
    std::set<std::string> names; // of files, and of outputs to come
    for (const Entry& entry : written_)
        names.insert(fs::path(creation_path(entry.path)).filename().string());
    std::error_code error;
    fs::directory_iterator file(folder.empty() ? "." : folder, error);
    for (; !error && file != fs::directory_iterator(); file.increment(error))
        names.insert(file->path().filename().string());
    for (const std::string& name : names)
        if (has_step_name(name, stem, extension))
            write("picture of a step", (folder / name).string());
}

void RunFiles::read(const std::string& role, const std::string& path) const {
    check({role, path, identity_of(path)});
}

void RunFiles::check(const Entry& added) const {
    for (const Entry& entry : written_)
        if ((entry.identity && entry.identity == added.identity) ||
            same_name(entry.path, added.path))
            throw UsageError(single_line("the " + added.role + " '" + added.path + "' and the " +
                                         entry.role + " '" + entry.path +
                                         "' are one file, named twice"));
}

RunFiles check_files(const std::vector<std::string>& outputs, const std::string& scene) {
    RunFiles files;
    for (const std::string& path : outputs)
        files.write("output", path);
    files.read("scene", scene);
    for (const std::string& path : outputs)
        check_writable(path);
    return files;
}

} // namespace hemilux
