#pragma once
// Points at which a user wants to know the light (sensors), and the table of it.

#include "geometry/vector.h"
#include "io/results/csv.h"
#include "radiosity/light/final_gather/light_at_points.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;
class Workers;

/// A row of a file of points, in world units [m].
struct NamedPoint {
    Vec3 position;
    Vec3 given_normal; ///< normal as in the file
    Vec3 normal;       ///< unit
    std::size_t line;  ///< line in the file
};

/// Reads rows of six numbers x,y,z,nx,ny,nz with commas or blanks between them. A # begins a
/// comment, and the first row may be a header. A pipe is read too. Throws InputError with file and
/// line for any other row, for a normal without a direction and for a file without points.
[[nodiscard]] std::vector<NamedPoint> read_points(const std::string& path);

/// Reads rows of three numbers x,y,z in the same way, as directions that are not 0,0,0; returns
/// unit vectors.
[[nodiscard]] std::vector<Vec3> read_directions(const std::string& path);

/// Writes one row per point: its number from 0, and its position and normal as they were read. Then
/// follow the irradiance, the radiosity of the face that the point lies on, and the standard error
/// of the irradiance [W/m2], and `more`; these are empty beyond the lights. Throws OutputError.
void write_points_table(const std::string& path, const Mesh& mesh,
                        std::span<const NamedPoint> points, std::span<const Sensor> sensors,
                        std::span<const PointLight> lights, const Workers& workers,
                        const csv::MoreColumns& more = {});

} // namespace hemilux
