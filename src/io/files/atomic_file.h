#pragma once
// An output file that appears complete or not at all. It is written to a temporary file in the same
// folder, which takes the final name only when everything is in it.

#include "io/files/file_identity.h"
#include "io/files/temporary_file.h"

#include <atomic>
#include <string>
#include <string_view>

namespace hemilux {

class AtomicFile {
  public:
    /// Opens the temporary file. A path that names something other than a regular file (a pipe, a
    /// device) is written directly, and so is what this process has open (own_descriptor), behind
    /// what is there. A symbolic link stays one, and its target is replaced or made.
    /// A file that replaces another has its mode and, where the system allows it, its owner and
    /// group. Throws OutputError and, like `write` and `commit`, Interrupted (end_waits_on).
    explicit AtomicFile(const std::string& path);
    /// Removes what was written unless it was committed.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Throws OutputError.
    void write(std::string_view bytes);
    enum class Durable { no, yes };
    /// Gives the file its name; nothing can be written afterwards. With Durable::yes it is on the
    /// disk by then, so that not even a loss of power leaves less than the old file. Throws
    /// OutputError.
    void commit(Durable durable = Durable::no);

  private:
    void open_own(int descriptor);
    void open_pipe();
    void remove_temporary();
    void take_over_access() const;
    void flush();
    void write_all(std::string_view left);
    void sync_folder() const;
    [[noreturn]] void fail(const char* action) const;

    std::string path_;        ///< path as the user named it, for messages
    std::string target_;      ///< links resolved
    TemporaryFile temporary_; ///< its path is empty when written directly
    std::string buffer_;
    int descriptor_ = -1;
};

/// Returns why what this process has open takes no bytes: it is closed, open for reading alone, or
/// nobody reads the pipe. Empty where nothing is known against it.
[[nodiscard]] std::string why_unwritable(int descriptor);

/// Makes this process open and write no file from this call on: another process writes what this
/// one would.
void write_no_files();
/// Returns whether write_no_files() was called.
[[nodiscard]] bool writes_no_files();

/// Sets the flag that ends waits. Once it is true, a pipe whose reader takes nothing for a second
/// is given up: Interrupted is thrown. With nullptr, as at the start, pipes are waited for without
/// end.
void end_waits_on(const std::atomic<bool>* flag);

/// Waits until a pipe or file that is open takes more; false where the wait is given up. A pipe
/// then takes a line without a further wait.
[[nodiscard]] bool wait_until_writable(int descriptor);

/// Writes a whole file at once. Throws OutputError and Interrupted.
void write_atomically(const std::string& path, std::string_view content);

} // namespace hemilux
