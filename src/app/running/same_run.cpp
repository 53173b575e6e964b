#include "app/running/same_run.h"

#include "app/settings/exit_code.h"
#include "io/files/error.h"
#include "io/files/file_identity.h"

#include <algorithm>

namespace hemilux {

bool uses_checkpoint(const CheckpointSettings& settings) {
    if (settings.every && settings.path.empty())
        throw UsageError("--every says how often the file of --checkpoint is written; add it");
    return !settings.path.empty() || !settings.resumed.empty();
}

void read_resumed_file(const CheckpointSettings& settings, const RunFiles& files) {
    const auto& [path, resumed, every] = settings;
    if (!resumed.empty() && resumed != path && identity_of(resumed) != identity_of(path))
        files.read("file of --resume", resumed);
}

void check_same_run(const CheckpointOptions& found, const CheckpointOptions& wanted,
                    const std::string& file,
                    const std::function<std::string(const std::string& name)>& default_of) {
    const auto value_of = [&](const CheckpointOptions& options, const std::string& name) {
        const auto same = std::ranges::find(options, name, &CheckpointOptions::value_type::first);
        if (same != options.end())
            return same->second;
        return default_of ? default_of(name) : std::string();
    };
    for (const auto& [name, value] : wanted)
        if (const std::string there = value_of(found, name); there != value)
            throw InputError(file, "is a checkpoint of another run: expected " + name + " " +
                                       value + ", it has " + (there.empty() ? "nothing" : there));
    for (const auto& [name, value] : found)
        if (value_of(wanted, name) != value)
            throw InputError(file, "is a checkpoint of another run, with options unknown here");
}

void check_same_scene(std::uint64_t found, std::uint64_t wanted, const std::string& file,
                      const std::string& scene) {
    if (found != wanted)
        throw InputError(file, "is a checkpoint of another scene; expected '" + scene +
                                   "' as it is now, with the same --max-edge, --sides, "
                                   "--emission and --reflectance");
}

} // namespace hemilux
