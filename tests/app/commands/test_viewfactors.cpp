// What `hemilux viewfactors` writes and says.
#include "app/check_fails.h"
#include "app/running.h"
#include "support/catch.h"
#include "support/vtk_arrays.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

using Catch::Contains;
using test::Workplace;

namespace {

/// Rows of a table, by field.
std::vector<std::vector<std::string>> rows_of(const std::string& table) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string>& row = rows.emplace_back();
        std::istringstream fields(line + ",");
        for (std::string field; std::getline(fields, field, ',');)
            row.push_back(field);
    }
    return rows;
}

/// F by i and j of a table i,j,F,standard_error.
std::map<std::array<int, 2>, double> factors_of(const std::string& table) {
    const auto rows = rows_of(table);
    CHECK(rows.front() == std::vector<std::string>{"i", "j", "F", "standard_error"});
    std::map<std::array<int, 2>, double> factors;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        CHECK(std::stod(rows[k][3]) >= 0);
        factors[{std::stoi(rows[k][0]), std::stoi(rows[k][1])}] = std::stod(rows[k][2]);
    }
    return factors;
}

double sum_of_row(const std::map<std::array<int, 2>, double>& factors, int row) {
    double sum = 0;
    for (const auto& [pair, factor] : factors)
        if (pair[0] == row)
            sum += factor;
    return sum;
}

/// An open box of the unit cube without its lid, whose floor is an L and a square: two faces, the
/// first concave.
constexpr const char* open_box = R"(
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v .5 1 0
v .5 .5 0
v 1 .5 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
g floor
f 1 2 7 6 5 4
f 6 7 3 5
g walls
f 1 8 9 2
f 2 9 10 7
f 7 10 3
f 3 10 11 5
f 5 11 4
f 4 11 8 1
)";

/// n x n blocks of different heights, each on a square of ground of its own: 6 n^2 faces.
std::string city(int n) {
    std::ostringstream text;
    int corners = 0;
    const auto quad = [&](const std::array<std::array<double, 3>, 4>& corner) {
        for (const auto& [x, y, z] : corner)
            text << "v " << x << ' ' << y << ' ' << z << '\n';
        text << "f " << corners + 1 << ' ' << corners + 2 << ' ' << corners + 3 << ' '
             << corners + 4 << '\n';
        corners += 4;
    };
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = 20. * i, y = 20. * k, a = x + 4, b = x + 16, c = y + 4, d = y + 14,
                         h = 5 + (7 * i + 5 * k) % 16;
            quad({{{x, y, 0}, {x + 20, y, 0}, {x + 20, y + 20, 0}, {x, y + 20, 0}}});
            quad({{{a, c, h}, {b, c, h}, {b, d, h}, {a, d, h}}});
            quad({{{a, c, 0}, {b, c, 0}, {b, c, h}, {a, c, h}}});
            quad({{{b, c, 0}, {b, d, 0}, {b, d, h}, {b, c, h}}});
            quad({{{b, d, 0}, {a, d, 0}, {a, d, h}, {b, d, h}}});
            quad({{{a, d, 0}, {a, c, 0}, {a, c, h}, {a, d, h}}});
        }
    return text.str();
}

} // namespace

TEST_CASE("viewfactors of a closed room are exact") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("viewfactors room.obj -o f.csv --legend s.csv");
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    for (const char* text : {"24 surfaces of 24 patches", "240 pairs exact, 0 by lines, 0 by rays",
                             "standard errors: factors of at least 0.001: 0 % rms",
                             "reciprocity: ", "wrote f.csv", "wrote s.csv"})
        CHECK_THAT(outcome.err, Contains(text));
    const auto factors = factors_of(place.read("f.csv"));
    for (int row = 0; row < 24; ++row)
        CHECK(sum_of_row(factors, row) == Approx(1).margin(1e-12));
    CHECK(rows_of(place.read("s.csv")).size() == 25);
}

