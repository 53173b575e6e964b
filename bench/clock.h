#pragma once
// CPU time of the calling thread: what others do on the machine counts less than on a wall clock.

#include <ctime>

namespace hemilux::bench {

[[nodiscard]] inline double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

} // namespace hemilux::bench
