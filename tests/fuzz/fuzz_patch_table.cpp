// Any bytes as a patch table: read or refused by InputError, and its columns are of one length.

#include "fuzz/input_file.h"
#include "io/files/error.h"
#include "io/results/tables.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const hemilux::fuzz::InputFile file("a.csv");
    try {
        const hemilux::PatchTable table = hemilux::read_patch_table(file.with(data, size));
        if (table.area.size() != table.radiosity.size() ||
            table.area.size() != table.standard_error.size())
            std::abort();
    } catch (const hemilux::InputError&) {
    }
    return 0;
}
