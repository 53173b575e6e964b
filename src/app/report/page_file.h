#pragma once
// A page of HTML that carries its style, its data and its scripts, and loads nothing.

#include "app/report/base64.h"
#include "io/files/atomic_file.h"

#include <string>
#include <string_view>

namespace hemilux {

/// The file under way. Its functions throw OutputError and Interrupted.
class PageFile {
  public:
    /// Writes the markup up to its data. It has the marks `/* page.css */`, `<!-- data -->` and
    /// `/* *.js */`, in this order.
    PageFile(const std::string& path, std::string_view markup);

    /// Writes the element `id` with a text of JSON. Every `<` becomes \u003c, so that no name ends
    /// the element.
    void json(std::string_view id, std::string_view text);

    /// Writes the element `id` with an array in base64: `append_row(i, bytes)` appends the bytes of
    /// row i, an even number, for each of `rows` rows.
    template <class AppendRow>
    void array(const std::string& id, std::size_t rows, const AppendRow& append_row) {
        constexpr std::size_t rows_at_a_time = 3 << 12; // no padding between them
        file_.write("<script type=\"application/base64\" id=\"" + id + "\">");
        std::string bytes;
        for (std::size_t i = 0; i < rows; ++i) {
            append_row(i, bytes);
            if ((i + 1) % rows_at_a_time == 0 || i + 1 == rows) {
                file_.write(base64(bytes));
                bytes.clear();
            }
        }
        file_.write("</script>\n");
    }

    /// Writes the rest of the markup with the scripts that all pages have and one of its own. The
    /// file then is complete.
    void finish(std::string_view script);

  private:
    /// Writes the markup that is left up to a mark, which is passed over.
    void write_until(std::string_view mark);

    AtomicFile file_;
    std::string_view left_; ///< rest of the markup
};

} // namespace hemilux