TEST_CASE("viewfactors rows are faces of the file, concave ones too, or groups") {
    const Workplace place;
    place.write("box.obj", open_box);
    REQUIRE(place.hemilux("viewfactors box.obj -q --sky -o f.csv --legend s.csv").code == 0);
    const auto legend = rows_of(place.read("s.csv"));
    REQUIRE(legend.size() == 1 + 8 + 1); // eight faces and the sky
    CHECK(legend[1][1] == "0");
    CHECK(std::stod(legend[1][6]) == Approx(.75)); // area of the L
    CHECK(legend[9][0] == "8");
    CHECK(legend[9][1] == "sky");
    CHECK(legend[9].size() == legend[0].size());
    const auto factors = factors_of(place.read("f.csv"));
    for (int row = 0; row < 8; ++row)
        CHECK(sum_of_row(factors, row) == Approx(1).margin(1e-12));

    REQUIRE(place.hemilux("viewfactors box.obj -q --by group --sky -o g.csv").code == 0);
    const auto groups = factors_of(place.read("g.csv"));
    // The whole floor sees the open lid by .19982490 (opposed squares) and walls by the rest.
    CHECK(groups.at({0, 2}) == Approx(.19982490).margin(1e-8));
    CHECK(groups.at({0, 1}) == Approx(1 - .19982490).margin(1e-8));
    CHECK(groups.at({1, 0}) == Approx(.25 * (1 - .19982490)).margin(1e-8));
}

TEST_CASE("viewfactors between two named surfaces") {
    const Workplace place;
    place.write("box.obj", open_box);
    const auto outcome =
        place.hemilux("viewfactors box.obj --by group --of pair:floor,walls --error .5% -o g.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("F from 'floor' to 'walls' 0.800175"));
    for (const char* of : {"rows", "largest", "above:1%"})
        CHECK(place.hemilux("viewfactors box.obj -q --of " + std::string(of) + " -o h.csv").code ==
              0);
}

TEST_CASE("viewfactors writes sparse and dense arrays, cells and uDALES' files") {
    const Workplace place;
    place.write("box.obj", open_box);
    const auto outcome = place.hemilux("viewfactors box.obj -o f.npz -o f.npy -o f.vtu "
                                       "-o vfsparse.inp.001 -o svf.inp.001 -o f.csv");
    REQUIRE(outcome.code == 0);
    CHECK(place.read("f.npy").size() == 128 + 8 * 8 * 8);
    const std::string npz = place.read("f.npz");
    for (const char* name : {"indices.npy", "indptr.npy", "format.npy", "shape.npy", "data.npy",
                             "standard_error.npy", "area.npy", "name.npy"})
        CHECK_THAT(npz, Contains(name));
    CHECK_THAT(npz, Contains("{'descr': '|S3', 'fortran_order': False, 'shape': (), }"));
    for (const char* name : {"\"sky\"", "\"row_sum\"", "\"unlisted_bound\"", "\"surface\""})
        CHECK_THAT(place.read("f.vtu"), Contains(name));
    const auto factors = factors_of(place.read("f.csv"));
    std::istringstream udales(place.read("vfsparse.inp.001"));
    int i = 0, j = 0;
    double factor = 0;
    std::size_t count = 0;
    for (; udales >> i >> j >> factor; ++count)
        CHECK(factor == Approx(factors.at({i - 1, j - 1})).margin(6e-9));
    CHECK(count == factors.size());
    std::istringstream sky(place.read("svf.inp.001"));
    std::string line;
    std::getline(sky, line);
    CHECK(line == "# sky view factors");
    for (int row = 0; row < 8; ++row) {
        REQUIRE(sky >> factor);
        CHECK(factor == Approx(1 - sum_of_row(factors, row)).margin(1e-7));
    }
}

TEST_CASE("viewfactors gives the same bytes whatever the threads") {
    const Workplace place;
    place.write("box.obj", open_box);
    for (const char* threads : {"1", "3"})
        CHECK(place
                  .hemilux("viewfactors box.obj -q -t " + std::string(threads) + " -o " + threads +
                           ".npz")
                  .code == 0);
    CHECK(place.read("1.npz") == place.read("3.npz"));
}

TEST_CASE("viewfactors writes bands, sunlight and points as cells of VTK") {
    const Workplace place;
    place.write("box.obj", open_box);
    place.write("points.txt", ".2,.5,0,0,0,1\n.9,.5,0,0,0,1\n");
    place.write("suns.txt", "-1,0,-2\n0,0,-1\n");
    REQUIRE(place
                .hemilux("viewfactors box.obj -q --by group --sky-bands 3 --suns suns.txt "
                         "--sunlit s.csv --points points.txt -o f.vtu --legend l.csv")
                .code == 0);
    const auto arrays = hemilux::test::arrays_of(place.read("f.vtu"));
    const auto legend = rows_of(place.read("l.csv")), sunlit = rows_of(place.read("s.csv"));
    const std::vector<double>& surface = arrays.at("surface");
    const std::size_t cells = surface.size(), points = 2;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        CHECK((arrays.at("types")[cell] == 1) == (cell + points >= cells));
        const auto& row = legend.at(static_cast<std::size_t>(surface[cell]) + 1);
        double sum = 0;
        for (const char* const band : {"sky 0-30", "sky 30-60", "sky 60-90"}) {
            sum += arrays.at(band)[cell];
            const auto column = std::ranges::find(legend[0], band) - legend[0].begin();
            const auto at = static_cast<std::size_t>(column);
            CHECK(arrays.at(band)[cell] == std::stod(row[at]));
            CHECK(arrays.at(std::string(band) + "_standard_error")[cell] == std::stod(row[at + 1]));
        }
        CHECK(sum == Approx(arrays.at("sky")[cell]));
        CHECK(arrays.at("row_sum")[cell] == Approx(1));
        for (std::size_t k = 1; k < sunlit.size(); ++k)
            if (std::stod(sunlit[k][1]) == surface[cell])
                CHECK(arrays.at("sunlit_" + sunlit[k][0])[cell] == std::stod(sunlit[k][2]));
    }
    // Corners of the points are the last.
    const std::vector<double>& corners = arrays.at("points");
    CHECK(corners.at(corners.size() - 6) == .2);
    REQUIRE(place.hemilux("viewfactors box.obj -q --of sky --sun 0,0,-1 --sunlit s.csv -o g.vtu")
                .code == 0);
    CHECK(hemilux::test::arrays_of(place.read("g.vtu")).at("sunlit").size() == cells - points);
}

