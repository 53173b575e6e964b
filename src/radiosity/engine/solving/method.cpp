#include "radiosity/engine/solving/method.h"

#include "radiosity/engine/solving/method_option.h"

namespace hemilux {

std::vector<MethodOption> Method::own_options() const {
    return options ? options() : std::vector<MethodOption>{};
}

MethodWork Method::work_with(const SolveOptions& chosen) const {
    MethodWork done = work;
    if (adapt)
        adapt(done, chosen);
    return done;
}

} // namespace hemilux
