#include "io/results/sunlit_table.h"

#include "io/results/csv.h"

#include <cstdint>

namespace hemilux {

SunlitTable::SunlitTable(const std::string& path) : file_(path) {
    file_.write("sun,surface,sunlit,standard_error\n");
}

void SunlitTable::add(std::size_t sun, std::size_t first, std::span<const OpenShare> fractions) {
    std::string line;
    for (std::size_t k = 0; k < fractions.size(); ++k) {
        line = std::to_string(sun) + "," + std::to_string(first + k) + ",";
        csv::append_number(line, fractions[k].factor);
        line += ',';
        csv::append_number(line, fractions[k].standard_error);
        file_.write(line + "\n");
    }
}

} // namespace hemilux
