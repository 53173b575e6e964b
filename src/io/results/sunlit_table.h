#pragma once
// The sunlit fractions of surfaces and points as a table, written as they are found.

#include "io/files/atomic_file.h"
#include "radiosity/engine/view_factors/open_share.h"

#include <cstddef>
#include <span>
#include <string>

namespace hemilux {

/// A table `sun,surface,sunlit,standard_error`, a row for each sun and surface. Throws OutputError.
class SunlitTable {
  public:
    explicit SunlitTable(const std::string& path);
    /// Adds the rows of the next sun. Surfaces have consecutive numbers, from `first` on.
    void add(std::size_t sun, std::size_t first, std::span<const OpenShare> fractions);
    void commit() { file_.commit(); }

  private:
    AtomicFile file_;
};

} // namespace hemilux
