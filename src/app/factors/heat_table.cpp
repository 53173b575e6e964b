#include "app/factors/heat_table.h"

#include "app/settings/exit_code.h"
#include "app/settings/overrides.h"
#include "app/terminal/log.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"
#include "io/results/csv.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/factors/rows/row_rays.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hemilux {
namespace {

/// The columns of the table that is read; a table may lack one of the last two.
enum Column : std::size_t { surface, emissivity, temperature, flux, columns };
constexpr std::array<const char*, columns> names = {"surface", "emissivity", "temperature", "flux"};

/// Reads rows of one file.
class SurfaceRows {
  public:
    explicit SurfaceRows(const std::string& path)
        : path_(path), content_(read_text_file(path, InputKind::stream)), reader_(path, content_) {
        if (!reader_.next(fields_))
            throw InputError(path, "is empty; expected the columns surface, emissivity, "
                                   "temperature and flux");
        width_ = fields_.size();
        for (std::size_t k = 0; k < columns; ++k) {
            const auto found = std::ranges::find(fields_, names[k]);
            if (found != fields_.end())
                place_[k] = static_cast<std::size_t>(found - fields_.begin());
        }
        if (!place_[surface] || !place_[emissivity] || !(place_[temperature] || place_[flux]))
            refuse("expected a header with the columns surface, emissivity, and temperature or "
                   "flux or both");
    }

    bool next() {
        if (!reader_.next(fields_))
            return false;
        if (fields_.size() != width_)
            refuse("expected " + std::to_string(width_) + " fields, got " +
                   std::to_string(fields_.size()));
        return true;
    }
    [[nodiscard]] const std::string& name() const { return fields_[*place_[surface]]; }

    [[nodiscard]] GreySurface value() const {
        GreySurface grey;
        const std::optional<double> e = number(emissivity);
        if (!e || *e < 0 || *e > 1)
            refuse("expected an emissivity from 0 to 1, " + found(emissivity));
        grey.emissivity = *e;
        grey.temperature = number(temperature);
        const std::optional<double> known_flux = number(flux);
        if (grey.temperature.has_value() == known_flux.has_value())
            refuse("expected a temperature or a flux, one of the two");
        if (grey.temperature && *grey.temperature < 0)
            refuse("expected a temperature of at least 0 K, " + found(temperature));
        grey.flux = known_flux.value_or(0);
        if (grey.flux != 0 && grey.emissivity == 0)
            refuse("expected a flux of 0 where the emissivity is 0, " + found(flux));
        return grey;
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(path_, reader_.line(), what);
    }

  private:
    [[nodiscard]] std::string text(Column column) const {
        return place_[column] ? std::string(trimmed(fields_[*place_[column]])) : std::string();
    }
    [[nodiscard]] std::string found(Column column) const { return found_instead(text(column)); }
    /// Returns the number of a field; nothing where it is empty.
    [[nodiscard]] std::optional<double> number(Column column) const {
        const std::string word = text(column);
        if (word.empty())
            return {};
        const std::optional<double> value = parse_decimal(word);
        if (!value)
            refuse(std::string("expected a number in column '") + names[column] + "', " +
                   found_instead_of_number(word));
        return value;
    }

    const std::string& path_;
    std::string content_;
    csv::Reader reader_;
    std::vector<std::string> fields_;
    std::size_t width_ = 0;
    std::array<std::optional<std::size_t>, columns> place_;
};

HeatOptions temperatures_of(const ViewFactorSettings& settings) {
    return {.open = {settings.heat.sky_temperature, settings.heat.ground_temperature, {}},
            .seed = settings.options.seed};
}

void append(std::string& line, const HeatEstimate& estimate) {
    csv::append_known(line, estimate.value);
    csv::append_known(line, estimate.error);
}

/// Returns the largest share that is open in one of the ways.
double largest_share(const ViewFactors& factors, Open open) {
    double largest = 0;
    for (const auto& shares : factors.open)
        largest = std::max(largest, shares[static_cast<std::size_t>(open)].factor);
    return largest;
}

} // namespace

std::vector<GreySurface> read_grey_surfaces(const std::string& path,
                                            const FactorSurfaces& surfaces) {
    std::vector<std::optional<GreySurface>> known(surfaces.rows.size());
    for (SurfaceRows rows(path); rows.next();) {
        const GreySurface value = rows.value();
        bool is_there = false;
        for (std::size_t i = 0; i < known.size(); ++i)
            if (matches(rows.name(), surfaces.rows[i].name)) {
                known[i] = value;
                is_there = true;
            }
        if (!is_there)
            rows.refuse("no surface is called '" + shortened(rows.name(), 60) +
                        "'; --by group and --by material have names, and faces are numbers from "
                        "0");
    }
    std::vector<GreySurface> grey;
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (!known[i])
            throw InputError(path, "says nothing of the surface '" + surfaces.rows[i].name +
                                       "'; a row '*' stands for all that have no later one");
        grey.push_back(*known[i]);
    }
    return grey;
}

