#include "io/files/input_file.h"

#include "io/files/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/vfs.h>
#endif

namespace hemilux {
namespace {

/// Such files are regular by their type, but some have no end, or reading them waits.
bool is_made_by_kernel([[maybe_unused]] const std::string& path) {
#if defined(__linux__)
    // proc, sysfs, debugfs, tracefs, securityfs and cgroup2, as linux/magic.h has them.
    constexpr std::array<std::int64_t, 6> kinds{0x9fa0,     0x62656572, 0x64626720,
                                                0x74726163, 0x73636673, 0x63677270};
    struct statfs status {};
    return ::statfs(path.c_str(), &status) == 0 &&
           std::ranges::find(kinds, static_cast<std::int64_t>(status.f_type)) != kinds.end();
#else
    return false;
#endif
}

[[noreturn]] void fail_to_read(const std::string& path) {
    throw InputError(path, std::string("cannot read: ") + std::strerror(errno));
}

void check_type(const std::string& path, mode_t mode, InputKind kind) {
    if (S_ISREG(mode) || (S_ISFIFO(mode) && kind == InputKind::stream))
        return;
    const char* const type = S_ISDIR(mode)    ? "directory"
                             : S_ISFIFO(mode) ? "pipe"
                             : S_ISSOCK(mode) ? "socket"
                                              : "device";
    throw InputError(path, std::string("expected a file, this is a ") + type +
                               (kind == InputKind::regular ? " and no regular file" : ""));
}

/// Closes itself.
class Descriptor {
  public:
    explicit Descriptor(const std::string& path)
        : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY)) {
        if (number_ < 0)
            fail_to_read(path);
    }
    ~Descriptor() { ::close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

} // namespace

void check_input(const std::string& path, InputKind kind) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        fail_to_read(path);
    check_type(path, status.st_mode, kind);
    if (S_ISREG(status.st_mode) && is_made_by_kernel(path))
        throw InputError(path, "expected a file, this is an interface of the kernel");
}

bool is_input(const std::string& path, InputKind kind) {
    try {
        check_input(path, kind);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::string read_input(const std::string& path, InputKind kind, const InputCheck& check) {
    check_input(path, kind);
    const Descriptor file(path);
    struct stat status {};
    if (::fstat(file.number(), &status) != 0)
        fail_to_read(path);
    check_type(path, status.st_mode, kind);             // it may have been replaced since
    constexpr std::size_t least = std::size_t{1} << 14; // most files are small
    constexpr std::size_t most = std::size_t{1} << 24;
    std::string content;
    std::size_t used = 0;
    for (;;) {
        if (used == content.size())
            content.resize(used + std::clamp(used / 2, least, most));
        const ssize_t count = ::read(file.number(), content.data() + used, content.size() - used);
        if (count < 0 && errno != EINTR)
            fail_to_read(path);
        used += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        if (count == 0)
            break;
        if (check)
            check(std::string_view(content).substr(0, used));
    }
    content.resize(used);
    return content;
}

} // namespace hemilux
