#pragma once
// An output file that appears complete or not at all: it is written to a temporary file in the same
// folder, which takes the final name only when everything is on it.

#include <string>
#include <string_view>

namespace hemilux {

class AtomicFile {
  public:
    /// Opens the temporary file. A path that names something else than a regular file (a pipe, a
    /// device) is written directly; a symbolic link keeps being one. Throws OutputError.
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
    void flush();
    void sync_folder() const;
    [[noreturn]] void fail(const char* action) const;

    std::string path_;      ///< as the user named it, for messages
    std::string target_;    ///< links resolved
    std::string temporary_; ///< empty when written directly
    std::string buffer_;
    int descriptor_ = -1;
};

/// All of a file's content at once. Throws OutputError.
void write_atomically(const std::string& path, std::string_view content);

} // namespace hemilux
