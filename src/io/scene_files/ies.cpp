#include "io/scene_files/ies.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// A file with more angles of a kind is no photometry of a lamp.
constexpr double max_angles = 10'000;

class IesReader {
  public:
    explicit IesReader(const std::string& path)
        : path_(path), content_(read_input(path, InputKind::regular)), rest_(content_) {}

    std::shared_ptr<const CandelaTable> read();

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(path_, line_, message);
    }
    std::string_view next_line();
    std::string_view next_word();
    double next_number(const char* what);
    std::vector<double> numbers(std::size_t count, const char* what);
    std::size_t next_count(const char* what);
    void skip_keywords();

    std::string path_, content_;
    std::string_view rest_, words_; ///< what is not read yet: of the file, of the line
    std::size_t line_ = 0;
};

std::string_view IesReader::next_line() {
    if (rest_.empty())
        fail("expected more of an IES file, found its end");
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return trimmed(line);
}

/// Returns the next word, on whichever line it stands. Numbers may be separated by commas.
std::string_view IesReader::next_word() {
    constexpr std::string_view between = " \t\r,";
    for (;;) {
        const std::size_t begin = words_.find_first_not_of(between);
        if (begin != std::string_view::npos) {
            words_.remove_prefix(begin);
            const std::string_view word = words_.substr(0, words_.find_first_of(between));
            words_.remove_prefix(word.size());
            return word;
        }
        words_ = next_line();
    }
}

double IesReader::next_number(const char* what) {
    const std::string_view word = next_word();
    const std::optional<double> number = parse_decimal(word);
    if (!number)
        fail(std::string("expected ") + what + ", " + found_instead(word));
    return *number;
}

std::vector<double> IesReader::numbers(std::size_t count, const char* what) {
    std::vector<double> list;
    while (list.size() < count)
        list.push_back(next_number(what));
    return list;
}

std::size_t IesReader::next_count(const char* what) {
    const double count = next_number(what);
    if (!(count >= 1 && count <= max_angles) || count != std::floor(count))
        fail(std::string("expected ") + what + " from 1 to 10000");
    return static_cast<std::size_t>(count);
}

/// Skips what stands before the photometry, to the line that says how the lamp is tilted.
void IesReader::skip_keywords() {
    const std::string_view first = next_line();
    if (!small_letters(first).starts_with("iesna"))
        fail("expected an IES file, which begins with IESNA, " + found_instead(first));
    for (;;) {
        const std::string_view line = next_line();
        if (!small_letters(line).starts_with("tilt="))
            continue;
        if (small_letters(trimmed(line.substr(5))) != "none")
            fail("expected TILT=NONE, as only photometry without tilt is read, " +
                 found_instead(line));
        return;
    }
}

std::shared_ptr<const CandelaTable> IesReader::read() {
    skip_keywords();
    (void)next_number("the number of lamps");
    (void)next_number("the lumens of a lamp"); // those that the intensities are measured with
    double factor = next_number("the factor of the intensities");
    const std::size_t vertical = next_count("the number of vertical angles");
    const std::size_t horizontal = next_count("the number of horizontal angles");
    if (next_number("the type of the photometry") != 1)
        fail("expected photometry of type C, which is 1");
    (void)numbers(4, "the units and the size of the lamp");
    factor *= next_number("the ballast factor");
    factor *= next_number("the ballast-lamp factor, which is 1 in newer files");
    (void)next_number("the watts of the lamp");
    std::vector<double> gamma = numbers(vertical, "a vertical angle");
    std::vector<double> c = numbers(horizontal, "a horizontal angle");
    std::vector<double> candela = numbers(vertical * horizontal, "an intensity");
    for (double& each : candela)
        each *= factor;
    try {
        return std::make_shared<CandelaTable>(std::move(gamma), std::move(c), std::move(candela));
    } catch (const std::invalid_argument& error) {
        fail(error.what());
    }
}

} // namespace

std::shared_ptr<const CandelaTable> read_ies(const std::string& path) {
    return IesReader(path).read();
}

} // namespace hemilux
