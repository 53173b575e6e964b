#pragma once
// Owen-scrambled Sobol points in up to five dimensions: where on a patch a ray starts, where it
// goes, and to which of several lights.
//
// Any aligned block of 2^k points is a net: every dyadic box of volume 2^-k of dimensions (0,1)
// holds one of them, so smooth integrals converge almost as n^-3/2 instead of n^-1/2, and one can
// always go on. Direction numbers of Joe and Kuo (2008). The nested uniform scrambling of Owen
// (1995) is done by a hash (Laine and Karras 2011; Burley 2020): each seed gives an
// independent randomisation, and the order of the points is scrambled likewise, so that two
// sequences can be paired point by point.

#include <array>
#include <cstdint>

namespace hemilux {

/// Point `index` of the sequence of a seed; each coordinate is uniform in (0,1) over the seeds.
[[nodiscard]] std::array<double, 4> sobol4(std::uint32_t index, std::uint64_t seed);

/// The same points with a fifth coordinate.
[[nodiscard]] std::array<double, 5> sobol5(std::uint32_t index, std::uint64_t seed);

} // namespace hemilux
