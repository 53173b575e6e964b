#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/solving/shared_stop.h"

#include "geometry/numeric.h"
#include "parallel/gathered_vector.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace hemilux {
namespace {

constexpr int max_iterations = 1000;

/// Solved patches rest when they are this share of the lit ones. Their residual is at most so much
/// of the tolerance.
constexpr double share_at_rest = 1.0 / 2, residual_at_rest = 1.0 / 2;
/// Where patches had to be woken so often, as all depend on each other, none rests any more.
constexpr int max_wakings = 4;
/// Less light than this share of the guess at a patch is as good as none: a part of the scene that
/// no light has reached this time has exactly none, which no relative residual would find.
constexpr double share_of_guess = 1e-10;

/// Returns the square of a residual relative to the size of the light it belongs to. It is at most
/// 1, also where there is no light yet. What is not reflected is left to the step after the last.
Vec3 relative_square(const Vec3& residual, const Vec3& light, const Vec3& weight) {
    const auto one = [](double r, double h, double w) {
        if (!(w > 0) || r == 0)
            return 0.0;
        return std::abs(r) < h ? (r / h) * (r / h) : 1.0;
    };
    return {one(residual.x, light.x, weight.x), one(residual.y, light.y, weight.y),
            one(residual.z, light.z, weight.z)};
}

/// Returns whether there is light that is reflected, by channel 1 or 0.
Vec3 is_lit(const Vec3& residual, const Vec3& light, const Vec3& weight) {
    const auto one = [](double r, double h, double w) {
        return w > 0 && (r != 0 || h != 0) ? 1.0 : 0.0;
    };
    return {one(residual.x, light.x, weight.x), one(residual.y, light.y, weight.y),
            one(residual.z, light.z, weight.z)};
}

double max_channel(const Vec3& x) { return std::max({x.x, x.y, x.z}); }

/// Sums over patches.
struct Sums {
    Vec3 squares{0.0};            ///< squares of the residual, weighted
    Vec3 relative{0.0}, lit{0.0}; ///< squares of the relative residual; area
    double lit_patches = 0, unsolved_patches = 0;

    Sums& operator+=(const Sums& other) {
        squares += other.squares;
        relative += other.relative;
        lit += other.lit;
        lit_patches += other.lit_patches;
        unsolved_patches += other.unsolved_patches;
        return *this;
    }
};

/// The iterations. The arrays hold values of this rank's patches only; the others' are never
/// touched.
class Gradients {
  public:
    Gradients(const ExchangeMatrix& factors, std::span<const double> area,
              std::span<const Vec3> reflectance, std::span<const Vec3> d, std::vector<Vec3>& h,
              const Workers& workers, double tolerance)
        : factors_(factors), workers_(workers), area_(area), reflectance_(reflectance), d_(d),
          h_(h), solved_square_(tolerance * tolerance * residual_at_rest * residual_at_rest),
          chunks_((h.size() + factors.rows_per_chunk - 1) / factors.rows_per_chunk) {
        for_patches([&](std::size_t i) { least_[i] = share_of_guess * glm::abs(h_[i]); });
        measure();
    }

    /// Returns the relative residual of the worst channel; of patches at rest, as it was when they
    /// came to rest.
    [[nodiscard]] double residual() const {
        return std::sqrt(max_channel(
            ratio_or_zero(sums_.relative + resting_.relative, sums_.lit + resting_.lit)));
    }
    [[nodiscard]] bool some_rest() const { return resting_.lit_patches > 0; }

    /// Computes the residual of all patches; none rests then.
    void measure() {
        for_patches([&](std::size_t i) {
            p_[i] = Vec3(0.0);
            rests_[i] = false;
            reflect(i, h_[i]);
        });
        reflected_.gather();
        sums_ = sum(parts_of_sums_, [&](std::size_t i) {
            r_[i] = d_[i] - (h_[i] - factors_.row_times(i, reflected_));
            return residual_at(i);
        });
        resting_ = Sums{};
        factors_.count_products(1);
    }

    /// Goes a step towards the solution, for the patches that do not rest.
    void iterate(bool may_rest) {
        if (may_rest && sums_.unsolved_patches <= share_at_rest * sums_.lit_patches)
            let_rest();
        for_patches([&](std::size_t i) {
            if (rests_[i])
                return;
            p_[i] = r_[i] + more_ * p_[i];
            reflect(i, p_[i]);
        });
        reflected_.gather();
        const Vec3 curvature = sum(parts_of_curvature_, [&](std::size_t i) {
            if (rests_[i])
                return Vec3(0.0);
            q_[i] = p_[i] - factors_.row_times(i, reflected_);
            return weight(i) * p_[i] * q_[i];
        });
        // A channel that is done, or dark, stands still.
        const Vec3 step = ratio_or_zero(sums_.squares, curvature);
        const Vec3 before = sums_.squares;
        sums_ = sum(parts_of_sums_, [&](std::size_t i) {
            if (rests_[i])
                return Sums{};
            h_[i] += step * p_[i];
            r_[i] -= step * q_[i];
            return residual_at(i);
        });
        more_ = ratio_or_zero(sums_.squares, before);
        factors_.count_products(1); // at most
    }

