// The core to type (examples/core) and the programs that its diffs make of it: what they compute
// against closed forms and against the page of section 2, patch by patch.
#include "support/catch.h"
#include "support/example_scenes.h"
#include "support/paper_solve.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

using namespace hemilux;
using test::PaperModel;
using test::TemporaryFolder;

namespace {

const std::string scenes = HEMILUX_SOURCE_DIR "/examples/scenes/";

struct Outcome {
    int code;
    std::string log;
    std::map<std::string, std::vector<double>> table; ///< by the names of its columns

    [[nodiscard]] std::size_t rows() const { return table.empty() ? 0 : table.at("patch").size(); }
    [[nodiscard]] Vec3 radiosity(std::size_t i) const {
        return {table.at("radiosity_r")[i], table.at("radiosity_g")[i], table.at("radiosity_b")[i]};
    }
    [[nodiscard]] double standard_error(std::size_t i) const { return table.at("stderr")[i]; }
};

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
        fields.push_back(field);
    return fields;
}

Outcome run(const std::string& program, const std::string& arguments) {
    const TemporaryFolder folder;
    const std::string table = folder.path("table.csv"), log = folder.path("log.txt");
    const int status = std::system(("'" HEMILUX_CORE_FOLDER "/" + program + "' " + arguments +
                                    " >'" + table + "' 2>'" + log + "'")
                                       .c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::content_of(log), {}};
    std::istringstream lines(test::content_of(table));
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> names = fields_of(line);
    while (std::getline(lines, line)) {
        const std::vector<std::string> fields = fields_of(line);
        REQUIRE(fields.size() == names.size());
        for (std::size_t column = 0; column < names.size(); ++column)
            outcome.table[names[column]].push_back(std::stod(fields[column]));
    }
    return outcome;
}

/// The core, and the programs of the diffs that were built.
std::vector<std::string> programs() {
    std::vector<std::string> names;
    std::istringstream words(HEMILUX_CORE_PROGRAMS);
    for (std::string word; words >> word;)
        names.push_back(word);
    return names;
}

/// Those of them that shoot in other ways; the rest print what they count beside the core's light.
std::vector<std::string> ways_to_shoot() {
    std::vector<std::string> names;
    for (const std::string& name : programs())
        if (name == "core" || name[0] >= '3')
            names.push_back(name);
    return names;
}

/// Whether all values are `truth` as far as their standard errors go, which come from so many
/// steps.
bool agree(const std::vector<double>& values, const std::vector<double>& errors,
           const std::vector<double>& truth, int steps) {
    double smallest = 1;
    for (std::size_t i = 0; i < values.size(); ++i)
        smallest = std::min(smallest,
                            test::student_p_value((values[i] - truth[i]) / errors[i], steps - 1));
    return smallest > test::sidak(test::significance, values.size());
}

/// The patches as faces of an OBJ file in the folder, with their materials; returns its path.
std::string write_scene(const Scene& scene, const TemporaryFolder& folder) {
    std::ostringstream obj, mtl;
    obj << "mtllib scene.mtl\n" << std::setprecision(17);
    mtl << std::setprecision(17);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const Vec3 rho = scene.materials[m].reflectance, E = scene.materials[m].emission;
        mtl << "newmtl m" << m << "\nKd " << rho.x << ' ' << rho.y << ' ' << rho.z << "\nKe " << E.x
            << ' ' << E.y << ' ' << E.z << '\n';
    }
    for (const Vec3& v : scene.vertices)
        obj << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (const Facet& facet : scene.facets) {
        obj << "usemtl m" << facet.material << "\nf";
        for (std::size_t k = 0; k < (facet.is_triangle() ? 3 : 4); ++k)
            obj << ' ' << facet.vertex[k] + 1 << "/1";
        obj << '\n';
    }
    folder.write("scene.mtl", mtl.str());
    return folder.write("scene.obj", obj.str());
}

