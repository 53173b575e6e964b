#include "radiosity/engine/solving/shared_stop.h"

#include <algorithm>

namespace hemilux {

SharedStop::SharedStop(StopFlag& flag, const Ranks& ranks) : flag_(flag), ranks_(ranks) {
    if (!ranks.are_several())
        return;
    flag.shared_ = this;
    put_in_force();
}

SharedStop::~SharedStop() {
    if (flag_.shared_ != this)
        return;
    set_aside(flag_);
    flag_.shared_ = nullptr;
}

const Ranks& ranks_of(const StopFlag& flag) {
    const SharedStop* const shared = SharedStop::of(flag);
    return shared ? shared->ranks_ : one_rank();
}

const Ranks& ranks_at_work(const StopFlag& flag) {
    return SharedStop::is_set_aside(flag) ? one_rank() : ranks_of(flag);
}

bool agree(const StopFlag& flag) {
    struct Reasons {
        bool wished, out_of_time;
    };
    if (SharedStop* const shared = SharedStop::of(flag)) {
        const auto of_ranks =
            shared->ranks_.of_each(Reasons{flag.own().wished, flag.own().out_of_time});
        shared->agreed_.wished = std::ranges::any_of(of_ranks, &Reasons::wished);
        shared->agreed_.out_of_time = std::ranges::any_of(of_ranks, &Reasons::out_of_time);
    }
    return bool(flag);
}

void end_time_limit(StopFlag& flag) {
    flag.set_out_of_time(false);
    if (SharedStop* const shared = SharedStop::of(flag))
        shared->agreed_.out_of_time = false;
}

OnThisRank::OnThisRank(const StopFlag& flag) : shared_(SharedStop::of(flag)) {
    if (shared_)
        SharedStop::set_aside(flag);
}

OnThisRank::~OnThisRank() {
    if (shared_)
        shared_->put_in_force();
}

} // namespace hemilux