TEST_CASE("viewfactors names surfaces that see nothing but backs") {
    const Workplace place;
    place.write("turned.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -9 -9 .1\nv 9 -9 .1\nv 9 9 .1\n"
                "v -9 9 .1\nf 1 2 3 4\nf 5 6 7 8\n");
    const auto outcome = place.hemilux("viewfactors turned.obj -o a.csv");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("1 surface sees nothing but backs of faces ('0')"));
}

TEST_CASE("viewfactors of the sky alone computes no other factors") {
    const Workplace place;
    place.write("box.obj", open_box);
    const auto outcome = place.hemilux("viewfactors box.obj --by group --of sky --error .5% -o "
                                       "svf.inp.001 -o s.vtu --legend s.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("2 surfaces of ") && Contains("sky: 0."));
    const auto legend = rows_of(place.read("s.csv"));
    CHECK(legend[1][1] == "floor");
    CHECK(std::stod(legend[1][13]) == Approx(.19982490).epsilon(.015));
    CHECK(std::stod(legend[1][14]) < .005 * .2);
    CHECK(legend[1][19].empty()); // the sum of the row is not known
    test::check_fails(place, 1, "viewfactors box.obj --of sky -o a.csv", "svf.inp... or .vtu");
}

TEST_CASE("viewfactors --points adds rows that are exact and sum to 1") {
    const Workplace place;
    place.write("box.obj", open_box);
    place.write("points.txt", "x,y,z,nx,ny,nz\n.5,.5,0,0,0,1 # on the floor\n.5 .5 .5 0 2 0\n");
    const auto outcome = place.hemilux("viewfactors box.obj --by group --sky --points points.txt "
                                       "-o f.csv -o f.npz -o f.npy --legend s.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("2 points: 3 of 3 factors exact"));
    const auto factors = factors_of(place.read("f.csv"));
    // Rows are floor, walls, sky and the points. From the middle of the floor a square at the
    // height 1 has the factor 2 / pi sqrt(.2) atan(sqrt(.2)) times 2 (Howell's catalogue, B-3).
    CHECK(factors.at({3, 2}) ==
          Approx(4 / 3.14159265358979 * std::sqrt(.2) * std::atan(std::sqrt(.2))));
    CHECK(factors.at({3, 1}) == Approx(1 - factors.at({3, 2})));
    CHECK(sum_of_row(factors, 4) == Approx(1).margin(1e-12));
    CHECK(factors.at({4, 0}) == Approx(factors.at({4, 2}))); // as high above as below
    const auto legend = rows_of(place.read("s.csv"));
    REQUIRE(legend.size() == 1 + 5);
    CHECK(legend[4][1] == "point 0");
    CHECK(legend[5][0] == "4");
    CHECK(legend[5][11] == "2"); // the normal as it was given
    CHECK(std::stod(legend[5][13]) == Approx(factors.at({4, 2})));
    CHECK(legend[4].size() == legend[0].size());
    CHECK(place.read("f.npy").size() == 128 + 5 * 3 * 8);
    CHECK_THAT(place.read("f.npy"), Contains("'shape': (5, 3)"));
    CHECK_THAT(place.read("f.npz"), Contains("point 1"));
    const auto fails = [&](const std::string& points, const std::string& message) {
        place.write("bad.txt", points);
        test::check_fails(place, 2, "viewfactors box.obj --points bad.txt -o g.csv", message);
    };
    fails("1 2 3\n", "bad.txt:1: expected six numbers");
    fails("0 0 0 0 0 1\n0 0 0 0 0 0\n", "bad.txt:2: expected a normal");
    fails("0 0 1e9 0 0 1\n", "bad.txt:1: expected a point near the scene");
    test::check_fails(place, 2, "viewfactors box.obj --points none.txt -o g.csv", "none.txt");
    test::check_fails(place, 1,
                      "viewfactors box.obj --points points.txt -o ./points.csv "
                      "--legend points.csv",
                      "named twice");
}

TEST_CASE("viewfactors --sky-bands divides the column of the sky") {
    const Workplace place;
    place.write("box.obj", open_box);
    place.write("points.txt", ".5,.5,0,0,0,1\n");
    for (const char* bands : {"6", "tregenza"}) {
        const std::size_t count = bands[0] == '6' ? 6 : 145;
        REQUIRE(place
                    .hemilux("viewfactors box.obj -q --by group --ground --points points.txt "
                             "--sky-bands " +
                             std::string(bands) + " -o f.csv -o f.npz --legend s.csv")
                    .code == 0);
        const auto factors = factors_of(place.read("f.csv"));
        const auto legend = rows_of(place.read("s.csv"));
        REQUIRE(legend.size() == 1 + 2 + count + 1 + 1);
        for (const auto& row : legend)
            CHECK(row.size() == 21 + 2 * count);
        const int ground = 2 + static_cast<int>(count);
        CHECK(legend[static_cast<std::size_t>(ground) + 1][1] == "ground");
        for (const std::size_t row : {std::size_t{1}, legend.size() - 1}) {
            const int i = std::stoi(legend[row][0]);
            double of_legend = 0, of_matrix = 0;
            for (std::size_t k = 0; k < count; ++k) {
                of_legend += std::stod(legend[row][21 + 2 * k]);
                CHECK(std::stod(legend[row][22 + 2 * k]) > 0);
            }
            for (const auto& [pair, factor] : factors)
                of_matrix += pair[0] == i && pair[1] >= 2 && pair[1] < ground ? factor : 0;
            CHECK(of_legend == Approx(std::stod(legend[row][13])));
            CHECK(of_matrix == Approx(of_legend));
            CHECK(sum_of_row(factors, i) == Approx(1).margin(1e-12));
        }
    }
    CHECK(rows_of(place.read("s.csv"))[3 + 1][1] == "sky 2");
    REQUIRE(place.hemilux("viewfactors box.obj -q --of sky --sky-bands 3 -o a.vtu --legend t.csv")
                .code == 0);
    CHECK_THAT(place.read("t.csv"), Contains(",sky 0-30,sky 0-30 standard error,sky 30-60"));
    for (const char* bands : {"0", "91", "2.5", "reinhart"})
        test::check_fails(place, 1,
                          "viewfactors box.obj -o a.csv --sky-bands " + std::string(bands),
                          "a whole number from 1 to 90 or tregenza");
}

TEST_CASE("viewfactors --sunlit writes the sunlit share of surfaces and points for each sun") {
    const Workplace place;
    place.write("box.obj", open_box);
    place.write("suns.txt", "x,y,z\n-1,0,-1 # from the east at 45 degrees\n0 0 2\n");
    place.write("points.txt", ".2,.5,0,0,0,1\n.9,.5,0,0,0,1\n");
    const auto outcome =
        place.hemilux("viewfactors box.obj --by group --sun 0,0,-3 --suns suns.txt "
                      "--points points.txt --sunlit s.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("3 suns: 6 of 6 sunlit fractions exact") &&
                                Contains("wrote s.csv") &&
                                Contains("warning: 1 sun shines from below the horizon"));
    // Suns by surfaces 0 and 1 and points 2 and 3. The inside of the walls is 4, of which the west
    // is in the sun at 45 degrees; the floor is in the shade of the east.
    CHECK(place.read("s.csv") == "sun,surface,sunlit,standard_error\n"
                                 "0,0,1,0\n0,1,0,0\n0,2,1,0\n0,3,1,0\n"
                                 "1,0,0,0\n1,1,0.25,0\n1,2,0,0\n1,3,0,0\n"
                                 "2,0,0,0\n2,1,0,0\n2,2,0,0\n2,3,0,0\n");
    REQUIRE(
        place
            .hemilux("viewfactors box.obj -q --by group --sky --sun -1,0,-2 --points points.txt "
                     "--sunlit t.csv -o f.csv --legend l.csv")
            .code == 0);
    // Half of the floor; points follow the sky in the legend.
    CHECK_THAT(place.read("t.csv"), Contains("\n0,0,0.5,0\n") && Contains("\n0,3,1,0\n0,4,0,0\n"));
    CHECK(rows_of(place.read("l.csv"))[4][0] == "3");
    const auto fails = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "viewfactors box.obj " + arguments, message);
    };
    fails(1, "--sunlit s.csv", "name the sun by --sun or --suns");
    fails(1, "--sun 0,0,1 -o a.csv", "are for --sunlit FILE.csv");
    fails(1, "--sun 0,0,0 --sunlit a.csv", "three numbers X,Y,Z that are not all 0");
    fails(1, "--sun 0,0,1 --sunlit a.txt", ".csv");
    place.write("suns.txt", "1 0 1\n0 0 0\n");
    fails(2, "--suns suns.txt --sunlit a.csv", "suns.txt:2: expected a direction x,y,z");
    place.write("suns.txt", "1 0 1 0\n");
    fails(2, "--suns suns.txt --sunlit a.csv", "suns.txt:1: expected three numbers x,y,z, then");
}