/// Checks the radiosity of the patches that many rays hit one by one, and that of the others, whose
/// spread is not well known, together.
void check_against(const Mesh& mesh, const Solution& truth, const Outcome& outcome, int steps) {
    REQUIRE(outcome.rows() == truth.radiosity.size());
    std::vector<double> off, error;
    double rest = 0, variance_of_rest = 0, squares = 0;
    for (std::size_t i = 0; i < outcome.rows(); ++i) {
        const Vec3 B = truth.radiosity[i], difference = outcome.radiosity(i) - B;
        const double sigma =
            std::hypot(outcome.standard_error(i), glm::length(truth.standard_error[i]));
        const double area = mesh.patches()[i].area;
        if (sigma < .15 * glm::length(B)) {
            off.push_back(glm::dot(difference, B) / glm::length(B));
            error.push_back(sigma);
            squares += off.back() * off.back() / sigma / sigma;
        } else {
            rest += area * (difference.x + difference.y + difference.z);
            variance_of_rest += 3 * area * area * sigma * sigma;
        }
    }
    CHECK(double(off.size()) > .25 * double(outcome.rows()));
    CHECK(agree(off, error, std::vector<double>(off.size(), 0.0), steps));
    CHECK(std::abs(rest) <= 4 * std::sqrt(variance_of_rest));
    // Errors are what they are said to be. Those of three channels are one where all err alike.
    CHECK(squares / double(off.size()) < 1.3);
    CHECK(squares / double(off.size()) > 0.4);
}

} // namespace

TEST_CASE("The core is a file of 200 lines that needs the standard library alone") {
    std::istringstream lines(test::content_of(HEMILUX_SOURCE_DIR "/examples/core/core.cpp"));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        CHECK(line.find("#include \"") == std::string::npos);
    CHECK(count <= 200);
}

TEST_CASE("White furnace: the core and what is made of it have 2 on every patch") {
    constexpr int steps = 16;
    for (const std::string& program : ways_to_shoot()) {
        CAPTURE(program);
        const Outcome outcome = run(program, scenes + "furnace_lshape.obj 16 4");
        REQUIRE(outcome.code == 0);
        REQUIRE(outcome.rows() == 150);
        std::vector<double> B, error;
        double mean = 0;
        for (std::size_t i = 0; i < 150; ++i) {
            B.push_back(outcome.radiosity(i).x + outcome.radiosity(i).y + outcome.radiosity(i).z);
            error.push_back(std::sqrt(3.0) * outcome.standard_error(i)); // channels are alike
            mean += B.back() / 150 / 3;
        }
        CHECK(agree(B, error, std::vector<double>(150, 6.0), steps));
        CHECK(std::abs(mean - 2) < 0.02);
    }
}

TEST_CASE("A furnace of triangles has the radiosity of one of quads") {
    const TemporaryFolder folder;
    const std::string path = write_scene(test::sphere(1, 1.5, .25, 3), folder); // E / (1 - rho) = 4
    for (const std::string& program : ways_to_shoot()) {
        CAPTURE(program);
        const Outcome outcome = run(program, path + " 32 8");
        REQUIRE(outcome.rows() == 32);
        std::vector<double> B, error;
        for (std::size_t i = 0; i < 32; ++i) {
            B.push_back(outcome.radiosity(i).x);
            error.push_back(outcome.standard_error(i) / std::sqrt(3.0));
        }
        CHECK(agree(B, error, std::vector<double>(32, 4.0), 32));
    }
}

TEST_CASE("The core has the published mean radiosity of a cube's faces") {
    const PaperModel model(test::example_scene("cube_96"));
    for (const std::string& program : ways_to_shoot()) {
        CAPTURE(program);
        const Outcome outcome = run(program, scenes + "cube_96.obj 64 2");
        REQUIRE(outcome.rows() == 96);
        std::array<double, 3> sum{}, variance{}; // floor, ceiling, walls
        std::array<int, 3> count{};
        for (std::size_t i = 0; i < 96; ++i) {
            const double up = model.mesh.patches()[i].normal.y;
            const std::size_t face = up > .5 ? 0 : up < -.5 ? 1 : 2;
            sum[face] += outcome.radiosity(i).y;
            variance[face] += outcome.standard_error(i) * outcome.standard_error(i) / 3;
            ++count[face];
        }
        std::vector<double> mean, error;
        for (std::size_t face = 0; face < 3; ++face) {
            mean.push_back(sum[face] / count[face]);
            error.push_back(std::sqrt(variance[face]) / count[face]);
        }
        CHECK(agree(mean, error, {1.10264571, .17182942, .18138122}, 64));
    }
}

