#include "radiosity/answers/gathering/gather_target.h"

#include <utility>

namespace hemilux {

std::uint64_t ImageTarget::gather(const Round& round, const Workers& workers) {
    OneRound one = gather_round(round, workers);
    if (round.number % 2 == 1)
        for (std::size_t k = 0; k < image_.pixels.size(); ++k)
            one.image.pixels[k] = 0.5f * (one.image.pixels[k] + image_.pixels[k]);
    image_ = std::move(one.image);
    return one.rays;
}

std::optional<PictureError> ImageTarget::judge(std::size_t places, const Workers& workers,
                                               const PictureJudge::GoOn& go_on) {
    if (!judge_)
        judge_.emplace(make_judge());
    return judge_->error_of(image_, places, workers, go_on);
}

} // namespace hemilux
