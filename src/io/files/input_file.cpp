#include "io/files/input_file.h"

#include "io/files/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/vfs.h>
#endif

namespace hemilux {
namespace {

/// Returns whether the kernel makes up the file. Such files are regular by their type, but some
/// have no end, or reading them waits.
bool is_made_by_kernel([[maybe_unused]] const std::string& path) {
#if defined(__linux__)
    // These are proc, sysfs, debugfs, tracefs, securityfs and cgroup2, as linux/magic.h has them.
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

/// A file or pipe that is open. It waits for what the writer of a pipe has still to say, but only
/// two seconds for a writer to come: there may never be one.
class Source {
  public:
    explicit Source(const std::string& path)
        : path_(path), number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK)) {
        if (number_ < 0)
            fail_to_read(path);
    }
    ~Source() { ::close(number_); }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    /// Returns the bytes that there are to be read; none where that is not known.
    std::optional<std::uint64_t> check(InputKind kind) {
        struct stat status {};
        if (::fstat(number_, &status) != 0)
            fail_to_read(path_);
        check_type(path_, status.st_mode, kind);
        waits_for_writer_ = S_ISFIFO(status.st_mode);
        return S_ISREG(status.st_mode) ? std::optional(static_cast<std::uint64_t>(status.st_size))
                                       : std::nullopt;
    }
    /// Returns the number of bytes read; 0 at the end.
    std::size_t read(char* to, std::size_t size) {
        for (;;) {
            const ssize_t count = ::read(number_, to, size);
            if (count == 0 && waits_for_writer_) {
                wait_for_writer();
                continue;
            }
            if (count >= 0) {
                waits_for_writer_ = false;
                return static_cast<std::size_t>(count);
            }
            if (errno == EAGAIN) { // there is a writer
                waits_for_writer_ = false;
                pollfd bytes{.fd = number_, .events = POLLIN, .revents = 0};
                ::poll(&bytes, 1, -1);
            } else if (errno != EINTR)
                fail_to_read(path_);
        }
    }

  private:
    void wait_for_writer() {
        constexpr int patience = 2000, step = 10; // milliseconds
        if (waited_ >= patience)
            throw InputError(path_, "expected a file, this is a pipe that nobody writes to");
        ::poll(nullptr, 0, step);
        waited_ += step;
    }

    const std::string& path_;
    int number_;
    bool waits_for_writer_ = false;
    int waited_ = 0;
};

InputGuard& input_guard() {
    static InputGuard guard;
    return guard;
}

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

void guard_inputs(InputGuard guard) { input_guard() = std::move(guard); }

void ask_for_input(const std::string& path, double bytes) {
    if (input_guard())
        input_guard()(path, bytes);
}

/// A file's first bytes are looked at before memory is taken for all of them: what they are may end
/// the reading. Of a pipe nobody knows the length, so its text grows by being copied.
std::string read_input(const std::string& path, InputKind kind, const InputCheck& check,
                       std::uint64_t most) {
    check_input(path, kind);
    Source source(path);
    const std::optional<std::uint64_t> size = source.check(kind); // it may have been replaced since
    constexpr std::size_t least = std::size_t{1} << 14;           // most files are small
    constexpr std::size_t piece = std::size_t{1} << 24;
    if (size)
        ask_for_input(path, static_cast<double>(std::min(*size, most)));
    std::string content;
    std::size_t used = 0;
    while (used < most) {
        if (used == content.size()) {
            if (used == least && size && *size > least)
                content.reserve(static_cast<std::size_t>(std::min(*size + 1, most)));
            const std::size_t next = used + static_cast<std::size_t>(std::min<std::uint64_t>(
                                                std::clamp(used / 2, least, piece), most - used));
            if (next > content.capacity() && next > least)
                ask_for_input(path, static_cast<double>(used + next));
            content.resize(next);
        }
        const std::size_t count = source.read(content.data() + used, content.size() - used);
        used += count;
        if (count == 0)
            break;
        if (check)
            check(std::string_view(content).substr(0, used));
    }
    content.resize(used);
    return content;
}

} // namespace hemilux
