#include "io/files/file_identity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hemilux {
namespace {

namespace fs = std::filesystem;

constexpr int max_links = 40; // as many as Linux follows

/// Returns the folders whose entries are the descriptors of this process.
std::array<fs::path, 2> folders_of_descriptors() {
    std::error_code error;
    return {fs::canonical("/proc/self/fd", error), fs::canonical("/dev/fd", error)};
}

std::optional<int> whole_number(const std::string& text) {
    int number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end && number >= 0 ? std::optional(number)
                                                              : std::nullopt;
}

/// Returns whether what is written there can be read again or reaches a reader.
bool keeps_what_is_written(const struct stat& status, const std::string& path) {
    if (S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode))
        return true;
    if (!S_ISCHR(status.st_mode))
        return false;
    const int device = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    const bool is_terminal = device >= 0 && ::isatty(device) == 1;
    if (device >= 0)
        ::close(device);
    return is_terminal;
}

} // namespace

std::optional<int> own_descriptor(const std::string& path) {
    if (path == standard_output)
        return STDOUT_FILENO;
    const std::array<fs::path, 2> folders = folders_of_descriptors();
    std::error_code error;
    fs::path at(path);
    for (int links = 0; links < max_links; ++links) {
        const fs::path folder =
            fs::canonical(at.has_parent_path() ? at.parent_path() : fs::path("."), error);
        if (!error && std::ranges::find(folders, folder) != folders.end())
            return whole_number(at.filename().string());
        const fs::path target = fs::read_symlink(at, error);
        if (error)
            return std::nullopt;
        at = at.parent_path() / target;
    }
    return std::nullopt;
}

std::string creation_path(const std::string& path) {
    std::error_code error;
    fs::path at(path);
    for (int links = 0; links < max_links && !fs::exists(at, error); ++links) {
        const fs::path target = fs::read_symlink(at, error);
        if (error)
            return at.string();
        at = at.parent_path() / target;
    }
    return path;
}

bool is_same_stream(const std::string& a, const std::string& b) {
    struct stat of_a {};
    struct stat of_b {};
    return ::stat(a.c_str(), &of_a) == 0 && ::stat(b.c_str(), &of_b) == 0 &&
           !S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

std::optional<FileIdentity> identity_of(const std::string& path) {
    struct stat status {};
    const auto identity = [&status](const std::string& name) {
        return FileIdentity{std::uint64_t{status.st_dev}, std::uint64_t{status.st_ino}, name};
    };
    const std::optional<int> own = own_descriptor(path);
    const std::string open_path = own ? "/dev/fd/" + std::to_string(*own) : path;
    if (own ? ::fstat(*own, &status) == 0 : ::stat(path.c_str(), &status) == 0)
        return keeps_what_is_written(status, open_path) ? std::optional(identity(""))
                                                        : std::nullopt;
    if (own)
        return std::nullopt;
    const fs::path created(creation_path(path));
    const std::string folder = created.parent_path().empty() ? "." : created.parent_path().string();
    if (::stat(folder.c_str(), &status) != 0 || created.filename().empty())
        return std::nullopt;
    return identity(created.filename().string());
}

} // namespace hemilux
