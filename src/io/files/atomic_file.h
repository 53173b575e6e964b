#pragma once
// An output file that appears complete or not at all: it is written to a temporary file in the same
// folder, which takes the final name only when everything is on it.

#include <atomic>
#include <string>
#include <string_view>

namespace hemilux {

/// The path that stands for standard output, which is written directly.
inline constexpr std::string_view standard_output = "-";

class AtomicFile {
  public:
    /// Opens the temporary file. A path that names something else than a regular file (a pipe, a
    /// device) is written directly. A symbolic link stays one, and its target is replaced or made.
    /// A file that replaces another has its mode and, where the system allows it, its owner and
    /// group. Throws OutputError, and like `write` and `commit` Interrupted (end_waits_on).
    explicit AtomicFile(const std::string& path);
    /// Removes what was written unless it was committed.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Throws OutputError.
    void write(std::string_view bytes);
    enum class Durable { no, yes };
    /// Gives the file its name; nothing can be written afterwards. Durable: it is on the disk by
    /// then, so that not even a loss of power leaves less than the old file. Throws OutputError.
    void commit(Durable durable = Durable::no);

  private:
    void open_pipe();
    void take_over_access() const;
    void flush();
    void sync_folder() const;
    [[noreturn]] void fail(const char* action) const;

    std::string path_;      ///< as the user named it, for messages
    std::string target_;    ///< links resolved
    std::string temporary_; ///< empty when written directly
    std::string buffer_;
    int descriptor_ = -1;
};

/// From now on no file is opened or written: another process writes what this one would.
void write_no_files();
/// Whether that was asked for.
[[nodiscard]] bool writes_no_files();

/// Once the flag is set, a pipe whose reader takes nothing for a second is given up: Interrupted is
/// thrown. nullptr: pipes are waited for without end, as at the start.
void end_waits_on(const std::atomic<bool>* flag);

/// Whether a pipe or file that is open takes more; waits for it, and is false where that is given
/// up. A pipe then takes a line without a further wait.
[[nodiscard]] bool wait_until_writable(int descriptor);

/// Writes a whole file at once. Throws OutputError and Interrupted.
void write_atomically(const std::string& path, std::string_view content);

} // namespace hemilux
