#include "app/command_line/generated/generated_texts.h"

#include <set>
#include <sstream>

namespace hemilux {
namespace {

/// Returns text of which roff takes no letter for a request.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if ((result.empty() || result.back() == '\n') && (c == '.' || c == '\''))
            result += "\\&";
        result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return result;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

void write_options(std::ostream& page, const CommandText& command) {
    std::string group;
    for (const OptionText& option : command.options) {
        if (option.group.empty())
            continue;
        if (option.group != group)
            page << ".SS \"" << plain(group = option.group) << "\"\n";
        page << ".TP\n";
        for (const std::string& name : option.names)
            page << (&name == &option.names.front() ? "" : ", ") << bold(name);
        page << (option.type.empty() ? "" : " " + italic(option.type)) << "\n"
             << plain(option.help) << "\n";
    }
}

/// Writes the paragraphs that no subcommand before has ended with, line for line.
void write_end(std::ostream& page, const std::string& end, std::set<std::string>& written) {
    std::istringstream lines(end + "\n");
    std::string paragraph;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty())
            paragraph += plain(line) + "\n";
        if ((line.empty() || lines.peek() == EOF) && !paragraph.empty()) {
            if (written.insert(paragraph).second)
                page << ".PP\n.nf\n" << paragraph << ".fi\n";
            paragraph.clear();
        }
    }
}

} // namespace

std::string manual_page(const std::vector<CommandText>& program, const std::string& version) {
    const std::string& name = program.front().name;
    const std::string& description = program.front().description;
    std::ostringstream page;
    page << ".TH HEMILUX 1 \"\" \"" << plain(version) << "\" \"User Commands\"\n.SH NAME\n"
         << plain(name) << " \\- " << plain(description.substr(description.find(": ") + 2))
         << "\n.SH SYNOPSIS\n";
    page << bold(name) << " " << italic("MODEL") << " [" << italic("OPTIONS") << "]\n";
    for (std::size_t k = 1; k < program.size(); ++k)
        page << ".br\n"
             << bold(name + " " + program[k].name) << " [" << italic("OPTIONS") << "] "
             << italic("SCENE") << "\n";
    page << ".SH OPTIONS\n";
    write_options(page, program.front());
    std::set<std::string> written;
    for (std::size_t k = 1; k < program.size(); ++k) {
        page << ".SH \"" << plain(name + " " + program[k].name) << "\"\n"
             << plain(program[k].description) << ".\n";
        write_options(page, program[k]);
        write_end(page, program[k].end, written);
    }
    return page.str();
}

} // namespace hemilux
