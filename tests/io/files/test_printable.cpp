// Text from files: what reaches a terminal, a drawing or a spreadsheet.
#include "io/files/printable.h"

#include "io/drawings/canvas.h"
#include "io/results/csv.h"
#include "support/catch.h"

using namespace hemilux;
using Catch::Contains;

TEST_CASE("control characters and bytes that are no UTF-8 are replaced, all else is kept") {
    const std::string mark = "\xef\xbf\xbd";
    for (const std::string text :
         {"lamp", "W\xc3\xa4nde", "\xe5\xa3\x81", "\xf0\x9f\x92\xa1", "a\tb\nc", ""})
        CHECK(printable(text) == text);
    CHECK(printable("\x1b[31m\a") == mark + "[31m" + mark);
    CHECK(printable("\xc2\x9b"
                    "2J") == mark + "2J"); // C1 in UTF-8
    CHECK(printable("\x9b"
                    "2J") == mark + "2J"); // C1 as a byte
    CHECK(printable("a\xff\xc3") == "a" + mark + mark);
    CHECK(printable("\xc0\xaf") == mark + mark);            // longer than needed
    CHECK(printable("\xed\xa0\x80") == mark + mark + mark); // a surrogate
    CHECK(printable("\xe2\x80\xae"
                    "gnp") == mark + "gnp"); // turns the direction
    CHECK(printable(std::string_view("\0\x7f", 2)) == mark + mark);
}

TEST_CASE("of a long line of a message the middle is left out") {
    const std::string message =
        "a.obj:3: material '" + std::string(1 << 20, 'x') + "' is unknown\nand so on";
    const std::string shown = printable_message(message);
    CHECK(shown.size() < 1100);
    CHECK_THAT(shown, Contains("a.obj:3: material 'xxx") && Contains(" ... ") &&
                          Contains("' is unknown\nand so on"));
    CHECK(printable_message("short") == "short");
    std::string wide;
    for (int i = 0; i < 1000; ++i)
        wide += "\xc3\xa4";
    CHECK_THAT(printable_message(wide), !Contains("\xef\xbf\xbd"));
    CHECK(printable(printable_message(wide)) == printable_message(wide));
}

TEST_CASE("a drawing is well-formed whatever a name holds") {
    SvgCanvas canvas(10, 10);
    canvas.text({1, 1}, "\x1b\xff<&>\xef\xbf\xbf", {});
    const std::string svg = canvas.document();
    CHECK_THAT(svg, Contains("&lt;&amp;") && !Contains("\x1b") && !Contains("\xff") &&
                        !Contains("\xef\xbf\xbf"));
}

TEST_CASE("names that a spreadsheet would take for formulas get an apostrophe, numbers do not") {
    const auto cell = [](std::string_view text) {
        std::string line;
        csv::append_text(line, text);
        return line;
    };
    CHECK(cell("=1+1") == "'=1+1");
    CHECK(cell("+x") == "'+x");
    CHECK(cell("-x") == "'-x");
    CHECK(cell("@sum(a,b)") == "\"'@sum(a,b)\"");
    CHECK(cell("a=b") == "a=b");
    std::string line;
    csv::append_number(line, -1.5);
    CHECK(line == "-1.5");
}
