#include "support/families/gauss_rule.h"

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

namespace hemilux::test {
namespace {

/// Roots of the Legendre polynomial P_n by Newton's method; the weight at a root x is
/// 2 / ((1 - x^2) P_n'(x)^2) over [-1,1] (Abramowitz and Stegun 1964, 25.4.29).
std::vector<GaussPoint> make_rule(int n) {
    std::vector<GaussPoint> rule;
    for (int k = 0; k < n; ++k) {
        double x = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), slope = 0;
        for (int iteration = 0; iteration < 20; ++iteration) {
            double p = 1, before = 0;
            for (int j = 1; j <= n; ++j) {
                const double older = before;
                before = p;
                p = ((2 * j - 1) * x * before - (j - 1) * older) / j;
            }
            slope = n * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        rule.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
    }
    return rule;
}

} // namespace

const std::vector<GaussPoint>& gauss_rule(int n) {
    static std::mutex mutex;
    static std::map<int, std::vector<GaussPoint>> rules;
    const std::lock_guard lock(mutex);
    const auto [place, is_new] = rules.try_emplace(n);
    if (is_new)
        place->second = make_rule(n);
    return place->second;
}

} // namespace hemilux::test
