#include "io/results/checkpoint.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "radiosity/engine/rays/candela_table.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/scene/mesh.h"

#include <limits>
#include <span>

namespace hemilux {
namespace {

constexpr std::string_view magic = "hemilux checkpoint, format ";
constexpr std::string_view format = "9";
constexpr std::size_t word = sizeof(std::uint64_t);
constexpr std::size_t longest_format = 8; ///< digits of a version to come

/// The least bytes that a row and an option take.
constexpr std::size_t row_bytes = 6 * word, option_bytes = 2 * word;

void add_row(StateWriter& out, const StepRow& row) {
    out.add(std::string_view(row.method));
    out.add(std::uint64_t{row.record.step});
    out.add(row.record.rays);
    out.add(row.record.seconds);
    out.add(row.record.estimated_error);
    out.add(std::uint64_t{row.error.has_value()});
    const RelativeError error = row.error.value_or(RelativeError{});
    for (const double value : {error.all, error.detail, error.rest})
        out.add(value);
}

/// Reads an error; NaN says that it is not known.
double error_from(StateReader& in) {
    const double error = in.number();
    if (error < 0)
        throw StateError("an error in it is negative");
    return error;
}

StepRow row_from(StateReader& in) {
    StepRow row;
    row.method = in.text();
    row.record.step =
        static_cast<std::uint32_t>(in.whole_up_to(std::numeric_limits<std::uint32_t>::max()));
    row.record.rays = in.whole();
    row.record.seconds = in.number(bounds::non_negative);
    row.record.estimated_error = error_from(in);
    const bool has_error = in.flag();
    RelativeError error;
    for (double* value : {&error.all, &error.detail, &error.rest})
        *value = error_from(in);
    if (has_error)
        row.error = error;
    return row;
}

/// Returns what comes before the state in the content, which has the state at its end.
std::string content_before_state(const Checkpoint& checkpoint) {
    StateWriter out;
    out.add(std::uint64_t{checkpoint.options.size()});
    for (const auto& [name, value] : checkpoint.options) {
        out.add(std::string_view(name));
        out.add(std::string_view(value));
    }
    out.add(checkpoint.scene);
    out.add(checkpoint.seconds);
    out.add(std::uint64_t{checkpoint.rows.size()});
    for (const StepRow& row : checkpoint.rows)
        add_row(out, row);
    out.add(std::uint64_t{checkpoint.state.size()});
    return std::move(out).bytes();
}

Checkpoint parse_content(std::string_view bytes) {
    StateReader in(bytes);
    Checkpoint checkpoint;
    for (std::size_t left = in.count(option_bytes); left > 0; --left) {
        std::string name = in.text();
        checkpoint.options.emplace_back(std::move(name), in.text());
    }
    checkpoint.scene = in.whole();
    checkpoint.seconds = in.number(bounds::non_negative);
    for (std::size_t left = in.count(row_bytes); left > 0; --left)
        checkpoint.rows.push_back(row_from(in));
    checkpoint.state = in.text();
    in.expect_end();
    return checkpoint;
}

/// Computes FNV-1a with 64 bits (Fowler, Noll, Vo). It shows any change of a single byte, and
/// misses others by a chance of 2^-64. It is no protection against somebody who means harm. `sum`
/// is that of the bytes before.
std::uint64_t checksum_of(std::string_view bytes, std::uint64_t sum = 0xcbf29ce484222325) {
    constexpr std::uint64_t prime = 0x100000001b3;
    for (const char c : bytes)
        sum = (sum ^ static_cast<unsigned char>(c)) * prime;
    return sum;
}

/// Takes the first line; what follows is of this version's format.
void check_first_line(std::string_view& bytes, const std::string& file) {
    const std::size_t end = bytes.substr(0, magic.size() + longest_format + 1).find('\n');
    if (!bytes.starts_with(magic) || end == std::string_view::npos)
        throw InputError(file, "expected a checkpoint written by hemilux --checkpoint");
    const std::string_view found = bytes.substr(magic.size(), end - magic.size());
    if (found != format)
        throw InputError(file, "is a checkpoint of another version: expected format " +
                                   std::string(format) + "; the version of hemilux that wrote it " +
                                   "can go on with it");
    bytes.remove_prefix(end + 1);
}

} // namespace

std::uint64_t scene_hash(const Mesh& mesh) {
    StateWriter out;
    std::uint64_t sum = checksum_of({});
    const auto flush = [&] {
        sum = checksum_of(out.bytes(), sum);
        out = {};
    };
    out.add(mesh.frame().centre);
    out.add(mesh.frame().scale);
    out.add(mesh.vertices());
    flush();
    for (const Facet& facet : mesh.scene().facets) {
        for (const std::uint32_t v : facet.vertex)
            out.add(std::uint64_t{v});
        out.add(std::uint64_t{facet.material});
        flush();
    }
    for (const Material& material : mesh.scene().materials) {
        out.add(material.reflectance);
        out.add(material.emission);
    }
    for (const PointEmitter& emitter : point_emitters_of(mesh.scene())) {
        for (const Vec3& v : {emitter.position, emitter.axis, emitter.intensity})
            out.add(v);
        out.add(emitter.cos_inner);
        out.add(emitter.cos_outer);
        if (!emitter.table)
            continue;
        out.add(emitter.side);
        for (const std::span<const double> numbers : emitter.table->numbers())
            out.add(numbers);
    }
    for (const Pane& pane : panes_of(mesh.scene())) {
        for (const Vec3& corner : pane.corner)
            out.add(corner);
        out.add(pane.transmittance);
    }
    flush();
    for (const Patch& patch : mesh.patches()) {
        out.add(patch.centre);
        out.add(patch.area);
        out.add(std::uint64_t{patch.facet});
        if (patch.colours != patch.material) {
            out.add(mesh.material(patch).reflectance);
            out.add(mesh.material(patch).emission);
        }
        out.add(std::uint64_t{patch.back});
        flush();
    }
    return sum;
}

namespace {

/// Returns what stands before the content, which is two texts, and behind it.
std::pair<std::string, std::string> seal_of(std::string_view first, std::string_view second) {
    StateWriter length, sum;
    length.add(std::uint64_t{first.size() + second.size()});
    std::string head = std::string(magic) + std::string(format) + "\n" + length.bytes();
    sum.add(checksum_of(second, checksum_of(first, checksum_of(head))));
    return {std::move(head), std::move(sum).bytes()};
}

} // namespace

std::string sealed_checkpoint(std::string_view content) {
    const auto [before, behind] = seal_of(content, {});
    return before + std::string(content) + behind;
}

std::string to_bytes(const Checkpoint& checkpoint) {
    return sealed_checkpoint(content_before_state(checkpoint) + checkpoint.state);
}

Checkpoint checkpoint_from(std::string_view bytes, const std::string& file) {
    const std::string_view all = bytes;
    check_first_line(bytes, file);
    try {
        StateReader header(bytes);
        const std::uint64_t length = header.whole();
        bytes.remove_prefix(word);
        if (bytes.size() < word || length != bytes.size() - word)
            throw StateError("its length is not what it was when it was written");
        StateReader tail(bytes.substr(length));
        if (tail.whole() != checksum_of(all.substr(0, all.size() - word)))
            throw StateError("its checksum is wrong");
        return parse_content(bytes.substr(0, length));
    } catch (const StateError& error) {
        throw InputError(file, std::string("is a damaged checkpoint: ") + error.what());
    }
}

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
    const std::string first = content_before_state(checkpoint);
    const auto [before, behind] = seal_of(first, checkpoint.state);
    AtomicFile file(path);
    for (const std::string* const part : {&before, &first, &checkpoint.state, &behind})
        file.write(*part);
    file.commit(AtomicFile::Durable::yes);
}

Checkpoint read_checkpoint(const std::string& path) {
    // A large file of another kind is not read to its end.
    const auto check = [&](std::string_view bytes) { check_first_line(bytes, path); };
    const std::string bytes = read_input(path, InputKind::regular, check);
    constexpr double copies = 2; // the state, beside the file
    ask_for_input(path, copies * static_cast<double>(bytes.size()));
    return checkpoint_from(bytes, path);
}

} // namespace hemilux
