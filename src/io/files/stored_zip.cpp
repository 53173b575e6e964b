#include "io/files/stored_zip.h"

#include "io/files/little_endian.h"

#include <array>

namespace hemilux {
namespace {

constexpr std::uint64_t too_large = 0xffffffff; ///< for fields of 32 bits

/// Returns the table of the CRC-32 of ISO 3309, with its bits reversed.
constexpr std::array<std::uint32_t, 256> crc_table = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t value = byte;
        for (int bit = 0; bit < 8; ++bit)
            value = (value & 1) != 0 ? 0xedb88320u ^ (value >> 1) : value >> 1;
        table[byte] = value;
    }
    return table;
}();

/// Returns the checksum of more bytes, where `crc` is that of those before.
std::uint32_t checksum_of(std::string_view bytes, std::uint32_t crc) {
    crc = ~crc;
    for (const char c : bytes)
        crc = crc_table[(crc ^ static_cast<unsigned char>(c)) & 0xff] ^ (crc >> 8);
    return ~crc;
}

std::uint32_t field(std::uint64_t value) {
    return static_cast<std::uint32_t>(value < too_large ? value : too_large);
}

/// What local headers and the directory have in common: version, flags, no compression, the first
/// of January 1980, checksum and sizes.
void append_common(std::string& bytes, std::uint32_t checksum, std::uint64_t size,
                   std::size_t name_length, std::size_t extra_length, bool large) {
    append_number(bytes, static_cast<std::uint16_t>(large ? 45 : 20));
    append_number(bytes, std::uint16_t{0});
    append_number(bytes, std::uint16_t{0});
    append_number(bytes, std::uint16_t{0});
    append_number(bytes, std::uint16_t{0x21});
    append_number(bytes, checksum);
    append_number(bytes, large ? static_cast<std::uint32_t>(too_large) : field(size));
    append_number(bytes, large ? static_cast<std::uint32_t>(too_large) : field(size));
    append_number(bytes, static_cast<std::uint16_t>(name_length));
    append_number(bytes, static_cast<std::uint16_t>(extra_length));
}

} // namespace

void StoredZip::write(std::string_view bytes) {
    file_.write(bytes);
    written_ += bytes.size();
}

void StoredZip::add_given(const std::string& name,
                          const std::function<void(const Sink& sink)>& give) {
    Entry entry{name, 0, 0, written_};
    give([&entry](std::string_view part) {
        entry.checksum = checksum_of(part, entry.checksum);
        entry.size += part.size();
    });
    const bool large = entry.size >= too_large;
    std::string extra;
    if (large) {
        append_number(extra, std::uint16_t{1});
        append_number(extra, std::uint16_t{16});
        append_number(extra, entry.size);
        append_number(extra, entry.size);
    }
    std::string header = "PK\x03\x04";
    append_common(header, entry.checksum, entry.size, name.size(), extra.size(), large);
    write(header + name + extra);
    give([this](std::string_view part) { write(part); });
    entries_.push_back(entry);
}

void StoredZip::commit() {
    const std::uint64_t directory = written_;
    bool needs_64 = directory >= too_large || entries_.size() >= 0xffff;
    for (const Entry& entry : entries_) {
        const bool large = entry.size >= too_large || entry.place >= too_large;
        needs_64 = needs_64 || large;
        std::string extra;
        if (large) {
            append_number(extra, std::uint16_t{1});
            append_number(extra, std::uint16_t{24});
            append_number(extra, entry.size);
            append_number(extra, entry.size);
            append_number(extra, entry.place);
        }
        std::string header = "PK\x01\x02";
        append_number(header, std::uint16_t{45}); // made by
        append_common(header, entry.checksum, entry.size, entry.name.size(), extra.size(), large);
        append_number(header, std::uint16_t{0}); // comment
        append_number(header, std::uint16_t{0}); // disk
        append_number(header, std::uint16_t{0}); // attributes within
        append_number(header, std::uint32_t{0}); // and outside
        append_number(header, large ? static_cast<std::uint32_t>(too_large) : field(entry.place));
        write(header + entry.name + extra);
    }
    const std::uint64_t size = written_ - directory, count = entries_.size();
    if (needs_64) {
        const std::uint64_t place = written_;
        std::string end = "PK\x06\x06";
        append_number(end, std::uint64_t{44}); // what follows of this record
        append_number(end, std::uint16_t{45});
        append_number(end, std::uint16_t{45});
        append_number(end, std::uint32_t{0});
        append_number(end, std::uint32_t{0});
        append_number(end, count);
        append_number(end, count);
        append_number(end, size);
        append_number(end, directory);
        end += "PK\x06\x07";
        append_number(end, std::uint32_t{0});
        append_number(end, place);
        append_number(end, std::uint32_t{1});
        write(end);
    }
    std::string end = "PK\x05\x06";
    append_number(end, std::uint16_t{0});
    append_number(end, std::uint16_t{0});
    const auto short_count = static_cast<std::uint16_t>(count < 0xffff ? count : 0xffff);
    append_number(end, short_count);
    append_number(end, short_count);
    append_number(end, needs_64 ? static_cast<std::uint32_t>(too_large) : field(size));
    append_number(end, needs_64 ? static_cast<std::uint32_t>(too_large) : field(directory));
    append_number(end, std::uint16_t{0});
    write(end);
    file_.commit();
}

} // namespace hemilux
