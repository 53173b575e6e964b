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
    /// Gives the file its name; nothing can be written afterwards. Throws OutputError.
    void commit();

  private:
    void flush();
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
