#include "radiosity/engine/heat/heat_exchange.h"

#include "geometry/elementary.h"
#include "radiosity/engine/sparse/diagonal_gradients.h"
#include "radiosity/engine/sparse/disjoint_sets.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// Samples of the factors' errors. The spread of so many is known to 6 %.
constexpr int samples = 128;

/// Relative residuals of the solution and of samples.
constexpr double solved = 1e-12, solved_sample = 1e-4;

constexpr std::size_t rows_at_a_time = 64;

constexpr HeatEstimate unknown{std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::quiet_NaN()};

double radiation_of(double temperature) {
    return stefan_boltzmann * elementary::whole_power(temperature, 4);
}

/// Returns 1 or -1, which have variance 1 as any other numbers of a sample would.
double random_sign(std::initializer_list<std::uint64_t> words) {
    return (hash_words(words) & 1) != 0 ? 1 : -1;
}

/// The linear system: with D the share of what arrives that comes back, and e the rest of J,
///
///     (A_i / D_i) J_i - sum_j A_i F_ij J_j = (A_i / D_i) e_i + sum_o A_i F_io sigma T_o^4
///
/// for surfaces with D > 0; of others J is known. It is symmetric and positive definite.
class Enclosure {
  public:
    Enclosure(const ViewFactors& factors, std::span<const GreySurface> surfaces,
              const HeatOptions& options, const Workers& workers)
        : factors_(factors), workers_(workers), max_iterations_(options.max_iterations),
          is_fixed_(are_fixed(factors, surfaces, options)) {
        for (std::size_t k = 0; k < opens; ++k)
            if (options.open[k])
                open_radiation_[k] = radiation_of(*options.open[k]);
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const GreySurface& surface = surfaces[i];
            const bool is_warm = surface.temperature.has_value();
            // What is not fixed is seen by nothing that is, and left out.
            returned_.push_back(!is_fixed_[i] ? 0 : is_warm ? 1 - surface.emissivity : 1);
            given_.push_back(!is_fixed_[i] ? 0
                             : is_warm     ? surface.emissivity * radiation_of(*surface.temperature)
                                           : surface.flux);
        }
        for (std::uint32_t i = 0; i < rows(); ++i) {
            double own = factors.between(i, i).factor;
            for (std::size_t k = 0; k < opens; ++k)
                own += open_radiation_[k] ? 0 : factors.open[i][k].factor;
            diagonal_.push_back(returned_[i] > 0 ? factors.area[i] * (1 / returned_[i] - own) : 0);
        }
    }

    [[nodiscard]] std::size_t rows() const { return factors_.rows(); }
    [[nodiscard]] bool is_fixed(std::size_t i) const { return is_fixed_[i]; }

    /// Returns the heat that surface i gets from others beyond what it would give them, over A_i:
    /// sum_j F_ij (J_j - J_i), and so with sky and ground, which give `open` times what they do.
    [[nodiscard]] double gain(std::size_t i, std::span<const double> radiosity,
                              double open = 1) const {
        double gained = 0;
        for (std::size_t k = factors_.row_begin[i]; k < factors_.row_begin[i + 1]; ++k)
            gained += factors_.factor[k] * (radiosity[factors_.column[k]] - radiosity[i]);
        for (std::size_t k = 0; k < opens; ++k)
            if (open_radiation_[k])
                gained += factors_.open[i][k].factor * (open * *open_radiation_[k] - radiosity[i]);
        return gained;
    }
    /// Returns the heat that sky or ground gives to all in this way.
    [[nodiscard]] double heat_of_open(std::size_t k, std::span<const double> radiosity,
                                      double open = 1) const {
        double heat = 0;
        for (std::size_t i = 0; i < rows() && open_radiation_[k]; ++i)
            if (is_fixed_[i])
                heat += factors_.area[i] * factors_.open[i][k].factor *
                        (open * *open_radiation_[k] - radiosity[i]);
        return heat;
    }

    /// Finds J of all, by conjugate gradients from those that are known. Returns whether it is
    /// solved.
    [[nodiscard]] bool solve(std::vector<double>& radiosity) const {
        std::vector<double> rest(rows());
        radiosity = given_;
        for_rows([&](std::size_t i) {
            if (returned_[i] > 0)
                rest[i] = factors_.area[i] * (gain(i, radiosity) + radiosity[i] -
                                              (radiosity[i] - given_[i]) / returned_[i]);
        });
        return add_light(std::move(rest), solved, radiosity);
    }

    /// How a sample of the factors' errors moves what arrives at surfaces, and heat of the opens.
    struct Sample {
        std::vector<double> irradiation;
        std::array<double, opens> open{};
        bool is_solved = true;
    };
    [[nodiscard]] Sample sample(std::span<const double> radiosity, std::uint64_t seed) const;

  private:
    template <class Body>
    void for_rows(const Body& body) const {
        workers_.for_chunks(rows(), rows_at_a_time, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                body(i);
        });
    }
    /// Adds the J of a right-hand side, the residual of x before. Returns whether it is solved.
    [[nodiscard]] bool add_light(std::vector<double> residual, double tolerance,
                                 std::vector<double>& x) const;

    const ViewFactors& factors_;
    const Workers& workers_;
    int max_iterations_;
    std::vector<bool> is_fixed_;                              ///< by surface, as what follows
    std::array<std::optional<double>, opens> open_radiation_; ///< sigma T^4 [W/m2]
    std::vector<double> returned_, given_;                    ///< D and e
    std::vector<double> diagonal_;                            ///< 0 where J is known
};

