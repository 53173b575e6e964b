#include "app/command_line/config_file.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace hemilux {
namespace {

bool is_bare(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
}

class Reader {
  public:
    explicit Reader(const std::string& path)
        : path_(path), text_(read_input(path, InputKind::stream, {}, max_bytes + 1)) {
        if (text_.size() > max_bytes)
            throw InputError(path, "expected the options of a run, at most 1 MiB");
    }

    std::vector<ConfigEntry> read() {
        std::string table;
        for (skip(true); at_ < text_.size(); end_line()) {
            if (text_[at_] == '[') {
                ++at_;
                table = key();
                take(']', "']' after the name of a subcommand");
                continue;
            }
            add(entry(table));
        }
        return std::move(entries_);
    }

  private:
    static constexpr std::size_t max_bytes = std::size_t{1} << 20;

    [[noreturn]] void fail(const std::string& expected) const {
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        throw InputError(path_, line_,
                         "expected " + expected + ", " +
                             found_instead(std::string_view(text_).substr(at_, end - at_)));
    }

    /// Skips blanks and comments; line ends too where they mean nothing.
    void skip(bool over_lines) {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '#')
                at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
            else if (c == '\n' && over_lines)
                ++line_;
            else if (c != ' ' && c != '\t' && c != '\r')
                return;
        }
    }

    void take(char letter, const char* expected) {
        skip(false);
        if (at_ == text_.size() || text_[at_] != letter)
            fail(expected);
        ++at_;
    }

    void end_line() {
        skip(false);
        if (at_ < text_.size() && text_[at_] != '\n')
            fail("the end of the line");
        skip(true);
    }

    std::string key() {
        skip(false);
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_bare(text_[at_]))
            ++at_;
        if (at_ == begin)
            fail("the name of an option without its dashes");
        return text_.substr(begin, at_ - begin);
    }

    ConfigEntry entry(const std::string& table) {
        ConfigEntry entry{table, key(), {}, false, false, line_};
        take('=', "'=' after the name of an option");
        skip(false);
        if (at_ == text_.size() || text_[at_] != '[') {
            entry.values.push_back(is_quote() ? string() : number_or_truth(entry.truth));
            return entry;
        }
        ++at_;
        skip(true);
        entry.list = is_quote();
        for (; at_ < text_.size() && text_[at_] != ']'; skip(true)) {
            bool truth = false;
            if (is_quote() != entry.list)
                fail(entry.list ? "a text in quotes, as before it" : "a number, as before it");
            entry.values.push_back(entry.list ? string() : number_or_truth(truth));
            if (truth)
                fail("texts or numbers in an array");
            skip(true);
            if (at_ < text_.size() && text_[at_] == ',')
                ++at_;
            else if (at_ == text_.size() || text_[at_] != ']')
                fail("',' or ']' in an array");
        }
        take(']', "']' at the end of an array");
        if (entry.values.empty())
            fail("a value in the array before");
        return entry;
    }

    [[nodiscard]] bool is_quote() const {
        return at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'');
    }

    std::string number_or_truth(bool& truth) {
        const std::size_t begin = at_;
        while (at_ < text_.size() &&
               (is_bare(text_[at_]) || text_[at_] == '.' || text_[at_] == '+'))
            ++at_;
        std::string word = text_.substr(begin, at_ - begin);
        truth = word == "true" || word == "false";
        std::string digits = word;
        std::erase(digits, '_');
        if (truth)
            return word;
        if (parse_decimal(digits))
            return digits;
        at_ = begin;
        fail("a number, true, false or a text in quotes");
    }

    std::string string() {
        const std::size_t begin = at_++;
        const char quote = text_[begin];
        std::string result;
        for (; at_ < text_.size() && text_[at_] != quote; ++at_) {
            if (text_[at_] == '\n') {
                at_ = begin;
                fail("a text that ends with its quote on this line");
            }
            if (text_[at_] != '\\' || quote == '\'') {
                result += text_[at_];
                continue;
            }
            ++at_;
            if (at_ == text_.size() || (text_[at_] != '\\' && text_[at_] != '"'))
                fail("\\\\ or \\\" after a backslash; a text in ' ' has no such letters");
            result += text_[at_];
        }
        take(quote, "the quote that ends the text");
        return result;
    }

    void add(ConfigEntry entry) {
        for (const ConfigEntry& other : entries_)
            if (other.key == entry.key && other.table == entry.table)
                throw InputError(path_, entry.line,
                                 "'" + entry.key + "' is set in line " +
                                     std::to_string(other.line) + " already");
        entries_.push_back(std::move(entry));
    }

    const std::string& path_;
    std::string text_;
    std::size_t at_ = 0, line_ = 1;
    std::vector<ConfigEntry> entries_;
};

} // namespace

std::vector<ConfigEntry> read_config(const std::string& path) { return Reader(path).read(); }

} // namespace hemilux