TEST_CASE("viewfactors --time writes what is known when the time is over, with its error") {
    const Workplace place;
    place.write("city.obj", city(6));
    const auto outcome =
        place.hemilux("viewfactors city.obj --error .1% --time .01 --sky -o f.csv --legend l.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("the run was ended: ") &&
                                Contains("where 0.1 % was asked for; the run was ended before"));
    const auto legend = rows_of(place.read("l.csv"));
    for (std::size_t row = 1; row <= 216; ++row)
        CHECK(std::stod(legend[row][19]) == Approx(1).margin(1e-9));
    REQUIRE(place.hemilux("viewfactors city.obj -q --error 10% --time 1h -o a.csv").code == 0);
    REQUIRE(place
                .hemilux("viewfactors city.obj -q --error .1% --of sky --time .01 -o s.vtu "
                         "--sun -1,-1,-1 --sunlit s.csv")
                .code == 0);
    CHECK(rows_of(place.read("s.csv")).size() == 1 + 216); // all of it
    test::check_fails(place, 1, "viewfactors city.obj --time 0 -o b.csv", "--time");
}

TEST_CASE("viewfactors writes what is known after Ctrl-C") {
    const Workplace place;
    place.write("city.obj", city(18));
    std::string said;
    for (double seconds = 1; seconds <= 64; seconds *= 2) { // the first rays take that long
        test::Running run(place,
                          "viewfactors city.obj --error .01% -o f.csv --legend l.csv --sun 0,0,-1 "
                          "--sunlit s.csv",
                          place.path("stderr.txt").c_str());
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        run.interrupt();
        CHECK(run.wait() == 130);
        said = place.read("stderr.txt");
        if (said.find("nothing was written") == std::string::npos && !said.empty())
            break;
    }
    for (const char* text : {"the run was ended: ", "wrote f.csv", "wrote l.csv", "left out s.csv"})
        CHECK_THAT(said, Contains(text));
    const auto factors = factors_of(place.read("f.csv"));
    const auto legend = rows_of(place.read("l.csv"));
    REQUIRE(legend.size() == 1 + 18 * 18 * 6);
    for (std::size_t row = 1; row < legend.size(); row += 100)
        CHECK(std::stod(legend[row][19]) == Approx(1).margin(1e-9));
    CHECK_FALSE(place.has("s.csv"));
}

