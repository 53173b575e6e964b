// The powers of lamps for wishes: against the best of many, and against known ones.
#include "radiosity/light/lamps/lamp_powers.h"
#include "support/catch.h"

#include <cmath>
#include <random>
#include <vector>

using namespace hemilux;

namespace {

double squares(const std::vector<WishedPlace>& places, const std::vector<double>& factor) {
    double sum = 0;
    for (const WishedPlace& place : places) {
        double light = -place.wish;
        for (std::size_t k = 0; k < factor.size(); ++k)
            light += factor[k] * place.brought[k];
        sum += light * light;
    }
    return sum;
}

std::vector<WishedPlace> random_places(std::size_t count, std::size_t lamps, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<WishedPlace> places(count);
    for (WishedPlace& place : places) {
        for (std::size_t k = 0; k < lamps; ++k) {
            place.brought.push_back(std::pow(uniform(random), 4));
            place.error.push_back(0);
        }
        place.wish = uniform(random);
    }
    return places;
}

} // namespace

TEST_CASE("no other powers come nearer to the wishes") {
    std::mt19937 random(7);
    std::normal_distribution<double> step;
    std::size_t dark = 0;
    for (int run = 0; run < 200; ++run) {
        const std::size_t lamps = 1 + std::size_t(run) % 8, count = 1 + std::size_t(run) % 13;
        const std::vector<WishedPlace> places = random_places(count, lamps, random);
        const LampPowers found = find_lamp_powers(places, lamps);
        REQUIRE(found.factor.size() == lamps);
        const double least = squares(places, found.factor);
        for (const double factor : found.factor) {
            REQUIRE(factor >= 0);
            dark += factor == 0;
        }
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<double> other = found.factor;
            const double size = std::pow(10, -trial % 6);
            for (double& factor : other)
                factor = std::max(factor + size * step(random), 0.0);
            REQUIRE(squares(places, other) >= least * (1 - 1e-9) - 1e-14);
        }
    }
    CHECK(dark > 50); // the bound of 0 mattered
}

TEST_CASE("wishes that lamps can meet are met") {
    std::mt19937 random(3);
    for (std::size_t lamps = 1; lamps <= 64; lamps *= 2) {
        std::vector<WishedPlace> places = random_places(2 * lamps, lamps, random);
        std::uniform_real_distribution<double> power(0, 3);
        std::vector<double> wanted(lamps);
        for (double& factor : wanted)
            factor = power(random);
        wanted[lamps / 2] = 0;
        for (WishedPlace& place : places) {
            place.wish = 0;
            for (std::size_t k = 0; k < lamps; ++k)
                place.wish += wanted[k] * place.brought[k];
        }
        const LampPowers found = find_lamp_powers(places, lamps);
        for (std::size_t k = 0; k < lamps; ++k)
            CHECK(found.factor[k] == Approx(wanted[k]).margin(1e-6));
    }
}

TEST_CASE("lamps that bring nothing stay dark, of equal ones one shines") {
    const std::vector<WishedPlace> places{{{1, 0, 1}, {0, 0, 0}, 2}, {{2, 0, 2}, {0, 0, 0}, 4}};
    const LampPowers found = find_lamp_powers(places, 3);
    CHECK(found.factor[1] == 0);
    CHECK(found.factor[0] + found.factor[2] == Approx(2));
    CHECK((found.factor[0] == 0 || found.factor[2] == 0));
    CHECK(find_lamp_powers({{{0}, {0}, 1}}, 1).factor[0] == 0);
}

TEST_CASE("the errors of powers are those of many noisy tables") {
    std::mt19937 random(11);
    constexpr std::size_t lamps = 3;
    std::vector<WishedPlace> places = random_places(8, lamps, random);
    for (WishedPlace& place : places) {
        for (double& brought : place.brought)
            brought += 1;
        place.wish = 5;
        place.error = {.003, .001, .002};
        place.brought[1] *= 3;
        place.brought[2] *= .5;
    }
    const LampPowers told = find_lamp_powers(places, lamps);
    std::normal_distribution<double> noise;
    constexpr int runs = 2000;
    std::vector<double> sums(lamps);
    for (int run = 0; run < runs; ++run) {
        std::vector<WishedPlace> noisy = places;
        for (WishedPlace& place : noisy)
            for (std::size_t k = 0; k < lamps; ++k)
                place.brought[k] += place.error[k] * noise(random);
        const LampPowers found = find_lamp_powers(noisy, lamps);
        for (std::size_t k = 0; k < lamps; ++k)
            sums[k] += std::pow(found.factor[k] - told.factor[k], 2);
    }
    for (std::size_t k = 0; k < lamps; ++k)
        if (told.factor[k] > 0) {
            CAPTURE(k, told.factor[k]);
            CHECK(std::sqrt(sums[k] / runs) == Approx(told.error[k]).epsilon(.15));
        }
}