bool Enclosure::add_light(std::vector<double> residual, double tolerance,
                          std::vector<double>& x) const {
    double scale = 0;
    for (std::size_t i = 0; i < rows(); ++i)
        scale = std::max(scale, diagonal_[i] * x[i] * x[i]);
    const auto multiply = [this](std::span<const double> light, std::span<double> product) {
        for_rows([&](std::size_t i) {
            if (!(diagonal_[i] > 0))
                return;
            double off = 0;
            for (std::size_t at = factors_.row_begin[i]; at < factors_.row_begin[i + 1]; ++at)
                if (factors_.column[at] != i)
                    off += factors_.factor[at] * light[factors_.column[at]];
            product[i] = diagonal_[i] * light[i] - factors_.area[i] * off;
        });
    };
    return add_solution(diagonal_, std::move(residual),
                        {.square = tolerance * tolerance,
                         .least_scale = scale,
                         .iterations = max_iterations_},
                        multiply, x)
        .converged;
}

Enclosure::Sample Enclosure::sample(std::span<const double> radiosity, std::uint64_t seed) const {
    std::vector<double> moved(rows()); // heat to a surface, over A_i
    Sample sample;
    sample.irradiation.resize(rows());
    for_rows([&](std::size_t i) {
        const auto at = static_cast<std::uint32_t>(i);
        for (std::size_t k = factors_.row_begin[i]; k < factors_.row_begin[i + 1]; ++k) {
            const std::uint32_t j = factors_.column[k];
            const double error = factors_.standard_error[k];
            if (error > 0 && j != at) // both of a pair have the same error of A F
                moved[i] += error * random_sign({seed, std::min(at, j), std::max(at, j)}) *
                            (radiosity[j] - radiosity[i]);
        }
    });
    for (std::size_t i = 0; i < rows(); ++i)
        for (std::size_t k = 0; k < opens; ++k) {
            const double error = factors_.open[i][k].standard_error;
            if (!open_radiation_[k] || !(error > 0) || !is_fixed_[i])
                continue;
            const double heat =
                error * random_sign({seed, i, rows() + k}) * (*open_radiation_[k] - radiosity[i]);
            moved[i] += heat;
            sample.open[k] += factors_.area[i] * heat;
        }
    std::vector<double> change(rows()), right(rows());
    for (std::size_t i = 0; i < rows(); ++i)
        right[i] = returned_[i] > 0 ? factors_.area[i] * moved[i] : 0;
    sample.is_solved = add_light(std::move(right), solved_sample, change);
    for_rows(
        [&](std::size_t i) { sample.irradiation[i] = moved[i] + change[i] + gain(i, change, 0); });
    for (std::size_t k = 0; k < opens; ++k)
        sample.open[k] += heat_of_open(k, change, 0);
    return sample;
}

