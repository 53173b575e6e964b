#pragma once
// The radiosity equation of a scene, one patch a facet, with form factors without chance, solved by
// elimination. The slow and obviously right way: patches^2 integrals and patches^3 operations.

#include "radiosity/paper/scene/scene.h"
#include "support/families/exchange.h"

#include <cstdint>
#include <vector>

namespace hemilux::test {

[[nodiscard]] Polygon polygon_of(const Scene& scene, std::size_t facet);

/// Facets [begin, end), in the order in which a builder added them.
struct Range {
    std::uint32_t begin = 0, end = 0;
    [[nodiscard]] std::vector<std::uint32_t> indices() const;
};

class DenseSystem {
  public:
    explicit DenseSystem(const Scene& scene);

    [[nodiscard]] std::size_t size() const { return shapes_.size(); }
    [[nodiscard]] const Polygon& shape(std::size_t patch) const { return shapes_[patch]; }
    [[nodiscard]] double area(std::size_t patch) const { return areas_[patch]; }
    /// A_i F_ij, which is A_j F_ji.
    [[nodiscard]] double& exchange(std::size_t i, std::size_t j) {
        return exchange_[i * size() + j];
    }
    [[nodiscard]] double exchange(std::size_t i, std::size_t j) const {
        return exchange_[i * size() + j];
    }
    void set(std::size_t i, std::size_t j, double area_factor);

    /// All pairs of a range, which see each other fully or are turned away from each other.
    void add_open_pairs(Range range, ExchangeTable& table);
    /// The same between two ranges.
    void add_open_pairs(Range from, Range to);

    /// The patches of a range give the share 1 - lost of their light to patches of the system:
    /// `lost[k]` is the sum of form factors from patch begin + k to the openings. What rows are
    /// short of that by rounding is put on the diagonal, so that they are exact and reciprocity is
    /// too. In rooms of reflectance 0.9999 an error of 1e-10 in a row would be one of 1e-6 in the
    /// result.
    void close_rows(Range range, const std::vector<double>& lost = {});

    /// The largest share of a row that was put on the diagonal.
    [[nodiscard]] double row_error() const { return row_error_; }

    /// Light from outside of the system: irradiance of a patch.
    void add_irradiance(std::size_t patch, const Vec3& irradiance) {
        irradiance_[patch] += irradiance;
    }

    /// B of (1 - rho F) B = E + rho H, channel by channel.
    [[nodiscard]] std::vector<Vec3> solve() const;

  private:
    [[nodiscard]] std::vector<double> matrix(int channel) const;

    std::vector<Polygon> shapes_;
    std::vector<double> areas_, exchange_;
    std::vector<Vec3> reflectance_, emission_, irradiance_;
    double row_error_ = 0;
};

} // namespace hemilux::test
