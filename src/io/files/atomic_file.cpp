#include "io/files/atomic_file.h"

#include "io/files/error.h"
#include "io/files/file_identity.h"
#include "io/files/temporary_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hemilux {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = 1 << 16;

/// Removes stale temporary files, once for each folder.
void clean(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> cleaned;
    const std::lock_guard lock(mutex);
    if (cleaned.insert(folder).second)
        remove_stale_temporaries(folder);
}

bool is_pipe(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
}

/// Returns whether the descriptor itself must be used. Opened once more under its name, a socket is
/// refused and a file is written from its beginning, even where the shell appends to it.
bool is_written_as_it_is_open(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 &&
           (S_ISREG(status.st_mode) || S_ISSOCK(status.st_mode));
}

std::atomic<const std::atomic<bool>*> ends_waits{nullptr};
std::atomic<bool> no_files{false};

/// A wait for another process, in short pauses. A signal may reach any thread at any moment, so
/// only looking again and again never misses it.
class Wait {
  public:
    static constexpr int milliseconds = 20; ///< length of a pause

    /// Returns whether to give the wait up; it must be called before each pause.
    [[nodiscard]] bool is_over() {
        const std::atomic<bool>* const flag = ends_waits;
        return flag && *flag && pauses_after_signal_++ * milliseconds >= 1000;
    }

  private:
    int pauses_after_signal_ = 0;
};

} // namespace

void write_no_files() { no_files = true; }
bool writes_no_files() { return no_files; }

void end_waits_on(const std::atomic<bool>* flag) { ends_waits = flag; }

bool wait_until_writable(int descriptor) {
    pollfd pipe{.fd = descriptor, .events = POLLOUT, .revents = 0};
    for (Wait wait; ::poll(&pipe, 1, Wait::milliseconds) <= 0;)
        if (wait.is_over())
            return false;
    return true;
}

std::string why_unwritable(int descriptor) {
    const int flags = ::fcntl(descriptor, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
        return "is closed, or not open for writing";
    pollfd stream{.fd = descriptor, .events = POLLOUT, .revents = 0};
    if (::poll(&stream, 1, 0) > 0 && (stream.revents & POLLERR) != 0)
        return std::string("cannot write: ") + std::strerror(EPIPE);
    return {};
}

AtomicFile::AtomicFile(const std::string& path)
    : path_(path == standard_output ? "standard output" : path), target_(path) {
    if (no_files)
        return;
    if (const std::optional<int> own = own_descriptor(path)) {
        open_own(*own);
        return;
    }

    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status))
        throw OutputError(path, "is a folder");
    const bool is_new = status.type() == fs::file_type::not_found;
    if (is_new)
        target_ = creation_path(path);
    else if (fs::is_regular_file(status))
        target_ = fs::canonical(path, error).string();
    if (error && !is_new)
        throw OutputError(path, "cannot open: " + error.message());
    if (is_new || fs::is_regular_file(status)) {
        const fs::path folder = fs::path(target_).parent_path();
        clean(folder);
        temporary_ = is_new ? make_temporary(folder) : make_temporary(folder, 0600);
        descriptor_ = temporary_.descriptor;
    } else {
        open_pipe();
    }
    if (descriptor_ < 0)
        fail("open");
}

/// Opens once more what this process has open, so that waits for a reader can end. What cannot be
/// opened again is used as it is.
void AtomicFile::open_own(int descriptor) {
    if (const std::string reason = why_unwritable(descriptor); !reason.empty())
        throw OutputError(path_, reason);
    if (!is_written_as_it_is_open(descriptor))
        descriptor_ = ::open(("/dev/fd/" + std::to_string(descriptor)).c_str(),
                             O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0)
        descriptor_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0)
        fail("open");
}

/// Opens a pipe or a device. Waits until somebody reads from it.
void AtomicFile::open_pipe() {
    for (Wait wait;;) {
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
        if (descriptor_ >= 0 || (errno != ENXIO && errno != EINTR) || !is_pipe(target_))
            return;
        if (wait.is_over())
            throw Interrupted();
        ::poll(nullptr, 0, Wait::milliseconds);
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0)
        return;
    ::close(descriptor_);
    remove_temporary();
}

void AtomicFile::remove_temporary() {
    if (temporary_.path.empty())
        return;
    ::unlink(temporary_.path.c_str());
    forget_temporary(temporary_);
}

void AtomicFile::write(std::string_view bytes) {
    if (descriptor_ < 0)
        return;
    if (bytes.size() >= buffer_size) {
        flush();
        write_all(bytes);
        return;
    }
    buffer_ += bytes;
    if (buffer_.size() >= buffer_size)
        flush();
}

void AtomicFile::commit(Durable durable) {
    if (descriptor_ < 0)
        return;
    flush();
    take_over_access();
    const bool is_temporary = !temporary_.path.empty();
    if (durable == Durable::yes && is_temporary && ::fsync(descriptor_) != 0)
        fail("write");
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    const bool renamed =
        closed == 0 && (!is_temporary || ::rename(temporary_.path.c_str(), target_.c_str()) == 0);
    if (renamed) {
        forget_temporary(temporary_);
        if (durable == Durable::yes)
            sync_folder();
        return;
    }
    const int error = errno;
    remove_temporary();
    errno = error;
    fail(closed == 0 ? "rename" : "write");
}

/// Brings the new name to the disk too. Some file systems cannot do that for folders; the file
/// itself is safe then.
void AtomicFile::sync_folder() const {
    const std::string parent = fs::path(target_).parent_path().string();
    const int folder =
        ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0)
        return;
    ::fsync(folder);
    ::close(folder);
}

/// Takes over the mode, owner and group of the file that is replaced. The content is complete by
/// then, and until then only the user can read it. A group that cannot be kept gets no more rights
/// than all others.
void AtomicFile::take_over_access() const {
    struct stat old {};
    if (temporary_.path.empty() || ::stat(target_.c_str(), &old) != 0)
        return;
    constexpr mode_t all = 0777, group = 0070, others = 0007;
    mode_t mode = old.st_mode & all;
    if (::fchown(descriptor_, old.st_uid, old.st_gid) != 0 &&
        ::fchown(descriptor_, static_cast<uid_t>(-1), old.st_gid) != 0)
        mode &= ~group | (mode & others) << 3;
    (void)::fchmod(descriptor_, mode);
}

void AtomicFile::flush() {
    write_all(buffer_);
    buffer_.clear();
}

void AtomicFile::write_all(std::string_view left) {
    while (!left.empty()) {
        const ssize_t written = ::write(descriptor_, left.data(), left.size());
        if (written >= 0) {
            left.remove_prefix(static_cast<std::size_t>(written));
        } else if (errno == EAGAIN) {
            if (!wait_until_writable(descriptor_))
                throw Interrupted();
        } else if (errno != EINTR) {
            fail("write");
        }
    }
}

void AtomicFile::fail(const char* action) const {
    throw OutputError(path_, std::string("cannot ") + action + ": " + std::strerror(errno));
}

void write_atomically(const std::string& path, std::string_view content) {
    AtomicFile file(path);
    file.write(content);
    file.commit();
}

} // namespace hemilux