TEST_CASE("viewfactors goes on from a checkpoint to the bytes of a run that was not ended") {
    const Workplace place;
    place.write("city.obj", city(8));
    const std::string run = "viewfactors city.obj --error .3% --sky ";
    REQUIRE(place.hemilux(run + "-o whole.csv --legend whole_rows.csv").code == 0);
    const std::string kept = run + "-o f.csv --legend l.csv --checkpoint saved --every 0";
    test::Running killed(place, kept, place.path("stderr.txt").c_str());
    REQUIRE(test::wait_until([&] { return place.has("saved"); }));
    killed.send(SIGKILL);
    (void)killed.wait();
    const auto outcome = place.hemilux(kept + " --resume saved -t 2");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("resumed: ") && Contains("of 384 patches were measured in"));
    CHECK(place.read("f.csv") == place.read("whole.csv"));
    CHECK(place.read("l.csv") == place.read("whole_rows.csv"));
    // One that is complete gives other rows, too.
    const auto groups = place.hemilux(run + "--by group -o g.csv --resume saved");
    REQUIRE(groups.code == 0);
    CHECK_THAT(groups.err, Contains("resumed: 384 of 384 patches"));
    REQUIRE(place.hemilux(run + "--by group -o again.csv").code == 0);
    CHECK(place.read("g.csv") == place.read("again.csv"));

    const auto fails = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "viewfactors " + arguments, message);
    };
    fails(2, "city.obj --error .3% --seed 2 -o a.csv --resume saved",
          "expected --seed 2, it has 1");
    fails(2, "city.obj -o a.csv --resume saved", "expected --error 0.01, it has 0.003");
    place.write("other.obj", city(7));
    fails(2, "other.obj --error .3% -o a.csv --resume saved", "of another scene");
    fails(2, "city.obj -o a.csv --resume none", "none");
    fails(1, "city.obj --of sky --legend a.csv -o svf.inp.a --checkpoint s",
          "--of sky keeps no rows");
    fails(1, "city.obj -o a.csv --every 1m", "--checkpoint");
    fails(1, "city.obj -o a.csv --checkpoint ./a.csv", "named twice");
    fails(3, "city.obj -o a.csv --checkpoint nowhere/saved", "nowhere");
    place.write("saved", place.read("saved").substr(0, 999));
    fails(2, "city.obj --error .3% -o a.csv --resume saved", "damaged checkpoint");
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("viewfactors says what is wrong with what it is asked") {
    const Workplace place;
    place.write("box.obj", open_box);
    const auto fails = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "viewfactors " + arguments, message);
    };
    fails(1, "box.obj", "--output");
    fails(1, "box.obj -o a.png", ".csv, .npz, .npy or .vtu");
    fails(1, "box.obj -o a.csv --rays 1000", "a power of two from 256");
    fails(1, "box.obj -o a.csv --error 2", "2%");
    fails(1, "box.obj -o a.csv --by wall", "--by");
    for (const char* of : {"above:2", "above:", "pair:a", "pair:,b", "sum"})
        fails(1, "box.obj -o a.csv --of " + std::string(of), "above:F with F from 1e-6 to 1");
    fails(1, "box.obj -o a.csv --of pair:floor,wall --by group", "no surface is called 'wall'");
    fails(1, "box.obj -o a.csv --legend ./a.csv", "named twice");
    fails(2, "none.obj -o a.csv", "none.obj");
    fails(3, "box.obj -o nowhere/a.csv", "nowhere");
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("viewfactors refuses a dense matrix above a gigabyte before it computes one") {
    const Workplace place;
    std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int k = 0; k < 11200; ++k)
        many += "f 1 2 3\n";
    place.write("many.obj", many);
    test::check_fails(place, 1, "viewfactors many.obj -o a.npy", "write .npz instead");
}

