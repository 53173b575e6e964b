// Directions into the cells of the hemisphere, many at once.

#include "parallel/instruction_set.h"
#include "radiosity/engine/densities/cell_directions.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/statistics.h"

#include <memory>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// Draws one sample after the other, a batch at a time, all of one cell.
class Stream {
  public:
    Stream(const CellDirections& directions, std::uint16_t cell, std::uint64_t key)
        : directions_(directions), cell_(cell), key_(key) {}

    /// Moves on; returns the sample's place in the batch.
    std::size_t next() {
        if (at_ == batch->size) {
            batch->size = at_ = 0;
            while (!batch->full())
                batch->add(key_, number_++, cell_);
            directions_.draw(*batch);
        }
        return at_++;
    }
    Vec3 direction(std::size_t k) const { return {batch->x[k], batch->y[k], batch->z[k]}; }

    std::unique_ptr<DirectionBatch> batch = std::make_unique<DirectionBatch>();

  private:
    const CellDirections& directions_;
    std::uint16_t cell_;
    std::uint64_t key_;
    std::uint32_t number_ = 0;
    std::size_t at_ = 0;
};

constexpr std::size_t parts = 6;
const std::vector<double> even(parts* parts, 1.0 / (parts * parts));

std::size_t interval_of(double x) {
    return std::min(static_cast<std::size_t>(x * double(parts)), parts - 1);
}
std::size_t part_of(double u, double v) { return parts * interval_of(u) + interval_of(v); }

} // namespace

TEST_CASE("directions into each cell follow the cosine, and starts are uniform") {
    const Hemisphere hemisphere(2);
    const CellDirections directions(hemisphere, CellArea::projected_solid_angle);
    const double alpha = sidak(significance, 2 * hemisphere.cells().size());
    for (std::uint16_t c = 0; c < hemisphere.cells().size(); ++c) {
        const Histogram histogram(hemisphere.cells()[c].shape, 3);
        Stream stream(directions, c, hash_words({c, 1}));
        CHECK(chi_square(20'000, histogram.expected, [&] {
                  return histogram.cell(stream.direction(stream.next()));
              }).p_value > alpha);
        CHECK(chi_square(20'000, even, [&] {
                  const std::size_t k = stream.next();
                  return part_of(stream.batch->u[k], stream.batch->v[k]);
              }).p_value > alpha);
    }
}

TEST_CASE("directions into small cells follow the cosine too, depths 3 to 5") {
    const Hemisphere hemisphere(5);
    const CellDirections directions(hemisphere, CellArea::projected_solid_angle);
    // All of level 3, and as many of levels 4 and 5, from the pole to the horizon.
    std::vector<std::uint16_t> cells;
    for (const int level : {3, 4, 5}) {
        const std::size_t first = Hemisphere::cells_up_to(level - 1);
        const std::size_t count = Hemisphere::cells_up_to(level) - first;
        for (std::size_t c = 0; c < count; c += count / 256)
            cells.push_back(static_cast<std::uint16_t>(first + c));
    }
    REQUIRE(cells.size() == 3 * 256);
    double worst = 1;
    for (const std::uint16_t c : cells) {
        const Histogram histogram(hemisphere.cells()[c].shape);
        Stream stream(directions, c, hash_words({c, 2}));
        const double p = chi_square(2000, histogram.expected, [&] {
                             return histogram.cell(stream.direction(stream.next()));
                         }).p_value;
        worst = std::min(worst, p);
    }
    CHECK(worst > sidak(significance, cells.size()));
}

TEST_CASE("where a sample starts tells nothing of where it goes") {
    const Hemisphere hemisphere(1);
    const CellDirections directions(hemisphere, CellArea::projected_solid_angle);
    for (const std::uint16_t cell : {std::uint16_t{0}, std::uint16_t{7}}) {
        const Histogram histogram(hemisphere.cells()[cell].shape);
        std::vector<double> expected; // by start and part
        for (std::size_t start = 0; start < parts; ++start)
            for (const double share : histogram.expected)
                expected.push_back(share / double(parts));
        Stream stream(directions, cell, 99);
        for (const bool first : {true, false}) {
            const auto pair = [&] {
                const std::size_t k = stream.next();
                const double start = first ? stream.batch->u[k] : stream.batch->v[k];
                return interval_of(start) * histogram.expected.size() +
                       histogram.cell(stream.direction(k));
            };
            CHECK(chi_square(40'000, expected, pair).p_value > sidak(significance, 6));
        }
    }
    Stream stream(directions, whole_hemisphere, 99);
    for (const bool first : {true, false}) {
        const auto pair = [&] {
            const std::size_t k = stream.next();
            const Vec3 d = stream.direction(k);
            return part_of(first ? stream.batch->u[k] : stream.batch->v[k], d.x * d.x + d.y * d.y);
        };
        CHECK(chi_square(40'000, even, pair).p_value > sidak(significance, 6));
    }
}

TEST_CASE("directions into the whole hemisphere follow the cosine") {
    const Hemisphere hemisphere(0);
    const CellDirections directions(hemisphere, CellArea::projected_solid_angle);
    Stream stream(directions, whole_hemisphere, 5);
    CHECK(chi_square(50'000, even, [&] {
              const Vec3 d = stream.direction(stream.next());
              REQUIRE(d.z > 0);
              const double turn = std::atan2(d.y, d.x) / (2 * std::numbers::pi) + .5;
              return part_of(turn, d.x * d.x + d.y * d.y);
          }).p_value > significance);
}

TEST_CASE("a sample does not depend on which others are drawn with it") {
    const Hemisphere hemisphere(2);
    const CellDirections directions(hemisphere, CellArea::projected_solid_angle);
    auto all = std::make_unique<DirectionBatch>(), alone = std::make_unique<DirectionBatch>();
    for (std::uint32_t k = 0; !all->full(); ++k)
        all->add(k / 7, k, k % 5 == 0 ? whole_hemisphere : static_cast<std::uint16_t>(k % 84));
    directions.draw(*all);
    for (std::size_t k = 0; k < all->size; k += 3) {
        alone->size = 0;
        alone->add(k / 7, static_cast<std::uint32_t>(k), all->cell[k]);
        directions.draw(*alone);
        CHECK(alone->u[0] == all->u[k]);
        CHECK(alone->v[0] == all->v[k]);
        CHECK(alone->x[0] == all->x[k]);
        CHECK(alone->y[0] == all->y[k]);
        CHECK(alone->z[0] == all->z[k]);
    }
}

TEST_CASE("cells fill more than two fifths of their hulls at every level") {
    const Hemisphere hemisphere(Hemisphere::max_depth);
    for (const Hemisphere::Cell& cell : hemisphere.cells()) {
        const auto& [corner, edge, is_half] = cell.shape.hull();
        const double area = std::abs(edge[0].x * edge[1].y - edge[0].y * edge[1].x);
        CHECK(cell.projected_solid_angle > .4 * area * (is_half ? .5 : 1));
    }
}
