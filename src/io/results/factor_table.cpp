#include "io/results/factor_table.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/results/csv.h"

namespace hemilux {

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
            line += ',';
            csv::append_number(line, std::uint64_t{matrix.column[k]});
            line += ',';
            csv::append_number(line, matrix.value[k]);
            line += '\n';
            file.write(line);
        }
    }
    file.commit();
}

} // namespace hemilux