void check_temperatures(const ViewFactorSettings& settings, const FactorScene& scene,
                        std::span<const GreySurface> grey) {
    const HeatOptions known = temperatures_of(settings);
    if (!known.open[0] && !known.open[1] && std::ranges::none_of(grey, [](const GreySurface& one) {
            return one.temperature && one.emissivity > 0;
        }))
        throw InputError(settings.heat.surfaces,
                         "says how warm no surface is that gives off heat; expected a temperature "
                         "of one at least");
    constexpr std::size_t looked_at = 500;
    constexpr std::uint32_t rays = 256;
    const std::size_t patches = scene.mesh.patches().size();
    const FacingBacks backs(scene.mesh);
    RowRays row({scene.mesh, scene.tree, backs, settings.options.seed, scene.up});
    RowView view;
    for (std::size_t i = 0; i < patches; i += patches / looked_at + 1) {
        row.trace(static_cast<std::uint32_t>(i), rays, view);
        for (const Open open : {Open::sky, Open::ground})
            if (const auto k = static_cast<std::size_t>(open);
                !known.open[k] && view.open[k].factor > 0)
                throw UsageError(std::string("--") + name_of(open) +
                                 "-temperature: say how warm it is, as '" +
                                 scene.surfaces.rows[scene.surfaces.row_of[i]].name + "' sees it");
    }
}

void write_heat(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
                std::span<const GreySurface> grey, const ViewFactors& factors,
                double world_area_of_unit) {
    const HeatOptions options = temperatures_of(settings);
    const HeatExchange exchange =
        exchange_heat(factors, grey, options, Workers(settings.options.threads));
    AtomicFile file(settings.heat.output);
    file.write("surface,area,emissivity,temperature,temperature_error,irradiation,"
               "irradiation_error,flux,flux_error,heat,heat_error\n");
    double sum = 0, sizes = 0, worst = 0;
    std::uint64_t without = 0;
    for (std::size_t i = 0; i < grey.size(); ++i) {
        const SurfaceHeat& heat = exchange.surfaces[i];
        const double area = surfaces.rows[i].area;
        std::string line;
        csv::append_text(line, surfaces.rows[i].name);
        csv::append_field(line, area);
        csv::append_field(line, grey[i].emissivity);
        append(line, heat.temperature);
        append(line, heat.irradiation);
        append(line, heat.flux);
        append(line, {area * heat.flux.value, area * heat.flux.error});
        file.write(line + "\n");
        if (!std::isnan(heat.irradiation.value)) {
            sum += area * heat.flux.value;
            sizes += std::abs(area * heat.flux.value);
            worst = std::max(worst, area * heat.flux.error);
        }
        without += std::isnan(heat.temperature.value) && grey[i].emissivity > 0 ? 1 : 0;
    }
    for (const Open open : {Open::sky, Open::ground}) {
        const auto k = static_cast<std::size_t>(open);
        if (!options.open[k])
            continue;
        const HeatEstimate heat{world_area_of_unit * exchange.open[k].value,
                                world_area_of_unit * exchange.open[k].error};
        std::string line = std::string(name_of(open)) + ",,1";
        csv::append_field(line, *options.open[k]);
        line += ",0,,,,";
        append(line, heat);
        file.write(line + "\n");
        sum += heat.value;
        sizes += std::abs(heat.value);
        worst = std::max(worst, heat.error);
    }
    file.commit();
    const auto say = [&](const std::string& text) {
        log_line(settings.verbosity, Verbosity::normal, text);
    };
    say(formatted("heat: %.4g W change places, the largest standard error is %.2g W; all add up to "
                  "%.1g W",
                  sizes / 2, worst, sum));
    if (!exchange.is_solved)
        say("warning: the iterations ended before the heat was solved; its errors are unknown");
    if (without > 0)
        say("warning: of " + counted(without, "surface", "surfaces") +
            " nothing fixes how warm it is, or no temperature is low enough to take up so much "
            "heat");
    constexpr double many = 1e-3;
    const auto warn_of = [&](Open open, const std::string& what, const std::string& advice) {
        if (const double share = largest_share(factors, open); share > many)
            say("warning: surfaces see " + what + " (" + percent(share) +
                " of a view at most), with which they exchange no heat; " + advice);
    };
    warn_of(Open::back, "backs of faces", "--sides both gives each a back");
    for (const Open open : {Open::sky, Open::ground})
        if (!options.open[static_cast<std::size_t>(open)])
            warn_of(open, std::string("the ") + name_of(open),
                    std::string("--") + name_of(open) + "-temperature says how warm it is");
}

} // namespace hemilux
