#pragma once
// Memory that lies in a file: for arrays that are together larger than the machine's memory.
//
// The file is mapped: the system keeps in memory what is in use, and writes the rest to the disk.
// It loses its name as soon as it is made, so it is gone when the process ends, however that
// happens.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace hemilux {

/// The file system has no room for more.
class SpillError : public std::bad_alloc {
  public:
    explicit SpillError(const std::string& message)
        : message_(std::make_shared<const std::string>(message)) {}
    [[nodiscard]] const char* what() const noexcept override { return message_->c_str(); }

  private:
    std::shared_ptr<const std::string> message_; ///< copies of an exception must not fail
};

/// All functions may be called from any thread.
class SpillFile {
  public:
    /// Makes the file. Throws OutputError.
    explicit SpillFile(const std::string& folder);
    ~SpillFile();
    SpillFile(const SpillFile&) = delete;
    SpillFile& operator=(const SpillFile&) = delete;

    /// Returns a block of so many bytes, aligned as operator new aligns it. Its room on the disk is
    /// reserved: writing to it cannot fail. Throws SpillError.
    [[nodiscard]] void* allocate(std::size_t bytes);
    /// Frees a block, so that others may get it.
    void free(void* block) noexcept;
    [[nodiscard]] bool holds(const void* block) const noexcept {
        const auto* const byte = static_cast<const std::byte*>(block);
        return byte >= begin_ && byte < begin_ + address_space;
    }
    /// Returns the size of the file [bytes], which never shrinks.
    [[nodiscard]] std::uint64_t bytes() const;

  private:
    /// Addresses that the file may grow into: 4 TiB.
    static constexpr std::size_t address_space = std::size_t{1} << 42;
    struct Block;
    void grow_to(std::size_t end);

    std::string folder_;
    int descriptor_ = -1;
    std::byte* begin_ = nullptr;
    mutable std::mutex mutex_;
    std::size_t used_ = 0, size_ = 0; ///< of the file [bytes]
    std::vector<Block*> free_;        ///< by size_class(), the first of a list
};

} // namespace hemilux
