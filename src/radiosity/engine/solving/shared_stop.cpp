#include "radiosity/engine/solving/shared_stop.h"

#include <algorithm>

namespace hemilux {

SharedStop::SharedStop(StopFlag& flag, const Ranks& ranks) : flag_(flag), ranks_(ranks) {
    if (ranks.are_several())
        flag.decide_by(this);
}

SharedStop::~SharedStop() {
    if (flag_.agreed() == this)
        flag_.decide_by(nullptr);
}

const Ranks& ranks_of(const StopFlag& flag) {
    return flag.agreed() ? static_cast<const SharedStop*>(flag.agreed())->ranks_ : one_rank();
}

const Ranks& ranks_at_work(const StopFlag& flag) {
    return flag.agreed() && flag.agreed()->is_set_aside ? one_rank() : ranks_of(flag);
}

bool agree(const StopFlag& flag) {
    struct Reasons {
        bool wished, out_of_time;
    };
    if (StopFlag::Agreed* const agreed = flag.agreed()) {
        const auto of_ranks =
            ranks_of(flag).of_each(Reasons{flag.own().wished, flag.own().out_of_time});
        agreed->reasons.wished = std::ranges::any_of(of_ranks, &Reasons::wished);
        agreed->reasons.out_of_time = std::ranges::any_of(of_ranks, &Reasons::out_of_time);
    }
    return bool(flag);
}

OnThisRank::OnThisRank(const StopFlag& flag) : agreed_(flag.agreed()) {
    if (agreed_)
        agreed_->is_set_aside = true;
}

OnThisRank::~OnThisRank() {
    if (agreed_)
        agreed_->is_set_aside = false;
}

} // namespace hemilux
