#pragma once
// A ZIP archive whose files are stored as they are (PKWARE, APPNOTE.TXT 6.3, version 4.5 with
// ZIP64 where a size or place needs it). NumPy reads one with .npy files as an .npz.

#include "io/files/atomic_file.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

class StoredZip {
  public:
    /// Throws OutputError, as all functions do.
    explicit StoredZip(const std::string& path) : file_(path) {}

    using Sink = std::function<void(std::string_view part)>;
    /// Adds a file of the parts that `give` passes to a sink. It is called twice, as the checksum
    /// comes before the parts, and gives the same both times.
    void add_given(const std::string& name, const std::function<void(const Sink& sink)>& give);
    /// Adds a file of these parts, one after the other.
    void add(const std::string& name, const std::vector<std::string_view>& parts) {
        add_given(name, [&](const Sink& sink) { std::ranges::for_each(parts, sink); });
    }
    /// Writes the directory and gives the archive its name; nothing can be added afterwards.
    void commit();

  private:
    struct Entry {
        std::string name;
        std::uint32_t checksum;
        std::uint64_t size, place;
    };
    void write(std::string_view bytes);

    AtomicFile file_;
    std::uint64_t written_ = 0;
    std::vector<Entry> entries_;
};

} // namespace hemilux
