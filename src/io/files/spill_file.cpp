#include "io/files/spill_file.h"

#include "io/files/error.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace hemilux {
namespace {

/// The file grows by multiples of this size, which is itself a multiple of the page's size.
constexpr std::size_t growth = std::size_t{1} << 26;

/// Returns the class of a block's size. There are four classes between two powers of two, so up to
/// a quarter of a block may be left empty.
constexpr std::size_t size_class(std::size_t bytes) {
    const auto power = static_cast<std::size_t>(std::bit_width(bytes - 1)) - 1;
    return 4 * power + ((bytes - 1) >> (power - 2)) - 4;
}
constexpr std::size_t size_of_class(std::size_t index) {
    return (5 + index % 4) << (index / 4 - 2);
}
static_assert(size_of_class(size_class(1025)) == 1280 && size_of_class(size_class(1281)) == 1536);

/// All sizes above it are multiples of the alignment.
constexpr std::size_t least_size = 4 * alignof(std::max_align_t) + 1;
constexpr std::size_t classes = size_class(std::size_t{1} << 42) + 1;

std::string text_of(int error) { return std::system_category().message(error); }

} // namespace

/// The header in front of a block's bytes.
struct alignas(std::max_align_t) SpillFile::Block {
    std::size_t size_class;
    Block* next_free;
};

SpillFile::SpillFile(const std::string& folder) : folder_(folder), free_(classes) {
    std::string path = folder + "/.hemilux-spill-XXXXXX";
    descriptor_ = mkostemp(path.data(), O_CLOEXEC);
    if (descriptor_ < 0)
        throw OutputError(folder, "--spill cannot make a file there: " + text_of(errno));
    unlink(path.c_str());
    void* const space =
        mmap(nullptr, address_space, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (space == MAP_FAILED) {
        const int error = errno;
        close(descriptor_);
        throw OutputError(folder, "--spill finds no addresses: " + text_of(error));
    }
    begin_ = static_cast<std::byte*>(space);
}

SpillFile::~SpillFile() {
    munmap(begin_, address_space);
    close(descriptor_);
}

void* SpillFile::allocate(std::size_t bytes) {
    const std::size_t index = size_class(std::max(bytes + sizeof(Block), least_size));
    if (index >= classes)
        throw std::bad_alloc();
    const std::lock_guard lock(mutex_);
    Block* block = free_[index];
    if (block)
        free_[index] = block->next_free;
    else {
        const std::size_t end = used_ + size_of_class(index);
        if (end > size_)
            grow_to((end + growth - 1) / growth * growth);
        block = new (begin_ + std::exchange(used_, end)) Block{index, nullptr};
    }
    return block + 1;
}

void SpillFile::free(void* block) noexcept {
    Block* const freed = static_cast<Block*>(block) - 1;
    const std::lock_guard lock(mutex_);
    freed->next_free = std::exchange(free_[freed->size_class], freed);
}

std::uint64_t SpillFile::bytes() const {
    const std::lock_guard lock(mutex_);
    return size_;
}

/// Makes the disk give its room here, not when a page is written: a failure could not be reported
/// then.
void SpillFile::grow_to(std::size_t end) {
    const auto at = static_cast<off_t>(size_), more = static_cast<off_t>(end - size_);
    int error = EFBIG;
    if (end <= address_space)
        while ((error = posix_fallocate(descriptor_, at, more)) == EINTR) {
        }
    if (error == 0 && mmap(begin_ + at, end - size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED,
                           descriptor_, at) == MAP_FAILED)
        error = errno;
    if (error != 0)
        throw SpillError(folder_ + ": no room for more than " + std::to_string(size_ >> 20) +
                         " MiB of --spill: " + text_of(error));
    size_ = end;
}

} // namespace hemilux
