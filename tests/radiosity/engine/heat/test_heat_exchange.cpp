// Heat between grey surfaces against closed forms, elimination, and what factors with errors do.
#include "radiosity/engine/heat/heat_exchange.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <cmath>

using namespace hemilux;

namespace {

/// Areas and A F of all pairs; what a row lacks is the sky's, then the ground's.
struct Room {
    std::vector<double> area, sky, ground;
    std::vector<std::vector<double>> exchange, error; ///< A F; symmetric
};

ViewFactors factors_of(const Room& room) {
    ViewFactors factors;
    const auto n = static_cast<std::uint32_t>(room.area.size());
    factors.area = room.area;
    factors.row_begin = {0};
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j)
            if (room.exchange[i][j] > 0) {
                factors.column.push_back(j);
                factors.factor.push_back(room.exchange[i][j] / room.area[i]);
                factors.standard_error.push_back(room.error[i][j] / room.area[i]);
            }
        factors.row_begin.push_back(factors.column.size());
        factors.open.push_back({OpenShare{room.sky[i] / room.area[i], 0},
                                OpenShare{room.ground[i] / room.area[i], 0}, OpenShare{}});
    }
    return factors;
}

/// A room of n surfaces that all see each other, of which `open` of the view is sky and ground.
Room random_room(std::size_t n, double open, Rng& random) {
    Room room;
    room.exchange.assign(n, std::vector<double>(n));
    room.error = room.exchange;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            room.exchange[i][j] = room.exchange[j][i] = random.uniform();
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (const double e : room.exchange[i])
            sum += e;
        room.area.push_back(sum / (1 - open));
        room.sky.push_back(.7 * open * room.area[i]);
        room.ground.push_back(.3 * open * room.area[i]);
    }
    return room;
}

std::vector<GreySurface> random_surfaces(std::size_t n, Rng& random) {
    std::vector<GreySurface> surfaces(n);
    for (std::size_t i = 0; i < n; ++i) {
        surfaces[i].emissivity = i % 5 == 1 ? 1 : random.uniform();
        if (i % 3 == 2)
            surfaces[i].flux = i % 2 == 0 ? 0 : 100 * random.uniform();
        else
            surfaces[i].temperature = 250 + 300 * random.uniform();
    }
    return surfaces;
}

/// J by Gaussian elimination.
std::vector<double> eliminated(const Room& room, const std::vector<GreySurface>& surfaces,
                               double sky, double ground) {
    const std::size_t n = surfaces.size();
    std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1));
    for (std::size_t i = 0; i < n; ++i) {
        const GreySurface& s = surfaces[i];
        const double back = s.temperature ? 1 - s.emissivity : 1;
        for (std::size_t j = 0; j < n; ++j)
            rows[i][j] = (i == j ? 1 : 0) - back * room.exchange[i][j] / room.area[i];
        rows[i][n] = (s.temperature ? s.emissivity * stefan_boltzmann * std::pow(*s.temperature, 4)
                                    : s.flux) +
                     back * stefan_boltzmann *
                         (room.sky[i] * std::pow(sky, 4) + room.ground[i] * std::pow(ground, 4)) /
                         room.area[i];
    }
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i)
            if (i != k) {
                const double factor = rows[i][k] / rows[k][k];
                for (std::size_t j = k; j <= n; ++j)
                    rows[i][j] -= factor * rows[k][j];
            }
    std::vector<double> radiosity(n);
    for (std::size_t i = 0; i < n; ++i)
        radiosity[i] = rows[i][n] / rows[i][i];
    return radiosity;
}

HeatExchange heat(const Room& room, const std::vector<GreySurface>& surfaces,
                  const HeatOptions& options = {}, unsigned threads = 1) {
    return exchange_heat(factors_of(room), surfaces, options, Workers(threads));
}

} // namespace

