#include "radiosity/engine/linear/gmres.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

using Vector = std::vector<double>;

/// Residuals below the first, relative to b, can be rounding errors, and so can those below the
/// second, relative to x. The latter are larger where x is: in a very bright room.
constexpr double roughly_converged = 1e-10, rounding_of_products = 1e-14;

double dot(const Vector& a, const Vector& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double norm(const Vector& a) { return std::sqrt(dot(a, a)); }

void add_scaled(Vector& y, double factor, const Vector& x) {
    for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
}

void scale(Vector& x, double factor) {
    for (double& value : x)
        value *= factor;
}

/// A rotation of two neighbouring rows that makes the second entry zero.
struct Rotation {
    double c = 1, s = 0;
    Rotation(double a, double b) {
        const double r = elementary::hypot(a, b);
        if (r > 0) {
            c = a / r;
            s = b / r;
        }
    }
    void apply(double& a, double& b) const {
        const double rotated = c * a + s * b;
        b = c * b - s * a;
        a = rotated;
    }
};

/// One cycle of Arnoldi's method from the residual r, which adds the correction to x.
class Cycle {
  public:
    explicit Cycle(const LinearMap& multiply) : multiply_(multiply) {}

    /// Runs the cycle with at most `length` vectors and returns the number of products made.
    std::size_t run(std::size_t length, Vector& r, double beta, double goal, Vector& x) {
        basis_.clear();
        columns_.clear();
        rotations_.clear();
        scale(r, 1 / beta);
        basis_.push_back(r);
        rhs_.assign(1, beta);
        while (columns_.size() < length && std::abs(rhs_.back()) > goal && extend()) {
        }
        add_correction(x);
        return columns_.size();
    }

  private:
    /// Adds a basis vector and a column of the Hessenberg matrix; false when the space is
    /// exhausted.
    bool extend() {
        const std::size_t k = columns_.size();
        Vector w(basis_[0].size());
        multiply_(basis_[k], w);
        Vector h(k + 2);
        for (std::size_t i = 0; i <= k; ++i) {
            h[i] = dot(w, basis_[i]);
            add_scaled(w, -h[i], basis_[i]);
        }
        h[k + 1] = norm(w);
        const bool more = h[k + 1] > 0;
        if (more) {
            scale(w, 1 / h[k + 1]);
            basis_.push_back(std::move(w));
        }
        for (std::size_t i = 0; i < k; ++i)
            rotations_[i].apply(h[i], h[i + 1]);
        rotations_.emplace_back(h[k], h[k + 1]);
        rotations_[k].apply(h[k], h[k + 1]);
        rhs_.push_back(0);
        rotations_[k].apply(rhs_[k], rhs_[k + 1]);
        columns_.push_back(std::move(h));
        return more;
    }

    /// Solves for the correction by back substitution in the triangular matrix that the rotations
    /// have made.
    void add_correction(Vector& x) const {
        Vector y(columns_.size());
        for (std::size_t i = columns_.size(); i-- > 0;) {
            double sum = rhs_[i];
            for (std::size_t j = i + 1; j < columns_.size(); ++j)
                sum -= columns_[j][i] * y[j];
            y[i] = columns_[i][i] != 0 ? sum / columns_[i][i] : 0;
        }
        for (std::size_t i = 0; i < y.size(); ++i)
            add_scaled(x, y[i], basis_[i]);
    }

    const LinearMap& multiply_;
    std::vector<Vector> basis_, columns_;
    std::vector<Rotation> rotations_;
    Vector rhs_;
};

} // namespace

GmresResult gmres(const LinearMap& multiply, const std::vector<double>& b, std::vector<double>& x,
                  const GmresOptions& options) {
    GmresResult result;
    const double size = norm(b);
    if (!(size > 0)) {
        x.assign(b.size(), 0.0);
        return result;
    }
    Cycle cycle(multiply);
    Vector r(b.size());
    std::size_t length = options.restart;
    for (double before = INFINITY;;) {
        multiply(x, r);
        for (std::size_t i = 0; i < r.size(); ++i)
            r[i] = b[i] - r[i];
        const double beta = norm(r);
        result.residual = beta / size;
        // A residual within a factor of two of the last cycle's shows that only rounding errors are
        // left, where these can be as large.
        const bool rounding = result.residual > before / 2 &&
                              (before < roughly_converged || beta < rounding_of_products * norm(x));
        result.converged = !(result.residual > options.tolerance) || rounding;
        if (result.converged || result.iterations >= options.max_iterations)
            return result;
        // A cycle that gains less than this would not get to the tolerance within the iterations.
        const double share = double(length) / double(options.max_iterations);
        if (result.residual > elementary::pow(options.tolerance, share) * before)
            length = std::min(2 * length, std::max(options.max_restart, length));
        before = result.residual;
        result.iterations += cycle.run(length, r, beta, options.tolerance * size / 2, x);
    }
}

} // namespace hemilux
