#include "radiosity/engine/linear/radiosity_system.h"

#include "radiosity/engine/linear/gmres.h"
#include "radiosity/engine/linear/unsolved_light.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/scene/needs.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

namespace {

/// Returns the residual of R = rho F (E + R), relative to R, by area. `x` is E + R and `arriving`
/// is F x.
double residual_of(const Mesh& mesh, int channel, std::span<const double> x,
                   std::span<const double> arriving) {
    double squares = 0, size = 0;
    for (std::uint32_t i = 0; i < x.size(); ++i) {
        const double area = mesh.patches()[i].area;
        const double reflected = x[i] - mesh.material(i).emission[channel];
        const double off = mesh.material(i).reflectance[channel] * arriving[i] - reflected;
        squares += area * off * off;
        size += area * reflected * reflected;
    }
    return std::sqrt(squares / size);
}

} // namespace

ArrivingLight arriving_light(const FormFactorProduct& multiply, const Mesh& mesh,
                             std::span<const Vec3> radiosity, const Needs& needs) {
    const std::size_t n = radiosity.size();
    std::vector<double> emission(n), rho(n), first(n), x(n), arriving(n);
    ArrivingLight light{std::vector<Vec3>(n)};
    for (int c = 0; c < 3; ++c) {
        if (!needs.solves(c)) {
            const int same = needs.channel[static_cast<std::size_t>(c)];
            for (Vec3& incident : light.incident)
                incident[c] = same == Needs::dark ? 0 : incident[same];
            continue;
        }
        double lost_at_least = 1;
        for (std::uint32_t i = 0; i < n; ++i) {
            emission[i] = mesh.material(i).emission[c];
            rho[i] = mesh.material(i).reflectance[c];
            x[i] = radiosity[i][c] - emission[i];
            lost_at_least = std::min(lost_at_least, 1 - rho[i]);
        }
        multiply(emission, first);
        for (std::size_t i = 0; i < n; ++i)
            first[i] *= rho[i];
        const GmresResult result = gmres(
            [&](const std::vector<double>& b, std::vector<double>& y) {
                multiply(b, y);
                for (std::size_t i = 0; i < n; ++i)
                    y[i] = b[i] - rho[i] * y[i];
            },
            first, x);
        for (std::size_t i = 0; i < n; ++i)
            x[i] += emission[i];
        multiply(x, arriving);
        for (std::uint32_t i = 0; i < n; ++i)
            light.incident[i][c] = arriving[i];
        if (!result.converged)
            light.unsolved = std::max(
                light.unsolved, unsolved_error(residual_of(mesh, c, x, arriving), lost_at_least));
    }
    return light;
}

} // namespace hemilux
