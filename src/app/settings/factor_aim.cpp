#include "app/settings/factor_aim.h"

#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/numbers.h"

#include <filesystem>

namespace hemilux {

std::string text_of(const FactorAim& aim) {
    switch (aim.of) {
    case FactorAim::Of::rows:
        return "rows";
    case FactorAim::Of::largest:
        return "largest";
    case FactorAim::Of::pair:
        return "pair:" + aim.from + "," + aim.to;
    case FactorAim::Of::sky:
        return "sky";
    case FactorAim::Of::above:
        break;
    }
    return "above:" + shortest_text(aim.least);
}

void check_aim(const FactorAim& aim, const FactorSurfaces& surfaces) {
    if (aim.of != FactorAim::Of::pair)
        return;
    for (const std::string& name : {aim.from, aim.to})
        if (!surfaces.row_named(name))
            throw UsageError("--of pair: no surface is called '" + name +
                             "'; --by group or --by material has other names, and faces and "
                             "patches are numbers from 0");
}

std::optional<FactorAim> parse_factor_aim(std::string_view text) {
    constexpr std::string_view above = "above:", pair = "pair:";
    FactorAim aim;
    if (text == "rows") {
        aim.of = FactorAim::Of::rows;
        return aim;
    }
    if (text == "largest" || text == "sky") {
        aim.of = text == "sky" ? FactorAim::Of::sky : FactorAim::Of::largest;
        return aim;
    }
    if (text.starts_with(above)) {
        constexpr NumberRange range{.low = 1e-6, .high = 1};
        const std::optional<double> least = parse_share(text.substr(above.size()));
        if (!least || !range.contains(*least))
            return std::nullopt;
        aim.least = *least;
        return aim;
    }
    if (!text.starts_with(pair))
        return std::nullopt;
    text.remove_prefix(pair.size());
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || comma == 0 || comma + 1 == text.size())
        return std::nullopt;
    aim.of = FactorAim::Of::pair;
    aim.from = text.substr(0, comma);
    aim.to = text.substr(comma + 1);
    return aim;
}

std::optional<SkyDivision> parse_sky_division(std::string_view text) {
    constexpr std::uint64_t most = 90;
    if (text == "tregenza")
        return SkyDivision{};
    const std::optional<std::uint64_t> steps = parse_whole(text);
    return steps && *steps >= 1 && *steps <= most
               ? std::optional(SkyDivision{static_cast<unsigned>(*steps)})
               : std::nullopt;
}

std::optional<FactorFile> factor_file_of(const std::string& path) {
    const std::string name = std::filesystem::path(path).filename().string();
    if (name.starts_with("vfsparse.inp"))
        return FactorFile::udales_factors;
    if (name.starts_with("svf.inp"))
        return FactorFile::udales_sky;
    const std::string extension = extension_of(path);
    if (extension == ".csv")
        return FactorFile::pairs;
    if (extension == ".npz")
        return FactorFile::sparse;
    if (extension == ".npy")
        return FactorFile::dense;
    if (extension == ".vtu")
        return FactorFile::cells;
    return std::nullopt;
}

} // namespace hemilux
