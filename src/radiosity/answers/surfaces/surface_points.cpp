#include "radiosity/answers/surfaces/surface_points.h"

#include "geometry/numeric.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {

std::vector<FactorPoint> factor_points(std::span<const FactorPlace> places, const Mesh& mesh,
                                       const Tracer& tracer) {
    std::vector<FactorPoint> points;
    for (const FactorPlace& place : places) {
        const Sensor sensor = sensor_at(mesh, tracer, mesh.frame().to_local(place.position),
                                        direction_of(place.normal));
        points.push_back({sensor.at.position, sensor.at.normal, sensor.at.facet});
    }
    return points;
}

} // namespace hemilux