TEST_CASE("exchange writes temperatures and heat of surfaces") {
    const Workplace place;
    place.write("box.obj", open_box);
    place.write("known.csv", "surface,emissivity,temperature,flux\nfloor,0.9,310,\nwall*,0.8,,0\n");
    const std::string run = "exchange box.obj --by group --surfaces known.csv -o h.csv ";
    const auto outcome = place.hemilux(run + "--sky-temperature 260");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("heat: ") && Contains("wrote h.csv"));
    const auto table = rows_of(place.read("h.csv"));
    REQUIRE(table.size() == 1 + 2 + 1);
    CHECK(table[0] == std::vector<std::string>{"surface", "area", "emissivity", "temperature",
                                               "temperature_error", "irradiation",
                                               "irradiation_error", "flux", "flux_error", "heat",
                                               "heat_error"});
    // A box that is open above, with insulated walls: the floor gives to the sky by way of both.
    const double direct = .19982490, to_walls = 1 - direct;
    const double sigma = 5.670374419e-8, resistance = .1 / .9 + 1 / (direct + to_walls / 2);
    const double heat = sigma * (std::pow(310, 4) - std::pow(260, 4)) / resistance;
    CHECK(table[1][0] == "floor");
    CHECK(std::stod(table[1][9]) == Approx(heat).epsilon(1e-6));
    CHECK(std::stod(table[2][9]) == 0);
    CHECK(std::stod(table[2][3]) > 260);
    CHECK(table[3][0] == "sky");
    CHECK(std::stod(table[3][9]) == Approx(-heat).epsilon(1e-6));

    const auto fails = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "exchange box.obj --by group " + arguments, message);
    };
    fails(1, "--surfaces known.csv -o a.csv", "--sky-temperature: say how warm it is");
    fails(1, "--surfaces known.csv -o a.csv --sky-temperature -3", "--sky-temperature");
    fails(1, "--surfaces known.csv", "--output");
    fails(1, "-o a.csv", "--surfaces");
    fails(1, "--surfaces known.csv -o ./known.csv", "known.csv");
    fails(1, "--surfaces known.csv -o a.csv --sky-temperature 3 --of sky", "--of sky");
    fails(2, "--surfaces none.csv -o a.csv", "none.csv");
    const auto refuses = [&](const std::string& rows, const std::string& message) {
        place.write("bad.csv", rows);
        fails(2, "--surfaces bad.csv -o a.csv --sky-temperature 270", message);
    };
    const std::string header = "surface,emissivity,temperature,flux\n";
    refuses("", "is empty");
    refuses("surface,emissivity\n", "expected a header");
    refuses(header + "*,.5,300\n", "expected 4 fields, got 3");
    refuses(header + "*,1.5,300,\n", "bad.csv:2: expected an emissivity from 0 to 1");
    refuses(header + "*,,300,\n", "an emissivity");
    refuses(header + "*,.5,300,0\n", "a temperature or a flux");
    refuses(header + "*,.5,,\n", "a temperature or a flux");
    refuses(header + "*,.5,-1,\n", "at least 0 K");
    refuses(header + "*,.5,warm,\n", "expected a number in column 'temperature'");
    refuses(header + "*,0,,5\n", "a flux of 0 where the emissivity is 0");
    refuses(header + "floor,.5,300,\n", "says nothing of the surface 'walls'");
    refuses(header + "*,.5,300,\nroof,.5,300,\n", "bad.csv:3: no surface is called 'roof'");
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("by patch the rows of viewfactors are those of formfactors") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("viewfactors room.obj -q --by patch -o v.csv --legend l.csv").code == 0);
    REQUIRE(place.hemilux("formfactors room.obj -q --exact -o f.csv").code == 0);
    const auto names = rows_of(place.read("l.csv"));
    REQUIRE(names.size() == 25);
    for (std::size_t k = 1; k < names.size(); ++k)
        CHECK(names[k][1] == std::to_string(k - 1));
    const auto factors = factors_of(place.read("v.csv"));
    const auto rows = rows_of(place.read("f.csv"));
    CHECK(factors.size() == rows.size() - 1);
    for (std::size_t k = 1; k < rows.size(); ++k)
        CHECK(factors.at({std::stoi(rows[k][0]), std::stoi(rows[k][1])}) ==
              Approx(std::stod(rows[k][2])).epsilon(1e-3));
}