TEST_CASE("Two grey surfaces, and two with an insulated one, exchange what the closed forms say") {
    // Incropera and DeWitt, Fundamentals of Heat and Mass Transfer, eqs 13.23 and 13.30.
    const double hot = stefan_boltzmann * std::pow(800, 4),
                 cold = stefan_boltzmann * std::pow(300, 4);
    const Room two{.area = {1, 3},
                   .sky = {0, 0},
                   .ground = {0, 0},
                   .exchange = {{0, 1}, {1, 2}},
                   .error = {{0, 0}, {0, 0}}};
    const HeatExchange of_two =
        heat(two, {{.emissivity = .6, .temperature = 800}, {.emissivity = .3, .temperature = 300}});
    const double between = (hot - cold) / (.4 / .6 + 1 + .7 / (3 * .3));
    CHECK(of_two.surfaces[0].flux.value == Approx(between).epsilon(1e-12));
    CHECK(3 * of_two.surfaces[1].flux.value == Approx(-between).epsilon(1e-12));

    const Room three{.area = {1, 1, 2},
                     .sky = {0, 0, 0},
                     .ground = {0, 0, 0},
                     .exchange = {{0, .2, .8}, {.2, 0, .8}, {.8, .8, .4}},
                     .error = std::vector(3, std::vector(3, 0.0))};
    const HeatExchange of_three = heat(three, {{.emissivity = .8, .temperature = 800},
                                               {.emissivity = .4, .temperature = 300},
                                               {.emissivity = .5, .temperature = {}, .flux = 0}});
    const double middle = 1 / (.2 + 1 / (1 / .8 + 1 / .8));
    const double by_way = (hot - cold) / (.2 / .8 + middle + .6 / .4);
    CHECK(of_three.surfaces[0].flux.value == Approx(by_way).epsilon(1e-12));
    CHECK(of_three.surfaces[2].flux.value == 0);
    const double of_first = hot - .25 * by_way, of_second = cold + 1.5 * by_way;
    CHECK(of_three.surfaces[2].temperature.value ==
          Approx(std::pow((of_first + of_second) / 2 / stefan_boltzmann, .25)).epsilon(1e-12));
    CHECK(of_three.surfaces[2].temperature.error == 0);
}

TEST_CASE("Random rooms have the light of elimination, and heat is kept") {
    Rng random(5);
    for (int round = 0; round < 40; ++round) {
        const double open = round % 2 == 0 ? 0 : .3 * random.uniform();
        const Room room = random_room(2 + static_cast<std::size_t>(round), open, random);
        const std::vector<GreySurface> surfaces = random_surfaces(room.area.size(), random);
        HeatOptions options;
        if (open > 0)
            options.open = {270, 290, {}};
        const HeatExchange found = heat(room, surfaces, options);
        const std::vector<double> radiosity = eliminated(room, surfaces, 270, 290);
        double sum = found.open[0].value + found.open[1].value;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const SurfaceHeat& surface = found.surfaces[i];
            CHECK(surface.flux.value + surface.irradiation.value ==
                  Approx(radiosity[i]).epsilon(1e-9));
            const double e = surfaces[i].emissivity;
            const double own = e * stefan_boltzmann * std::pow(surface.temperature.value, 4);
            CHECK(own + (1 - e) * surface.irradiation.value == Approx(radiosity[i]).epsilon(1e-9));
            sum += room.area[i] * surface.flux.value;
        }
        CHECK(sum == Approx(0).margin(1e-6));
    }
}

TEST_CASE("Where all is equally warm no heat changes places, whatever the errors of factors") {
    Rng random(6);
    Room room = random_room(9, .2, random);
    for (auto& row : room.error)
        row.assign(9, .1);
    std::vector<GreySurface> surfaces = random_surfaces(9, random);
    for (GreySurface& surface : surfaces)
        if (surface.temperature)
            surface.temperature = 300;
        else
            surface.flux = 0;
    const HeatExchange found = heat(room, surfaces, {.open = {300, 300, {}}});
    for (const SurfaceHeat& surface : found.surfaces) {
        CHECK(surface.temperature.value == Approx(300).epsilon(1e-12));
        CHECK(std::abs(surface.flux.value) < 1e-9);
        CHECK(surface.flux.error < 1e-9);
        CHECK(surface.temperature.error < 1e-9);
    }
}

