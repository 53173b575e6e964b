#pragma once
// Tables of `solve --layers`, of patches or of points, and their light where lamps have other
// powers.

#include "geometry/vector.h"
#include "radiosity/light/lamps/lamp_powers.h"

#include <cstddef>
#include <string>
#include <vector>

namespace hemilux {

class LampTable {
  public:
    /// Reads a table. Throws InputError for another one, and for one without layers.
    explicit LampTable(const std::string& path);

    /// Returns the names of the layers.
    [[nodiscard]] const std::vector<std::string>& lamps() const { return names_; }

    /// Returns the places of wishes for the light at points. The file has rows `point,wish`, or
    /// `point,r,g,b` for a wish by channel [W/m2]; a first row may be a header. Throws InputError,
    /// also where the table is not of points.
    [[nodiscard]] std::vector<WishedPlace> places(const std::string& wishes) const;

    /// Makes each layer so many times as bright, by channel. Radiosities of points are left empty:
    /// the table does not say what surfaces emit there.
    void dim(const std::vector<Vec3>& factors);
    void write(const std::string& path) const;

  private:
    struct Layer {
        std::size_t light, error; ///< the first of three columns each
    };
    [[nodiscard]] std::size_t column(const std::string& name) const;
    [[nodiscard]] Vec3 colour(std::size_t row, std::size_t column) const;
    void set(std::size_t row, std::size_t column, const Vec3& colour);
    void dim_row(std::size_t row, const std::vector<Vec3>& factors);

    std::string path_;
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
    std::vector<std::size_t> lines_; ///< of the file, by row
    std::vector<std::string> names_;
    std::vector<Layer> layers_;
    bool of_points_ = false;
};

} // namespace hemilux
