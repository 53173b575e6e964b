// Matrices as files.
#include "io/files/error.h"
#include "io/results/factor_files.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <array>
#include <cstring>

using namespace hemilux;

namespace {

/// 0 .1 0 / 1e-300 0 2/3 / 0 0 0
SparseMatrix example() { return {{0, 1, 3, 3}, {1, 0, 2}, {.1, 1e-300, 2.0 / 3}}; }

} // namespace

TEST_CASE("A .npy file has NumPy's header and the rows one after the other") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("m.npy");
    write_npy(path, example());
    const std::string bytes = test::content_of(path);
    REQUIRE(bytes.size() > 10);
    CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
    const auto length = static_cast<std::size_t>(static_cast<unsigned char>(bytes[8])) +
                        256 * static_cast<std::size_t>(static_cast<unsigned char>(bytes[9]));
    CHECK((10 + length) % 64 == 0);
    REQUIRE(bytes.size() == 10 + length + 9 * 8);
    const std::string text = bytes.substr(10, length);
    CHECK(text.rfind("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }", 0) == 0);
    CHECK(text.back() == '\n');
    CHECK(text.find_first_not_of(' ', text.find('}') + 1) == text.size() - 1);
    const std::array<double, 9> expected{0, .1, 0, 1e-300, 0, 2.0 / 3, 0, 0, 0};
    std::array<double, 9> numbers{};
    std::memcpy(numbers.data(), bytes.data() + 10 + length, sizeof numbers); // little endian here
    CHECK(numbers == expected);
}

TEST_CASE("The first number begins at a multiple of 64 bytes whatever the size") {
    const test::TemporaryFolder folder;
    for (const std::size_t n : {1u, 9u, 10u, 99u, 100u, 1000u}) {
        const std::string path = folder.path("m.npy");
        SparseMatrix zero;
        zero.row_begin.assign(n + 1, 0);
        write_npy(path, zero);
        CHECK((test::content_of(path).size() - 8 * n * n) % 64 == 0);
    }
}

TEST_CASE("A factor table has a row per factor above 0, with exact numbers") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("m.csv");
    SparseMatrix matrix = example();
    write_factor_table(path, matrix);
    CHECK(test::content_of(path) == "i,j,F\n0,1,0.1\n1,0,1e-300\n1,2,0.6666666666666666\n");
    matrix.value[1] = 0;
    write_factor_table(path, matrix);
    CHECK(test::content_of(path) == "i,j,F\n0,1,0.1\n1,2,0.6666666666666666\n");
}

TEST_CASE("A matrix that cannot be written is an OutputError") {
    const test::TemporaryFolder folder;
    CHECK_THROWS_AS(write_npy(folder.path("none/m.npy"), example()), OutputError);
    CHECK_THROWS_AS(write_factor_table(folder.path("none/m.csv"), example()), OutputError);
    CHECK(folder.files() == 0);
}
