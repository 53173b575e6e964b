#pragma once
// What commands with --checkpoint and --resume share: the check of these options, and what a run
// must have in common with the one whose checkpoint it goes on from.

#include "app/settings/outputs.h"
#include "app/settings/settings.h"
#include "io/results/checkpoint.h"

#include <cstdint>
#include <functional>
#include <string>

namespace hemilux {

/// Returns whether a checkpoint is read or written. Throws UsageError for --every alone.
[[nodiscard]] bool uses_checkpoint(const CheckpointSettings& settings);

/// Adds the file of --resume to those that are read, unless the run renews it.
void read_resumed_file(const CheckpointSettings& settings, const RunFiles& files);

using CheckpointOptions = decltype(Checkpoint::options);

/// Throws InputError unless the options of a checkpoint are those that are wanted. default_of(name)
/// is the value of an option that is not there; empty: there is none.
void check_same_run(const CheckpointOptions& found, const CheckpointOptions& wanted,
                    const std::string& file,
                    const std::function<std::string(const std::string& name)>& default_of = {});

/// Throws InputError unless the hash of a checkpoint's scene is that of this one.
void check_same_scene(std::uint64_t found, std::uint64_t wanted, const std::string& file,
                      const std::string& scene);

} // namespace hemilux
