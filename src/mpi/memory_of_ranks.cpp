#include "mpi/memory_of_ranks.h"

#include <cstdint>
#include <fcntl.h>
#include <random>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace hemilux {
namespace {

/// A file that is open, which this closes.
class File {
  public:
    explicit File(int number) : number_(number) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (number_ >= 0)
            close(number_);
    }
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

/// The place where all ranks find the file of the first one. A process of another machine may have
/// the same number, so the file holds a word that no other file has.
struct Place {
    pid_t process;
    int file;
    std::uint64_t word;
};

std::uint64_t random_word() {
    std::random_device random;
    return std::uint64_t{random()} << 32 | random();
}

/// Makes a file in memory, without a name, which ends with the last process that has it. The word
/// stands behind its bytes.
int new_file(std::size_t bytes, std::uint64_t word) {
    const int file = memfd_create("hemilux", MFD_CLOEXEC);
    const auto size = static_cast<off_t>(bytes);
    if (posix_fallocate(file, 0, size) == 0)
        (void)!pwrite(file, &word, sizeof(word), size);
    return file;
}

int open_file(const Place& place) {
    const std::string path =
        "/proc/" + std::to_string(place.process) + "/fd/" + std::to_string(place.file);
    return open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
}

/// Maps the file into memory; null where that fails.
std::shared_ptr<std::byte> map(const File& file, std::size_t bytes) {
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.number(), 0);
    if (memory == MAP_FAILED)
        return nullptr;
    return {static_cast<std::byte*>(memory), [bytes](std::byte* of) { munmap(of, bytes); }};
}

} // namespace

std::shared_ptr<std::byte> memory_of_ranks(const Ranks& ranks, std::size_t bytes) {
    Place place{getpid(), -1, random_word()};
    const File of_first(ranks.is_first() ? new_file(bytes, place.word) : -1);
    place.file = of_first.number();
    place = ranks.of_first(place);
    const File file(open_file(place));
    std::uint64_t word = 0;
    const bool is_it =
        pread(file.number(), &word, sizeof(word), static_cast<off_t>(bytes)) == sizeof(word) &&
        word == place.word;
    std::shared_ptr<std::byte> memory = is_it ? map(file, bytes) : nullptr;
    return ranks.all(memory != nullptr) ? memory : nullptr;
}

} // namespace hemilux
