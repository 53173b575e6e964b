// Archives of stored files, read back by a small reader of their own.
#include "io/files/little_endian.h"
#include "io/files/stored_zip.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <map>
#include <string>

using namespace hemilux;

namespace {

struct Stored {
    std::string bytes;
    std::uint32_t checksum;
};

/// Returns the files that the directory at the end of the archive names.
std::map<std::string, Stored> files_of(const std::string& zip) {
    std::map<std::string, Stored> files;
    const std::size_t end = zip.rfind("PK\x05\x06");
    REQUIRE(end != std::string::npos);
    std::size_t at = word_at(zip, end + 16);
    const auto half = [&](std::size_t place) { return bits_at<std::uint16_t>(&zip[place]); };
    for (unsigned left = half(end + 10); left > 0; --left) {
        REQUIRE(zip.substr(at, 4) == "PK\x01\x02");
        CHECK(half(at + 10) == 0); // stored
        const std::uint32_t size = word_at(zip, at + 24), local = word_at(zip, at + 42);
        CHECK(word_at(zip, at + 20) == size);
        REQUIRE(zip.substr(local, 4) == "PK\x03\x04");
        CHECK(word_at(zip, local + 14) == word_at(zip, at + 16));
        const std::string name = zip.substr(at + 46, half(at + 28));
        CHECK(zip.substr(local + 30, half(local + 26)) == name);
        const std::size_t begin = local + 30u + half(local + 26) + half(local + 28);
        files[name] = {zip.substr(begin, size), word_at(zip, at + 16)};
        at += 46u + half(at + 28) + half(at + 30) + half(at + 32);
    }
    CHECK(at == end);
    return files;
}

} // namespace

TEST_CASE("A stored archive gives back its files") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("a.zip");
    {
        StoredZip zip(path);
        zip.add("digits", {"1234", "56789"});
        zip.add("empty.npy", {});
        zip.add("zeros", {std::string(1000, '\0')});
        zip.commit();
    }
    const auto files = files_of(test::content_of(path));
    REQUIRE(files.size() == 3);
    CHECK(files.at("digits").bytes == "123456789");
    CHECK(files.at("digits").checksum == 0xcbf43926u); // the check value of CRC-32
    CHECK(files.at("empty.npy").bytes.empty());
    CHECK(files.at("empty.npy").checksum == 0);
    CHECK(files.at("zeros").bytes == std::string(1000, '\0'));
}

TEST_CASE("An archive that is not finished is no file") {
    const test::TemporaryFolder folder;
    StoredZip(folder.path("a.zip")).add("digits", {"1"});
    CHECK(folder.files() == 0);
}
