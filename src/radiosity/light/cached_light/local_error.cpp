#include "radiosity/light/cached_light/local_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {

void LocalErrors::add(double square_off, double square_light, double weight) {
    const double off = std::max(square_off, 0.0);
    if (!(weight > 0) || (off == 0 && !(square_light > 0)))
        return;
    places_.push_back(
        {square_light > 0 ? off / square_light : std::numeric_limits<double>::infinity(), weight});
}

double LocalErrors::within() const {
    constexpr double share = .95;
    std::vector<Place> sorted = places_;
    std::ranges::sort(sorted, {}, &Place::square);
    double all = 0, so_far = 0;
    for (const Place& place : sorted)
        all += place.weight;
    for (const Place& place : sorted) {
        so_far += place.weight;
        if (so_far >= share * all)
            return std::sqrt(place.square);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

} // namespace hemilux
