// Memory in a file that has no name: blocks keep what is written, and a full disk is an error.
#include "io/files/error.h"
#include "io/files/spill_file.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sys/resource.h>
#include <thread>
#include <utility>
#include <vector>

using namespace hemilux;
using Catch::Contains;

namespace {

/// Files of this process end at so many bytes while it lives.
class LimitOfFiles {
  public:
    explicit LimitOfFiles(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limited{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limited);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
    }
    ~LimitOfFiles() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    LimitOfFiles(const LimitOfFiles&) = delete;
    LimitOfFiles& operator=(const LimitOfFiles&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int) = SIG_DFL;
};

struct Block {
    unsigned char* bytes;
    std::size_t size;
    int value;
};

bool holds_its_value(const Block& block) {
    for (std::size_t i = 0; i < block.size; ++i)
        if (block.bytes[i] != block.value)
            return false;
    return true;
}

} // namespace

TEST_CASE("Blocks of a spill file keep what threads write, and freed ones are used again") {
    const test::TemporaryFolder folder;
    SpillFile file(folder.path(""));
    CHECK(std::filesystem::is_empty(folder.path("")));
    const std::vector<std::size_t> sizes{0, 1, 16, 1000, 1024, 1025, 4096, 5000, 70'000, 3 << 20};
    const auto work = [&](int value) {
        std::vector<Block> blocks;
        for (int round = 0; round < 20; ++round) {
            for (const std::size_t size : sizes) {
                auto* const bytes = static_cast<unsigned char*>(file.allocate(size));
                std::memset(bytes, value, size);
                blocks.push_back({bytes, size, value});
            }
            for (std::size_t k = blocks.size() / 2; k < blocks.size(); ++k)
                if (holds_its_value(blocks[k])) {
                    file.free(std::exchange(blocks[k], blocks.back()).bytes);
                    blocks.pop_back();
                }
        }
        for (const Block& block : blocks)
            if (!holds_its_value(block) || !file.holds(block.bytes))
                return false;
        return true;
    };
    std::vector<char> good(4);
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < good.size(); ++t)
            threads.emplace_back([&, t] { good[t] = work(static_cast<int>(t) + 1); });
    }
    for (const char each : good)
        CHECK(each);
    const std::uint64_t size = file.bytes();
    for (int k = 0; k < 100; ++k)
        file.free(file.allocate(3 << 20));
    CHECK(file.bytes() == size);
    int on_stack = 0;
    CHECK_FALSE(file.holds(&on_stack));
    CHECK(std::filesystem::is_empty(folder.path("")));
}

TEST_CASE("Blocks of a spill file are aligned as those of operator new") {
    const test::TemporaryFolder folder;
    SpillFile file(folder.path(""));
    for (std::size_t size = 0; size < 3000; size += 7)
        CHECK(reinterpret_cast<std::uintptr_t>(file.allocate(size)) %
                  __STDCPP_DEFAULT_NEW_ALIGNMENT__ ==
              0);
}

TEST_CASE("A spill file says where it has no room, and can still be used") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("");
    SpillFile file(path);
    void* const block = file.allocate(1 << 20);
    {
        const LimitOfFiles limit(100 << 20);
        CHECK_THROWS_WITH(file.allocate(200 << 20), Contains(path + ": no room for more than 64 "
                                                                    "MiB of --spill: File too "
                                                                    "large"));
        for (const int power : {41, 60})
            CHECK_THROWS_AS(file.allocate(std::size_t{1} << power), std::bad_alloc);
        std::memset(block, 1, 1 << 20);
        file.free(block);
        CHECK(file.allocate(1 << 20) == block);
    }
    for (int k = 0; k < 2; ++k) { // from no multiple of a page, and over the end of the file
        auto* const large = static_cast<unsigned char*>(file.allocate(200 << 20));
        large[0] = large[(200 << 20) - 1] = 1;
        CHECK(file.allocate(1) != nullptr);
    }
    CHECK_THROWS_AS(SpillFile(path + "/none"), OutputError);
}
