#pragma once
// Lights that the command line adds to a scene: `--light 'disc at 0,2.4,0 towards 0,-1,0 radius .2
// watts 60'`, `--sun 1,-2,1,800`, `--sky 100`.

#include "geometry/vector.h"

#include <optional>
#include <string>
#include <string_view>

namespace hemilux {

/// An emitter of one disc or rectangle, or a light without extent.
struct LightSettings {
    enum class Kind { disc, rectangle, point, spot, ies };
    Kind kind = Kind::disc;
    Vec3 at{0.0}, towards{0.0};   ///< its middle [m]; the direction in which it shines
    double width = 0, height = 0; ///< sides of a rectangle; for a disc both are its diameter [m]
    double inner = 0, outer = 45; ///< cones of a spot: angles from its axis [degrees]
    /// One of them is given: the power that it emits in all, by channel [W]; what a surface emits
    /// [W/m2]; what a light without extent sends along its axis [W/sr].
    std::optional<Vec3> watts, emission, intensity;
    std::string photometry;    ///< path of an IES file; it has a strength of its own
    Vec3 across{0.0};          ///< the direction C = 0 of it; 0: along the nearest axis
    std::optional<Vec3> scale; ///< of its intensities [-]

    [[nodiscard]] bool has_extent() const { return kind == Kind::disc || kind == Kind::rectangle; }
};
inline constexpr const char* light_form =
    "disc at X,Y,Z towards X,Y,Z radius R watts W, or rectangle at X,Y,Z towards X,Y,Z size WxH "
    "watts W, or point at X,Y,Z watts W, or spot at X,Y,Z towards X,Y,Z inner DEGREES outer "
    "DEGREES watts W, or ies FILE at X,Y,Z towards X,Y,Z; in place of watts, emission E of a "
    "surface or intensity I of a point or spot; for ies, watts or scale S, and across X,Y,Z (its "
    "direction C = 0) may be left out; W, E, I and S are one number or R,G,B";
/// Reads this form, the pairs of words in any order; empty for any other text.
[[nodiscard]] std::optional<LightSettings> parse_light(std::string_view text);

struct SunSettings {
    Vec3 direction;  ///< direction in which its light goes
    Vec3 irradiance; ///< irradiance of a surface that faces it [W/m2]
};
/// Reads "X,Y,Z,IRRADIANCE" or "X,Y,Z,R,G,B"; empty for any other text.
[[nodiscard]] std::optional<SunSettings> parse_sun(std::string_view text);

} // namespace hemilux
