#include "app/report/page_file.h"

#include "app/report/assets.h"

namespace hemilux {

PageFile::PageFile(const std::string& path, std::string_view markup) : file_(path), left_(markup) {
    write_until("/* page.css */");
    file_.write(assets::style);
    write_until("<!-- data -->");
}

void PageFile::json(std::string_view id, std::string_view text) {
    std::string element = "<script type=\"application/json\" id=\"" + std::string(id) + "\">";
    for (const char c : text)
        if (c == '<')
            element += "\\u003c";
        else
            element += c;
    file_.write(element + "</script>\n");
}

void PageFile::finish(std::string_view script) {
    write_until("/* *.js */");
    file_.write(assets::shared_script);
    file_.write(script);
    file_.write(left_);
    file_.commit();
}

void PageFile::write_until(std::string_view mark) {
    const std::size_t at = left_.find(mark);
    file_.write(left_.substr(0, at));
    left_.remove_prefix(at + mark.size());
}

} // namespace hemilux
