#include "app/settings/spill.h"

#include "app/settings/exit_code.h"
#include "io/files/spill_file.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>
#include <utility>

namespace hemilux {
namespace {

/// The size below which arrays stay in memory: together such arrays are small.
constexpr std::size_t least_bytes = 1024;

/// The size from which on an array counts as a vector of all patches. Rows of matrices, and what
/// rays have hit, come in smaller pieces.
constexpr std::size_t least_vector = std::size_t{1} << 20;

/// The file lives until the process ends, as may what lies in it.
constinit std::atomic<SpillFile*> file{nullptr};
constinit std::atomic<std::int64_t> in_memory{0}; ///< bytes of large arrays
constinit std::int64_t most_in_memory = 0;
/// What is made before the steps is little used in them; their vectors are written all the time,
/// and the system would write them to the disk as often.
constinit std::atomic<bool> steps_began{false};
constexpr std::int64_t part_of_others = 8;

std::int64_t large_size(void* block) {
    const std::size_t size = malloc_usable_size(block);
    return size < least_bytes ? 0 : static_cast<std::int64_t>(size);
}

bool fits_in_memory(std::size_t bytes) {
    const bool of_steps = steps_began && bytes >= least_vector;
    const std::int64_t most = of_steps ? most_in_memory : most_in_memory / part_of_others;
    return bytes < least_bytes || in_memory + static_cast<std::int64_t>(bytes) <= most;
}

void* allocate(std::size_t bytes) {
    SpillFile* const spill = file;
    if (spill && !fits_in_memory(bytes))
        return spill->allocate(bytes);
    void* const block = std::malloc(std::max<std::size_t>(bytes, 1));
    if (!block)
        throw std::bad_alloc();
    if (spill)
        in_memory += large_size(block);
    return block;
}

void* allocate_or_null(std::size_t bytes) noexcept {
    try {
        return allocate(bytes);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void release(void* block) noexcept {
    SpillFile* const spill = file;
    if (spill && spill->holds(block))
        return spill->free(block);
    if (spill && block)
        in_memory -= large_size(block);
    std::free(block);
}

} // namespace

void begin_spilling(SceneSettings& scene) {
    if (scene.spill.empty())
        return;
    if (!scene.memory)
        throw UsageError("--spill: --memory is to say how much may stay in memory");
    most_in_memory = static_cast<std::int64_t>(*std::exchange(scene.memory, std::nullopt));
    file = new SpillFile(scene.spill);
}

void leave_memory_to_steps() { steps_began = true; }

std::uint64_t bytes_spilled() {
    const SpillFile* const spill = file;
    return spill ? spill->bytes() : 0;
}

} // namespace hemilux

// These replace all operators but those of aligned types, which stay in memory: the vectors that
// each row of a matrix is multiplied with (Lanes), read all over. Sanitizers have their own of
// each, so none may be left out.
void* operator new(std::size_t bytes) { return hemilux::allocate(bytes); }
void* operator new[](std::size_t bytes) { return hemilux::allocate(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
    return hemilux::allocate_or_null(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
    return hemilux::allocate_or_null(bytes);
}
void operator delete(void* block) noexcept { hemilux::release(block); }
void operator delete[](void* block) noexcept { hemilux::release(block); }
void operator delete(void* block, std::size_t /*bytes*/) noexcept { hemilux::release(block); }
void operator delete[](void* block, std::size_t /*bytes*/) noexcept { hemilux::release(block); }
