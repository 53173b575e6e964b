#include "radiosity/engine/linear/radiosity_system.h"

#include "radiosity/engine/linear/gmres.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {

std::vector<Vec3> arriving_light(const FormFactorProduct& multiply, const Mesh& mesh,
                                 std::span<const Vec3> radiosity, bool colours) {
    const std::size_t n = radiosity.size();
    std::vector<double> emission(n), rho(n), first(n), x(n), arriving(n);
    std::vector<Vec3> incident(n);
    const int channels = colours ? 3 : 1;
    for (int c = 0; c < channels; ++c) {
        for (std::uint32_t i = 0; i < n; ++i) {
            emission[i] = mesh.material(i).emission[c];
            rho[i] = mesh.material(i).reflectance[c];
            x[i] = radiosity[i][c] - emission[i];
        }
        multiply(emission, first);
        for (std::size_t i = 0; i < n; ++i)
            first[i] *= rho[i];
        gmres(
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
            incident[i][c] = arriving[i];
    }
    if (channels == 1)
        for (Vec3& all : incident)
            all = Vec3(all.r);
    return incident;
}

} // namespace hemilux
