#include "app/memory/own_stack.h"

#include <cstddef>
#include <pthread.h>
#include <sys/resource.h>

namespace hemilux {
namespace {

constexpr std::size_t stack_bytes = std::size_t{8} << 20; // as systems give by default

struct Call {
    const std::function<int()>& run;
    int code = 0;
};

extern "C" void* call_run(void* call) {
    auto& of = *static_cast<Call*>(call);
    of.code = of.run();
    return nullptr;
}

} // namespace

int on_own_stack(const std::function<int()>& run) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= stack_bytes)
        return run();
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0)
        return run();
    ::pthread_attr_setstacksize(&attributes, stack_bytes);
#if defined(__GLIBC__)
    ::pthread_setattr_default_np(&attributes);
#endif
    Call call{run};
    pthread_t thread{};
    const bool starts = ::pthread_create(&thread, &attributes, call_run, &call) == 0;
    ::pthread_attr_destroy(&attributes);
    if (!starts)
        return run();
    ::pthread_join(thread, nullptr);
    return call.code;
}

} // namespace hemilux
