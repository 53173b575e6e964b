#include "io/files/file_identity.h"

#include <filesystem>
#include <system_error>

#include <sys/stat.h>

namespace hemilux {

namespace fs = std::filesystem;

std::string creation_path(const std::string& path) {
    constexpr int max_links = 40; // as many as Linux follows
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
    if (::stat(path.c_str(), &status) == 0)
        return S_ISREG(status.st_mode) ? std::optional(identity("")) : std::nullopt;
    const fs::path created(creation_path(path));
    const std::string folder = created.parent_path().empty() ? "." : created.parent_path().string();
    if (::stat(folder.c_str(), &status) != 0 || created.filename().empty())
        return std::nullopt;
    return identity(created.filename().string());
}

} // namespace hemilux