    /// Where nothing is reflected the weight is 0: there one more step without a product gives h.
    void end() {
        for_patches([&](std::size_t i) { h_[i] += r_[i]; });
        factors_.own_rows().gather(h_);
    }

  private:
    [[nodiscard]] Vec3 weight(std::size_t i) const { return area_[i] * reflectance_[i]; }
    void reflect(std::size_t i, const Vec3& x) {
        reflected_[i] = factors_.scaled(i, reflectance_[i] * x);
    }
    [[nodiscard]] Sums residual_at(std::size_t i) const {
        const Vec3 relative =
            relative_square(r_[i], glm::max(glm::abs(h_[i]), least_[i]), weight(i));
        const Vec3 lit = is_lit(r_[i], h_[i], weight(i));
        return {weight(i) * r_[i] * r_[i], area_[i] * relative, area_[i] * lit, max_channel(lit),
                max_channel(relative) > solved_square_ ? 1.0 : 0.0};
    }

    /// Lets the patches rest that are solved or reflect nothing.
    void let_rest() {
        for_patches([&](std::size_t i) {
            const Sums at = residual_at(i);
            if (at.unsolved_patches > 0 || (at.lit_patches == 0 && weight(i) != Vec3(0.0)))
                return; // light may still come to a dark patch
            rests_[i] = true;
            reflect(i, Vec3(0.0));
        });
        const auto of = [&](bool rest) {
            return sum(parts_of_sums_,
                       [&](std::size_t i) { return rests_[i] == rest ? residual_at(i) : Sums{}; });
        };
        resting_ = of(true);
        sums_ = of(false);
        more_ = Vec3(0.0); // directions begin anew
    }

    template <class Body>
    void for_patches(const Body& body) const {
        factors_.for_rows(workers_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                body(i);
        });
    }
    /// Sums term(i) over all patches, in an order that does not depend on the threads or ranks.
    template <class Value, class Term>
    Value sum(GatheredVector<Value>& parts, const Term& term) const {
        factors_.own_rows().ranks().wait_for_all(); // others may read the parts of the sum before
        factors_.for_rows(workers_, [&](std::size_t begin, std::size_t end) {
            Value some{};
            for (std::size_t i = begin; i < end; ++i)
                some += term(i);
            parts[begin / factors_.rows_per_chunk] = some;
        });
        parts.gather();
        Value all{};
        for (std::size_t chunk = 0; chunk < chunks_; ++chunk)
            all += parts[chunk];
        return all;
    }
    [[nodiscard]] OwnBlocks own_chunks() const {
        const OwnBlocks& rows = factors_.own_rows();
        return {rows.ranks(), chunks_, rows.block() / factors_.rows_per_chunk};
    }
    template <class Value>
    [[nodiscard]] std::unique_ptr<Value[]> of_patches() const {
        return std::make_unique_for_overwrite<Value[]>(h_.size());
    }

    const ExchangeMatrix& factors_;
    const Workers& workers_;
    std::span<const double> area_;
    std::span<const Vec3> reflectance_, d_;
    std::vector<Vec3>& h_;
    double solved_square_; ///< square of the relative residual of a solved patch, at most
    std::size_t chunks_;
    std::unique_ptr<Vec3[]> r_ = of_patches<Vec3>(), p_ = of_patches<Vec3>(),
                            q_ = of_patches<Vec3>(), least_ = of_patches<Vec3>();
    std::unique_ptr<bool[]> rests_ = of_patches<bool>();
    GatheredVector<Lanes> reflected_{factors_.own_rows()};
    GatheredVector<Vec3> parts_of_curvature_{own_chunks()};
    GatheredVector<Sums> parts_of_sums_{own_chunks()};
    Vec3 more_{0.0};
    Sums sums_, resting_; ///< sums over the patches that do not rest, and over those that do
};

} // namespace

GradientsResult solve_by_gradients(const ExchangeMatrix& factors, std::span<const double> area,
                                   std::span<const Vec3> reflectance, std::span<const Vec3> d,
                                   std::vector<Vec3>& h, const Workers& workers, double tolerance,
                                   const StopFlag* interrupted) {
    Gradients gradients(factors, area, reflectance, d, h, workers, tolerance);
    bool stopped = false;
    int iterations = 0, wakings = 0;
    for (; iterations < max_iterations; ++iterations) {
        if (!(gradients.residual() > tolerance) && gradients.some_rest()) {
            gradients.measure();
            ++wakings;
        }
        stopped = gradients.residual() > tolerance && interrupted && agree(*interrupted);
        if (!(gradients.residual() > tolerance) || stopped)
            break;
        gradients.iterate(wakings < max_wakings);
    }
    if (gradients.some_rest() && !stopped)
        gradients.measure();
    gradients.end();
    const double residual = gradients.residual();
    return {iterations, residual, iterations < max_iterations || !(residual > tolerance)};
}

} // namespace hemilux
