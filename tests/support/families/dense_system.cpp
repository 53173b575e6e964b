#include "support/families/dense_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hemilux::test {
namespace {

/// Gaussian elimination of a matrix whose rows are dominated by their diagonal, which needs no
/// pivots. The right sides are overwritten by the solution.
void eliminate(std::vector<double> m, std::vector<Vec3>& right) {
    const std::size_t n = right.size();
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = m[i * n + k] / m[k * n + k];
            if (factor == 0)
                continue;
            for (std::size_t j = k + 1; j < n; ++j)
                m[i * n + j] -= factor * m[k * n + j];
            right[i] -= factor * right[k];
        }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j)
            right[k] -= m[k * n + j] * right[j];
        right[k] /= m[k * n + k];
    }
}

bool all_grey(const std::vector<Vec3>& reflectance) {
    return std::ranges::all_of(reflectance, [](const Vec3& rho) { return rho == Vec3(rho.x); });
}

} // namespace

Polygon polygon_of(const Scene& scene, std::size_t facet) {
    Polygon polygon;
    for (std::size_t c = 0; c < 4; ++c)
        polygon.corner[c] = scene.vertices[scene.facets[facet].vertex[c]];
    return polygon;
}

std::vector<std::uint32_t> Range::indices() const {
    std::vector<std::uint32_t> all(end - begin);
    std::iota(all.begin(), all.end(), begin);
    return all;
}

DenseSystem::DenseSystem(const Scene& scene) : irradiance_(scene.facets.size()) {
    for (std::size_t f = 0; f < scene.facets.size(); ++f) {
        shapes_.push_back(polygon_of(scene, f));
        areas_.push_back(shapes_.back().area());
        const Material& material = scene.materials[scene.facets[f].material];
        reflectance_.push_back(material.reflectance);
        emission_.push_back(material.emission);
    }
    exchange_.resize(size() * size());
}

void DenseSystem::set(std::size_t i, std::size_t j, double area_factor) {
    exchange(i, j) = exchange(j, i) = area_factor;
}

void DenseSystem::add_open_pairs(Range range, ExchangeTable& table) {
    for (std::size_t i = range.begin; i < range.end; ++i)
        for (std::size_t j = i + 1; j < range.end; ++j)
            set(i, j, table(shapes_[i], shapes_[j]));
}

void DenseSystem::add_open_pairs(Range from, Range to) {
    for (std::size_t i = from.begin; i < from.end; ++i)
        for (std::size_t j = to.begin; j < to.end; ++j)
            set(i, j, exchange_in_the_open(shapes_[i], shapes_[j]));
}

void DenseSystem::close_rows(Range range, const std::vector<double>& lost) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const auto row = exchange_.begin() + static_cast<std::ptrdiff_t>(i * size());
        const double sum = std::accumulate(row, row + static_cast<std::ptrdiff_t>(size()), 0.0);
        const double wanted = areas_[i] * (1 - (lost.empty() ? 0 : lost[i - range.begin]));
        exchange(i, i) += wanted - sum;
        row_error_ = std::max(row_error_, std::abs(wanted - sum) / areas_[i]);
    }
}

std::vector<double> DenseSystem::matrix(int channel) const {
    std::vector<double> m(size() * size());
    for (std::size_t i = 0; i < size(); ++i) {
        const double rho = reflectance_[i][channel];
        for (std::size_t j = 0; j < size(); ++j)
            m[i * size() + j] = (i == j ? 1 : 0) - rho / areas_[i] * exchange(i, j);
    }
    return m;
}

std::vector<Vec3> DenseSystem::solve() const {
    std::vector<Vec3> right(size());
    for (std::size_t i = 0; i < size(); ++i)
        right[i] = emission_[i] + reflectance_[i] * irradiance_[i];
    if (all_grey(reflectance_)) {
        eliminate(matrix(0), right);
        return right;
    }
    std::vector<Vec3> result(size());
    for (int c = 0; c < 3; ++c) {
        std::vector<Vec3> channel = right;
        eliminate(matrix(c), channel);
        for (std::size_t i = 0; i < size(); ++i)
            result[i][c] = channel[i][c];
    }
    return result;
}

} // namespace hemilux::test
