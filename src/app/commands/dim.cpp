// hemilux dim: the light of a run with --layers where its lamps have other powers, without a ray.

#include "app/commands/commands.h"
#include "app/lamps/dimmed_table.h"
#include "app/rendering/view.h"
#include "app/running/write_report.h"
#include "app/settings/dim_settings.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/names.h"
#include "app/terminal/print.h"
#include "io/files/error.h"
#include "io/pictures/exr_reader.h"
#include "io/results/csv.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/light/lamps/lamp_powers.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hemilux {
namespace {

/// Returns the factor of each lamp. The last one that names it counts.
std::vector<Vec3> factors_of(const std::vector<Override>& powers,
                             const std::vector<std::string>& lamps) {
    std::vector<Vec3> factors(lamps.size(), Vec3(1.0));
    for (const auto& [name, value] : powers) {
        bool found = false;
        for (std::size_t k = 0; k < lamps.size(); ++k)
            if (matches(name, lamps[k])) {
                factors[k] = value;
                found = true;
            }
        if (!found)
            throw UsageError("--power: " + unknown_name("lamp", name, lamps));
    }
    return factors;
}

/// Prints the factors that wishes lead to, and what they give; returns them.
std::vector<Vec3> wished_factors(const LampTable& table, const std::string& wishes) {
    const std::vector<WishedPlace> places = table.places(wishes);
    const LampPowers found = find_lamp_powers(places, table.lamps().size());
    std::string text = "lamp,factor,stderr\n";
    std::vector<Vec3> factors;
    for (std::size_t k = 0; k < found.factor.size(); ++k) {
        csv::append_text(text, table.lamps()[k]);
        text += "," + formatted("%.6g", found.factor[k]) + "," + formatted("%.2g", found.error[k]) +
                "\n";
        factors.emplace_back(found.factor[k]);
    }
    text += "wish,light,stderr\n";
    for (const WishedPlace& place : places) {
        double light = 0, squares = 0;
        for (std::size_t k = 0; k < found.factor.size(); ++k) {
            light += found.factor[k] * place.brought[k];
            const double error = found.factor[k] * place.error[k];
            squares += error * error;
        }
        text += formatted("%.6g", place.wish) + "," + formatted("%.6g", light) + "," +
                formatted("%.2g", std::sqrt(squares)) + "\n";
    }
    print(text);
    return factors;
}

/// Returns the layers of lamps: those of a picture that are not what patches are known for.
std::vector<std::string> lamps_of(const ExrFile& file) {
    std::set<std::string> lamps;
    for (const ExrChannel& channel : file.channels)
        if (channel.name.ends_with(".R"))
            lamps.insert(channel.name.substr(0, channel.name.size() - 2));
    for (const char* const other : {"irradiance", "error"})
        lamps.erase(other);
    return {lamps.begin(), lamps.end()};
}

/// A picture by other powers: of all lamps, and the channels of each.
struct DimmedPicture {
    Image sum;
    std::vector<ExrChannel> channels;
};

DimmedPicture dimmed(const ExrFile& file, const std::vector<std::string>& lamps,
                     const std::vector<Vec3>& factors) {
    DimmedPicture found{Image(file.width, file.height), {}};
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        Image layer = image_of(file, lamps[k]);
        for (std::size_t pixel = 0; pixel < layer.pixels.size(); ++pixel) {
            layer.pixels[pixel] *= glm::vec3(factors[k]);
            found.sum.pixels[pixel] += layer.pixels[pixel];
        }
        add_exr_channels(found.channels, lamps[k], layer);
    }
    add_exr_channels(found.channels, "", found.sum);
    return found;
}

/// Returns the exit code.
template <class Write>
int write_all(const DimSettings& settings, const Write& write) {
    WriteReport report;
    for (const Output& output : settings.outputs)
        report.attempt(output.path, [&] { write(output); });
    report.log(settings.verbosity);
    return report.exit_code(false);
}

int dim_picture(const DimSettings& settings) {
    if (!settings.wishes.empty())
        throw UsageError("--wish: wishes are for a table of --points-output, not for a picture");
    const ExrFile file = read_exr(settings.input);
    const std::vector<std::string> lamps = lamps_of(file);
    if (lamps.empty())
        throw InputError(settings.input, "has no layers of lamps; solve --layers writes them");
    const DimmedPicture picture = dimmed(file, lamps, factors_of(settings.powers, lamps));
    ViewSettings view = settings.view; // shown as the picture with all lamps as they were
    if (!view.exposure)
        view.exposure = auto_exposure(image_of(file, ""));
    return write_all(settings, [&](const Output& output) {
        if (output.kind == OutputKind::exr)
            write_exr(output.path, file.width, file.height, picture.channels, settings.from);
        else
            write_picture(output, picture.sum, view, settings.from);
    });
}

int dim_table(const DimSettings& settings) {
    LampTable table(settings.input);
    const std::vector<Vec3> factors = settings.wishes.empty()
                                          ? factors_of(settings.powers, table.lamps())
                                          : wished_factors(table, settings.wishes);
    table.dim(factors);
    return write_all(settings, [&](const Output& output) { table.write(output.path); });
}

} // namespace

int dim(const DimSettings& settings) {
    const bool is_exr = extension_of(settings.input) == ".exr";
    for (const Output& output : settings.outputs)
        if (is_exr ? !is_picture(output.kind) : output.kind != OutputKind::csv)
            throw UsageError("-o " + output.path + ": expected " +
                             (is_exr ? ".png, .hdr or .exr, as the input is a picture"
                                     : ".csv, as the input is a table"));
    if (settings.outputs.empty() && settings.wishes.empty())
        throw UsageError("-o: expected a file to write, or --wish");
    std::vector<std::string> paths;
    for (const Output& output : settings.outputs)
        paths.push_back(output.path);
    const RunFiles files = check_files(paths, settings.input);
    if (!settings.wishes.empty())
        files.read("--wish", settings.wishes);
    return is_exr ? dim_picture(settings) : dim_table(settings);
}

} // namespace hemilux
