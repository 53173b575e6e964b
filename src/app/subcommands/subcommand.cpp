#include "app/subcommands/subcommand.h"

#include "io/files/provenance.h"

#include <array>

namespace hemilux {

Provenance provenance(const Command& command, std::uint64_t seed) {
    constexpr auto beside = std::to_array<std::string_view>(
        {"--output", "--stats", "--steps-log", "--error-map", "--points-output", "--report",
         "--every-step", "--legend", "--threads", "--memory", "--checkpoint", "--every", "--resume",
         "--quiet", "--verbose", "--config"});
    return {"hemilux " HEMILUX_VERSION, "hemilux " + command.text_given(beside), seed};
}

} // namespace hemilux
