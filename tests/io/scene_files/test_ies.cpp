// IES files: what they say at their angles and between, and what is refused.
#include "io/files/error.h"
#include "io/scene_files/ies.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <numbers>
#include <string>

using namespace hemilux;
using Catch::Contains;
using test::TemporaryFolder;

namespace {

const Vec3 down(0, -1, 0), side(1, 0, 0);
constexpr double degree = std::numbers::pi / 180;

std::string file_of(const std::string& numbers, const std::string& tilt = "NONE") {
    return "IESNA:LM-63-2002\r\n[TEST] made up\r\n[MANUFAC] nobody\r\nTILT=" + tilt + "\r\n" +
           numbers;
}

std::shared_ptr<const CandelaTable> table_of(const std::string& text) {
    const TemporaryFolder folder;
    return read_ies(folder.write("lamp.ies", text));
}

/// The intensity at angles [degrees].
double at(const CandelaTable& table, double gamma, double c) {
    const Vec3 across = std::cos(degree * c) * side + std::sin(degree * c) * glm::cross(down, side);
    return table.towards(std::cos(degree * gamma) * down + std::sin(degree * gamma) * across, down,
                         side);
}

} // namespace

TEST_CASE("Intensities are bilinear in both angles, and times all factors") {
    const auto table = table_of(file_of("1 -1 2 3 3 1 2 .1 .1 0\n.5 1 60\n0 45 90\n0 90 180\n"
                                        "100 80 10\n100 60 20\n100 40, 30\n"));
    CHECK(at(*table, 0, 77) == Approx(100));
    CHECK(at(*table, 45, 0) == Approx(80));
    CHECK(at(*table, 45, 45) == Approx(70));
    CHECK(at(*table, 67.5, 135) == Approx(.25 * (60 + 20 + 40 + 30)));
    CHECK(at(*table, 67.5, 225) == Approx(at(*table, 67.5, 135))); // symmetric
    CHECK(at(*table, 90, 180) == Approx(30));
    CHECK(at(*table, 91, 180) == 0);
    CHECK(table->largest() == 100);
}

TEST_CASE("Symmetric tables hold a part of the circle") {
    const std::string lamp = "1 1000 1 2 ";
    const std::string rest = " 1 2 0 0 0 1 1 60 0 180 ";
    const auto round = table_of(file_of(lamp + "1" + rest + "0 10 30"));
    CHECK(at(*round, 90, 123) == Approx(20));
    CHECK(round->flux() == Approx(4 * std::numbers::pi * 20));
    const auto quarter = table_of(file_of(lamp + "2" + rest + "0 90 10 10 30 30"));
    for (const double c : {30.0, 150.0, 210.0, 330.0})
        CHECK(at(*quarter, 90, c) == Approx(10 + 20 * 30 / 90.0));
    CHECK(quarter->flux() == Approx(4 * std::numbers::pi * 20));
    const auto whole = table_of(file_of(lamp + "3" + rest + "0 180 360 10 10 30 30 10 10"));
    CHECK(at(*whole, 90, 90) == Approx(20));
    CHECK(at(*whole, 90, 350) == Approx(10 + 20 * 10 / 180.0));
    const auto other = table_of(file_of(lamp + "2" + rest + "90 270 10 10 30 30"));
    CHECK(at(*other, 90, 45) == Approx(at(*other, 90, 135)));
    CHECK(at(*other, 90, 315) == Approx(at(*other, 90, 225)));
}

TEST_CASE("The flux of a cosine lamp is pi, as far as straight lines follow a cosine") {
    std::string angles, candela;
    for (int k = 0; k <= 90; ++k) {
        angles += std::to_string(k) + " ";
        candela += std::to_string(std::cos(degree * k)) + "\n";
    }
    const auto table =
        table_of(file_of("1 -1 1 91 1 1 2 0 0 0 1 1 9\n" + angles + "\n0\n" + candela));
    CHECK(table->flux() == Approx(std::numbers::pi).epsilon(1e-4));
}

TEST_CASE("What is no photometry of type C has one message with its line") {
    const auto message_of = [](const std::string& text) -> std::string {
        try {
            (void)table_of(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::string rest = " 2 1 1 2 0 0 0 1 1 60\n0 90\n0\n";
    CHECK_THAT(message_of(""), Contains("lamp.ies:0: ") && Contains("its end"));
    CHECK_THAT(message_of("o cube\n"), Contains("lamp.ies:1: ") && Contains("begins with IESNA"));
    CHECK_THAT(message_of(file_of("", "INCLUDE")), Contains(":4: expected TILT=NONE"));
    CHECK_THAT(message_of(file_of("1 x 1" + rest)), Contains(":5: ") && Contains("\"x\""));
    CHECK_THAT(message_of(file_of("1 -1 1 2 1 2")), Contains("type C"));
    CHECK_THAT(message_of(file_of("1 -1 1 0 1 1")), Contains("vertical angles"));
    CHECK_THAT(message_of(file_of("1 -1 1 1.5 1 1")), Contains("vertical angles"));
    CHECK_THAT(message_of(file_of("1 -1 1" + rest + "5")), Contains("its end"));
    CHECK_THAT(message_of(file_of("1 -1 1" + rest + "5 -1")), Contains("0 or more"));
    CHECK_THAT(message_of(file_of("1 -1 1 2 1 1 2 0 0 0 1 1 60\n90 0\n0\n5 5")),
               Contains("ascend"));
    CHECK_THAT(message_of(file_of("1 -1 1 2 2 1 2 0 0 0 1 1 60\n0 90\n0 45\n5 5 5 5")),
               Contains("horizontal angles"));
}