TEST_CASE("Counts and shares of the core: a convex room has one surface everywhere") {
    const std::vector<double> light =
        run("core", scenes + "furnace_box.obj 2 1").table.at("radiosity_r");
    for (const std::string& program : programs()) {
        const Outcome outcome = run(program, scenes + "furnace_box.obj 2 1");
        CAPTURE(program);
        if (std::ranges::count(ways_to_shoot(), program) == 0)
            CHECK(outcome.table.at("radiosity_r") == light);
        for (const auto& [name, values] : outcome.table)
            for (const double value : values) {
                if (name.starts_with("octant_") || name == "density" || name == "share")
                    REQUIRE(value == Approx(1).epsilon(1e-8));
                if (name == "triangles")
                    REQUIRE(value == 64);
            }
    }
}

TEST_CASE("The core refuses what it cannot compute, with file and line") {
    const TemporaryFolder folder;
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .9 .1 0\nv 0 1 .3\n";
    for (const char* line : {"f 1 2 3 6", "f 1 3 2 4", "f 1 2 5 4 3", "f 1 2", "f 1 2 7", "f 1 1 2",
                             "f 0 1 2", "v 1 2", "usemtl none", "Kd 1 .5 .5", "Kd .5 .5 -1"}) {
        CAPTURE(line);
        const std::string scene = folder.write("scene.obj", square + "f 1 2 3 4\n" + line + "\n");
        const Outcome outcome = run("core", scene + " 2 1");
        CHECK(outcome.code == 2);
        CHECK(outcome.log == scene + ":8: cannot be read: " + line + "\n");
    }
    CHECK(run("core", folder.path("none.obj")).code == 2);
    CHECK(run("core", "").code == 1);
    CHECK(run("core", scenes + "cube_6.obj 1").code == 1);
}

TEST_CASE("error.awk compares a table of the core with one of the program") {
    const TemporaryFolder folder;
    const std::string core = folder.write("core.csv", "patch,radiosity_r,radiosity_g,radiosity_b,"
                                                      "stderr\n0,2,1,1,.1\n1,3,0,0,.1\n"),
                      truth = folder.write("truth.csv", "patch,group,area,emission_r,emission_g,"
                                                        "emission_b,radiosity_r,radiosity_g,"
                                                        "radiosity_b\n0,wall,2,0,0,0,1,1,1\n"
                                                        "1,detail_x,1,1,0,0,5,0,0\n");
    const std::string script = HEMILUX_SOURCE_DIR "/examples/core/error.awk";
    REQUIRE(std::system(("awk -F, -f '" + script + "' '" + core + "' '" + truth + "' >'" +
                         folder.path("out.txt") + "'")
                            .c_str()) == 0);
    // Errors squared: 2 of 6 in the rest, 4 of 16 in detail.
    CHECK(test::content_of(folder.path("out.txt")) ==
          "all 52.22 %\ndetail 50.00 %\nrest 57.74 %\n");
}

TEST_CASE("The core and what is made of it agree with the matrix of section 2, patch by patch") {
    const TemporaryFolder folder;
    const PaperModel model(test::room_with_block());
    const std::string path = write_scene(model.mesh.scene(), folder);
    SolveOptions options;
    options.rays = 1000;
    const Solution truth = test::solve_page(model, {"section 2", plain::matrix}, options, 1);
    for (const std::string& program : ways_to_shoot()) {
        CAPTURE(program);
        check_against(model.mesh, truth, run(program, path + " 32 4"), 32);
    }
}

TEST_CASE("The core agrees with the page of section 3.3 in a room of 1002 patches", "[slow]") {
    const PaperModel model(test::example_scene("room_1002"));
    SolveOptions options;
    options.rays = 128;
    const Solution truth =
        test::solve_page(model, {"section 3.3", plain::progressive_monte_carlo}, options, 24);
    for (const std::string& program : ways_to_shoot())
        if (program[0] != '4') { // its smallest triangles take long to hit
            CAPTURE(program);
            check_against(model.mesh, truth, run(program, scenes + "room_1002.obj 12 12"), 12);
        }
}
