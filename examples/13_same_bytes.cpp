// Shows that results have the same bytes on every machine: by each compiler, each instruction set
// and each C library.
//
//   examples/13_same_bytes [TABLE]
//
// It prints a row for each method and its page on three scenes, and on two of them for each of its
// options: a hash of all bits of the radiosity and of its standard errors. Given a table of such
// rows (13_same_bytes.txt), it prints those that the table does not have. It ends with 1 if there
// are any.
#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/example_scenes.h"

#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

/// FNV-1a of Fowler, Noll and Vo. All NaN count as the same, as machines give them different signs.
class Hash {
  public:
    void add(double number) {
        std::uint64_t bits = std::isnan(number) ? 0x7ff8u : std::bit_cast<std::uint64_t>(number);
        for (int byte = 0; byte < 8; ++byte, bits >>= 8)
            hash_ = (hash_ ^ (bits & 0xff)) * 0x100000001b3;
    }
    void add(const std::vector<Vec3>& vectors) {
        for (const Vec3& v : vectors)
            for (int c = 0; c < 3; ++c)
                add(v[c]);
    }
    [[nodiscard]] unsigned long long value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// A scene whose rows are made.
struct Room {
    explicit Room(const std::string& scene)
        : name(scene), mesh(test::example_scene(scene)), needs(find_needs(mesh)),
          tracer(make_tracer(mesh, 1).tracer) {}

    void add(const std::string& what, const Hash& hash) {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", hash.value());
        rows.push_back(std::string(text) + "  " + name + "  " + what);
    }

    std::string name;
    Mesh mesh;
    Needs needs;
    std::unique_ptr<Tracer> tracer;
    std::vector<std::string> rows;
};

constexpr std::uint32_t steps = 2;
const SolveOptions usual{.rays = 16, .threads = 1};

/// make(input) makes the method's solver, or its page.
template <class Make>
void solve(Room& room, const std::string& what, Make make, const SolveOptions& options) {
    Monitor monitor;
    const auto solver = make({room.mesh, *room.tracer, options, monitor, room.needs});
    for (std::uint32_t step = 0; step < steps && !solver->finished(); ++step)
        if (!solver->step())
            throw std::runtime_error(what + " was interrupted");
    Hash hash;
    hash.add(solver->solution().radiosity);
    hash.add(solver->solution().standard_error);
    room.add(what, hash);
}

/// Returns whether a method takes options, which may be too much for it.
bool takes(const Method& method, const SolveOptions& options, std::size_t patches) {
    try {
        if (method.check)
            method.check(options, patches);
        return true;
    } catch (const std::invalid_argument&) {
        return false;
    }
}

/// Calls use(text, options) for every value of an option but that which it has anyway.
template <class Use>
void for_values(const MethodOption& option, const Use& use) {
    const auto is_placeholder = [](const std::string& value) { // as the N of hemicube:N
        return std::isupper(static_cast<unsigned char>(value.back())) != 0;
    };
    const std::vector<std::string> yes{"yes"};
    for (const std::string& value : option.values.empty() ? yes : option.values) {
        SolveOptions with = usual;
        if (!is_placeholder(value) && option.set(with, value) && option.is_set(with))
            use(option.text(with), with);
    }
}

void solve_by(Room& room, const Method& method) {
    const std::string name(method.name);
    solve(room, name, method.make, usual);
    if (method.plain && room.mesh.patches().size() <= method.max_plain_patches)
        solve(room, name + " --plain", method.plain, usual);
}

void solve_with_options(Room& room, const Method& method) {
    const std::string name(method.name);
    if (method.has_literal) {
        SolveOptions literal = usual;
        literal.literal = true;
        solve(room, name + " --literal", method.make, literal);
    }
    for (const MethodOption& option : method.own_options()) {
        if (!option.excludes.empty()) // a short form of another option
            continue;
        for_values(option, [&](const std::string& text, const SolveOptions& with) {
            if (takes(method, with, room.mesh.patches().size()))
                solve(room, name + " " + text, method.make, with);
        });
    }
}

void find_view_factors(Room& room) {
    std::vector<std::uint32_t> row_of(room.mesh.patches().size());
    std::iota(row_of.begin(), row_of.end(), 0u);
    Monitor monitor;
    const ViewFactors factors =
        view_factors(room.mesh, WideBvh(room.mesh.soup()), row_of, row_of.size(),
                     {.rays = 256, .tolerance = relative_above(.1, 1e-2)}, Workers(1), monitor);
    Hash hash;
    for (std::size_t k = 0; k < factors.column.size(); ++k) {
        hash.add(factors.column[k]);
        hash.add(factors.factor[k]);
        hash.add(factors.standard_error[k]);
    }
    room.add("view factors", hash);
}

std::set<std::string> lines_of(const char* path) {
    std::ifstream file(path);
    std::set<std::string> lines;
    for (std::string line; std::getline(file, line);)
        lines.insert(line);
    return lines;
}

} // namespace

int main(int arguments, char** argument) {
    std::vector<std::string> rows;
    for (const char* scene : {"cornell_box", "open_scene", "furnace_lshape"}) {
        Room room(scene);
        for (const Method* method : methods()) {
            solve_by(room, *method);
            if (room.mesh.patches().size() < 1000)
                solve_with_options(room, *method);
        }
        find_view_factors(room);
        rows.insert(rows.end(), room.rows.begin(), room.rows.end());
    }
    const std::set<std::string> known =
        arguments > 1 ? lines_of(argument[1]) : std::set<std::string>{};
    std::size_t others = 0;
    for (const std::string& row : rows)
        if (!known.contains(row)) {
            std::printf("%s\n", row.c_str());
            ++others;
        }
    if (arguments > 1)
        std::printf("%zu of %zu rows are those of the table\n", rows.size() - others, rows.size());
    return arguments > 1 && others > 0 ? 1 : 0;
}