TEST_CASE("Errors of heat are those that errors of factors make") {
    Rng random(7);
    double squares = 0, of_temperatures = 0, beyond_2 = 0, count = 0;
    for (int round = 0; round < 60; ++round) {
        const std::size_t n = 12;
        const Room truth = random_room(n, .1, random);
        const std::vector<GreySurface> surfaces = random_surfaces(n, random);
        Room measured = truth;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double deviation = j % 3 == 0 ? 0 : .05 * truth.exchange[i][j];
                // Of variance 1: a uniform number from -sqrt(3) to sqrt(3).
                const double moved = deviation * std::sqrt(3) * (2 * random.uniform() - 1);
                measured.error[i][j] = measured.error[j][i] = deviation;
                measured.exchange[i][j] = measured.exchange[j][i] = truth.exchange[i][j] + moved;
                measured.exchange[i][i] -= moved; // rows are closed
                measured.exchange[j][j] -= moved;
            }
        const HeatOptions options{.open = {260, 280, {}}, .seed = std::uint64_t(round)};
        const HeatExchange a = heat(truth, surfaces, options),
                           b = heat(measured, surfaces, options);
        for (std::size_t i = 0; i < n; ++i) {
            const auto z = [&](auto member) {
                return ((b.surfaces[i].*member).value - (a.surfaces[i].*member).value) /
                       (b.surfaces[i].*member).error;
            };
            const double arrives = z(&SurfaceHeat::irradiation);
            squares += arrives * arrives;
            beyond_2 += std::abs(arrives) > 2;
            ++count;
            if (!surfaces[i].temperature) {
                const double warm = z(&SurfaceHeat::temperature);
                CHECK(std::abs(warm - arrives) < .1);
                of_temperatures += warm * warm;
            }
        }
    }
    CHECK(std::sqrt(squares / count) == Approx(1).margin(.12));
    CHECK(beyond_2 / count < .08);
    CHECK(of_temperatures > 0);
}

TEST_CASE("What nothing fixes is unknown, and the rest is as without it") {
    Rng random(8);
    const Room room = random_room(4, 0, random);
    Room both = room;
    for (std::size_t i = 0; i < 4; ++i) {
        both.area.push_back(room.area[i]);
        both.sky.push_back(0);
        both.ground.push_back(0);
        both.exchange[i].resize(8);
        both.exchange.emplace_back(8);
        for (std::size_t j = 0; j < 4; ++j)
            both.exchange.back()[4 + j] = room.exchange[i][j];
    }
    both.error.assign(8, std::vector<double>(8, .01));
    std::vector<GreySurface> surfaces = random_surfaces(4, random);
    const HeatExchange alone = heat(room, surfaces);
    surfaces.resize(8, {.emissivity = .5, .temperature = {}, .flux = 0});
    surfaces[5] = {.emissivity = 0, .temperature = 300}; // gives off nothing
    const std::vector<bool> fixed = are_fixed(factors_of(both), surfaces, {});
    CHECK(fixed == std::vector<bool>{true, true, true, true, false, false, false, false});
    const HeatExchange found = heat(both, surfaces, {.open = {250, 250, {}}}, 3);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(found.surfaces[i].flux.value == alone.surfaces[i].flux.value);
        CHECK(std::isfinite(found.surfaces[i].flux.error));
        CHECK(std::isnan(found.surfaces[4 + i].flux.value));
        CHECK(std::isnan(found.surfaces[4 + i].temperature.value));
    }
    CHECK(found.open[0].value == 0);
    const HeatExchange again = heat(both, surfaces, {.open = {250, 250, {}}}, 1);
    CHECK(again.surfaces[2].flux.error == found.surfaces[2].flux.error);
}

TEST_CASE("Heat that is not solved within the iterations has no error, rather than a wrong one") {
    Rng random(5);
    Room room = random_room(12, .1, random);
    const std::vector<GreySurface> surfaces = random_surfaces(12, random);
    HeatOptions options;
    options.open = {280.0, 290.0, std::nullopt};
    const ViewFactors factors = factors_of(room);
    CHECK(exchange_heat(factors, surfaces, options, Workers(1)).is_solved);
    options.max_iterations = 2;
    const HeatExchange exchange = exchange_heat(factors, surfaces, options, Workers(1));
    CHECK_FALSE(exchange.is_solved);
    CHECK(std::isnan(exchange.open[0].error));
    for (const SurfaceHeat& heat : exchange.surfaces) {
        CHECK(std::isnan(heat.irradiation.error));
    }
}
