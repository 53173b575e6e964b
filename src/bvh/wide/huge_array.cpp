#include "bvh/wide/huge_array.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace hemilux {

void advise_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    (void)madvise(memory, bytes, MADV_HUGEPAGE); // a refusal costs speed alone
#endif
}

} // namespace hemilux
