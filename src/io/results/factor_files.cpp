#include "io/results/factor_files.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/little_endian.h"
#include "io/results/csv.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hemilux {

std::string npy_header(const std::string& type, const std::string& shape) {
    std::string text =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
    constexpr std::size_t before = 10, multiple = 64;
    while ((before + text.size() + 1) % multiple != 0)
        text += ' ';
    text += '\n';
    std::string bytes = "\x93NUMPY";
    bytes += '\x01';
    bytes += '\0';
    append_number(bytes, static_cast<std::uint16_t>(text.size()));
    return bytes + text;
}

void write_factor_table(const std::string& path, const SparseMatrix& matrix,
                        const std::atomic<bool>* interrupted) {
    AtomicFile file(path);
    file.write("i,j,F\n");
    std::string line;
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
        if (interrupted && *interrupted)
            throw Interrupted();
        for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k) {
            if (!(matrix.value[k] > 0))
                continue;
            line.clear();
            csv::append_number(line, std::uint64_t{i});
            csv::append_field(line, std::uint64_t{matrix.column[k]});
            csv::append_field(line, matrix.value[k]);
            line += '\n';
            file.write(line);
        }
    }
    file.commit();
}

void write_npy(const std::string& path, const SparseMatrix& matrix,
               const std::atomic<bool>* interrupted, std::optional<std::size_t> columns) {
    AtomicFile file(path);
    std::vector<double> row(columns.value_or(matrix.rows()));
    file.write(
        npy_header("<f8", std::to_string(matrix.rows()) + ", " + std::to_string(row.size())));
    std::string bytes;
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
        if (interrupted && *interrupted)
            throw Interrupted();
        std::ranges::fill(row, 0.0);
        for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k)
            row[matrix.column[k]] = matrix.value[k];
        bytes.clear();
        for (const double value : row)
            append_number(bytes, value);
        file.write(bytes);
    }
    file.commit();
}

} // namespace hemilux