/// Returns the temperature of a radiation sigma T^4 [K], with its error.
HeatEstimate temperature_of(const HeatEstimate& radiation) {
    if (!(radiation.value >= 0))
        return unknown;
    const double temperature = std::sqrt(std::sqrt(radiation.value / stefan_boltzmann));
    if (!(radiation.error > 0)) // none, or unknown
        return {temperature, radiation.error};
    // Where the error is as large as the radiation, the temperature is as unsure as that of it.
    const double above =
        std::sqrt(std::sqrt((radiation.value + radiation.error) / stefan_boltzmann));
    const double derivative =
        radiation.value > 0 ? radiation.error * temperature / (4 * radiation.value) : above;
    return {temperature, std::min(derivative, above)};
}

SurfaceHeat heat_of(const GreySurface& surface, const HeatEstimate& irradiation) {
    SurfaceHeat heat{.temperature = {}, .irradiation = irradiation, .flux = {}};
    const double e = surface.emissivity;
    if (surface.temperature) {
        heat.temperature.value = *surface.temperature;
        heat.flux = {e * (radiation_of(*surface.temperature) - irradiation.value),
                     e * irradiation.error};
        return heat;
    }
    heat.flux.value = surface.flux;
    heat.temperature =
        e > 0 ? temperature_of({surface.flux / e + irradiation.value, irradiation.error}) : unknown;
    return heat;
}

} // namespace

std::vector<bool> are_fixed(const ViewFactors& factors, std::span<const GreySurface> surfaces,
                            const HeatOptions& options) {
    const auto rows = static_cast<std::uint32_t>(factors.rows());
    DisjointSets sets(rows);
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::size_t k = factors.row_begin[i]; k < factors.row_begin[i + 1]; ++k)
            if (factors.factor[k] > 0)
                sets.join(i, factors.column[k]);
    std::vector<bool> is_fixed(rows);
    for (std::uint32_t i = 0; i < rows; ++i) {
        bool fixes = surfaces[i].temperature && surfaces[i].emissivity > 0;
        for (std::size_t k = 0; k < opens; ++k)
            fixes = fixes || (options.open[k] && factors.open[i][k].factor > 0);
        if (fixes)
            is_fixed[sets.find(i)] = true;
    }
    for (std::uint32_t i = 0; i < rows; ++i)
        is_fixed[i] = is_fixed[sets.find(i)]; // whose own comes first
    return is_fixed;
}

HeatExchange exchange_heat(const ViewFactors& factors, std::span<const GreySurface> surfaces,
                           const HeatOptions& options, const Workers& workers) {
    const Enclosure enclosure(factors, surfaces, options, workers);
    std::vector<double> radiosity;
    std::vector<HeatEstimate> irradiation(factors.rows());
    HeatExchange exchange;
    exchange.is_solved = enclosure.solve(radiosity);
    for (std::size_t i = 0; i < factors.rows(); ++i)
        irradiation[i].value = radiosity[i] + enclosure.gain(i, radiosity);
    for (std::size_t k = 0; k < opens; ++k)
        exchange.open[k].value = enclosure.heat_of_open(k, radiosity);
    for (int s = 0; s < samples; ++s) {
        const Enclosure::Sample sample =
            enclosure.sample(radiosity, hash_words({options.seed, static_cast<std::uint64_t>(s)}));
        for (std::size_t i = 0; i < factors.rows(); ++i)
            irradiation[i].error += sample.irradiation[i] * sample.irradiation[i] / samples;
        for (std::size_t k = 0; k < opens; ++k)
            exchange.open[k].error += sample.open[k] * sample.open[k] / samples;
        exchange.is_solved = exchange.is_solved && sample.is_solved;
    }
    const double known = exchange.is_solved ? 1 : unknown.error;
    for (HeatEstimate& open : exchange.open)
        open.error = known * std::sqrt(open.error);
    for (std::size_t i = 0; i < factors.rows(); ++i) {
        irradiation[i].error = known * std::sqrt(irradiation[i].error);
        exchange.surfaces.push_back(enclosure.is_fixed(i) ? heat_of(surfaces[i], irradiation[i])
                                                          : SurfaceHeat{unknown, unknown, unknown});
    }
    return exchange;
}

} // namespace hemilux
