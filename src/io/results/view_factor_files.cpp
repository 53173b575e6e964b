#include "io/results/view_factor_files.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/little_endian.h"
#include "io/files/provenance.h"
#include "io/files/stored_zip.h"
#include "io/results/csv.h"
#include "io/results/factor_files.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>

namespace hemilux {
namespace {

void check_interrupt(const FactorTable& table) {
    if (table.interrupted && *table.interrupted)
        throw Interrupted();
}

/// Calls use(i, j, F, standard error) for what is open of a row, where it is a column.
template <class Use>
void for_open(const FactorTable& table, std::uint32_t i, const std::array<OpenShare, opens>& shares,
              std::span<const OpenShare> bands, const Use& use) {
    auto column = static_cast<std::uint32_t>(table.surfaces.size());
    const auto add = [&](const OpenShare& open) {
        if (open.factor > 0)
            use(i, column, open.factor, open.standard_error);
        ++column;
    };
    for (const Open open : table.columns)
        if (open == Open::sky && table.bands)
            std::ranges::for_each(bands, add);
        else
            add(shares[static_cast<std::size_t>(open)]);
}

/// Calls use(i, j, F, standard error) for the entries of a row, those of what is open at its end.
template <class Use>
void for_row(const FactorTable& table, std::uint32_t i, const Use& use) {
    const ViewFactors& factors = table.factors;
    if (i < factors.rows()) {
        for (std::size_t k = factors.row_begin[i]; k < factors.row_begin[i + 1]; ++k)
            if (factors.factor[k] > 0)
                use(i, factors.column[k], factors.factor[k], factors.standard_error[k]);
        for_open(table, i, factors.open[i], factors.bands_of(i), use);
    } else if (const std::size_t size = table.size(); i >= size) {
        const PointFactors& point = table.points[i - size];
        for (std::size_t k = 0; k < point.factor.size(); ++k)
            if (point.factor[k] > 0)
                use(i, point.column[k], point.factor[k], point.standard_error[k]);
        for_open(table, i, point.open, point.bands, use);
    }
}

/// Returns at least the number of entries of all rows.
std::size_t entries_of(const FactorTable& table) {
    std::size_t entries =
        table.factors.factor.size() + (table.size() - table.surfaces.size()) * table.rows();
    for (const PointFactors& point : table.points)
        entries += point.factor.size();
    return entries;
}

std::uint32_t row_count(const FactorTable& table) {
    return static_cast<std::uint32_t>(table.rows());
}

template <class Values>
void add_array(StoredZip& zip, const std::string& name, const std::string& type,
               const Values& values) {
    std::string bytes;
    bytes.reserve(values.size() * sizeof values[0]);
    for (const auto value : values)
        append_number(bytes, value);
    zip.add(name + ".npy", {npy_header(type, std::to_string(values.size()) + ","), bytes});
}

/// Adds an array of value_of(column, F, standard error) of all entries, row after row.
template <class ValueOf>
void add_entries(StoredZip& zip, const std::string& name, const std::string& type,
                 std::uint64_t entries, const FactorTable& table, const ValueOf& value_of) {
    zip.add_given(name + ".npy", [&](const StoredZip::Sink& sink) {
        sink(npy_header(type, std::to_string(entries) + ","));
        std::string bytes;
        for (std::uint32_t i = 0, rows = row_count(table); i < rows; ++i) {
            check_interrupt(table);
            bytes.clear();
            for_row(table, i,
                    [&](std::uint32_t, std::uint32_t column, double factor, double error) {
                        append_number(bytes, value_of(column, factor, error));
                    });
            sink(bytes);
        }
    });
}

/// Adds texts as an array of strings of one length, in UTF-8.
void add_texts(StoredZip& zip, const std::string& name, const std::vector<std::string>& texts) {
    std::size_t length = 1;
    for (const std::string& text : texts)
        length = std::max(length, text.size());
    std::string bytes;
    for (const std::string& text : texts)
        bytes += text + std::string(length - text.size(), '\0');
    zip.add(name + ".npy",
            {npy_header("|S" + std::to_string(length), std::to_string(texts.size()) + ","), bytes});
}

/// Adds one text as an array without dimensions.
void add_text(StoredZip& zip, const std::string& name, const std::string& text) {
    const std::string kept = text.empty() ? " " : text;
    zip.add(name + ".npy", {npy_header("|S" + std::to_string(kept.size()), ""), kept});
}

} // namespace

const char* name_of(Open open) {
    constexpr std::array<const char*, opens> names = {"sky", "ground", "back"};
    return names[static_cast<std::size_t>(open)];
}

std::vector<std::string> FactorTable::column_names() const {
    std::vector<std::string> names;
    for (const Open open : columns)
        if (open == Open::sky && bands)
            for (std::size_t k = 0; k < bands->size(); ++k)
                names.push_back(bands->name(k));
        else
            names.emplace_back(name_of(open));
    return names;
}

void write_factor_pairs(const std::string& path, const FactorTable& table) {
    AtomicFile file(path);
    file.write("i,j,F,standard_error\n");
    std::string line;
    for (std::uint32_t i = 0, rows = row_count(table); i < rows; ++i) {
        check_interrupt(table);
        for_row(table, i,
                [&](std::uint32_t row, std::uint32_t column, double factor, double error) {
                    line.clear();
                    csv::append_number(line, std::uint64_t{row});
                    csv::append_field(line, std::uint64_t{column});
                    csv::append_field(line, factor);
                    csv::append_field(line, error);
                    file.write(line + '\n');
                });
    }
    file.commit();
}

void write_factor_npz(const std::string& path, const FactorTable& table, const Provenance& from) {
    std::vector<std::uint64_t> begin(1, 0);
    for (std::uint32_t i = 0, rows = row_count(table); i < rows; ++i) {
        std::uint64_t end = begin.back();
        for_row(table, i, [&](std::uint32_t, std::uint32_t, double, double) { ++end; });
        begin.push_back(end);
    }
    const std::uint64_t entries = begin.back();
    StoredZip zip(path);
    constexpr std::uint64_t largest = 0x7fffffff;
    if (entries <= largest) { // SciPy wants both of one type
        add_entries(zip, "indices", "<i4", entries, table,
                    [](std::uint32_t column, double, double) { return column; });
        add_array(zip, "indptr", "<i4", std::vector<std::uint32_t>(begin.begin(), begin.end()));
    } else {
        add_entries(zip, "indices", "<i8", entries, table,
                    [](std::uint32_t column, double, double) { return std::uint64_t{column}; });
        add_array(zip, "indptr", "<i8", begin);
    }
    add_text(zip, "format", "csr");
    add_array(zip, "shape", "<i8", std::array<std::uint64_t, 2>{table.rows(), table.size()});
    add_entries(zip, "data", "<f8", entries, table,
                [](std::uint32_t, double factor, double) { return factor; });
    add_entries(zip, "standard_error", "<f8", entries, table,
                [](std::uint32_t, double, double error) { return error; });
    std::vector<double> area;
    std::vector<std::string> names;
    for (const FactorSurface& surface : table.surfaces) {
        area.push_back(surface.area);
        names.push_back(surface.name);
    }
    std::ranges::copy(table.column_names(), std::back_inserter(names));
    for (const FactorPlace& place : table.places)
        names.push_back(place.name);
    add_array(zip, "area", "<f8", area);
    add_texts(zip, "name", names);
    add_text(zip, "seed", std::to_string(from.seed));
    add_text(zip, "command", from.command);
    zip.commit();
}

void write_udales_factors(const std::string& path, const FactorTable& table) {
    constexpr double least = 5e-9; // rounds to more than 0
    AtomicFile file(path);
    const ViewFactors& factors = table.factors;
    std::array<char, 64> line;
    for (std::uint32_t i = 0; i < factors.rows(); ++i) {
        check_interrupt(table);
        for (std::size_t k = factors.row_begin[i]; k < factors.row_begin[i + 1]; ++k) {
            if (!(factors.factor[k] >= least))
                continue;
            std::snprintf(line.data(), line.size(), "%u %u %.8f\n", i + 1, factors.column[k] + 1,
                          factors.factor[k]);
            file.write(line.data());
        }
    }
    file.commit();
}

void write_udales_sky(const std::string& path, const FactorTable& table) {
    AtomicFile file(path);
    file.write("# sky view factors\n");
    std::array<char, 64> line;
    for (const auto& open : table.factors.open) {
        std::snprintf(line.data(), line.size(), "%.8f\n",
                      open[static_cast<std::size_t>(Open::sky)].factor);
        file.write(line.data());
    }
    file.commit();
}

void write_dense_factors(const std::string& path, const FactorTable& table) {
    SparseMatrix matrix;
    matrix.column.reserve(entries_of(table));
    matrix.value.reserve(entries_of(table));
    matrix.row_begin.push_back(0);
    for (std::uint32_t i = 0, rows = row_count(table); i < rows; ++i) {
        for_row(table, i, [&](std::uint32_t, std::uint32_t j, double factor, double) {
            matrix.column.push_back(j);
            matrix.value.push_back(factor);
        });
        matrix.row_begin.push_back(matrix.column.size());
    }
    write_npy(path, matrix, table.interrupted, table.size());
}

} // namespace hemilux
