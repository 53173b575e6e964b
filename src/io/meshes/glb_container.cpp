#include "io/meshes/glb_container.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/little_endian.h"

#include <cstdint>
#include <limits>

namespace hemilux {
namespace {

/// Returns a chunk without its bytes.
std::string chunk_header(std::size_t bytes, std::string_view type) {
    std::string header;
    append_number(header, static_cast<std::uint32_t>(bytes));
    return header + std::string(type);
}

} // namespace

void write_glb_container(const std::string& path, std::string json,
                         std::span<const std::string_view> buffer) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    std::size_t bytes = 0;
    for (const std::string_view part : buffer)
        bytes += part.size();
    const std::size_t length = header_bytes + 2 * chunk_header_bytes + json.size() + bytes;
    if (length > std::numeric_limits<std::uint32_t>::max())
        throw OutputError(path, "would be longer than the 4 GiB of a .glb file");
    std::string header("glTF");
    append_number(header, std::uint32_t{2});
    append_number(header, static_cast<std::uint32_t>(length));
    AtomicFile file(path);
    file.write(header + chunk_header(json.size(), "JSON"));
    file.write(json);
    file.write(chunk_header(bytes, std::string_view("BIN\0", 4)));
    for (const std::string_view part : buffer)
        file.write(part);
    file.commit();
}

} // namespace hemilux
