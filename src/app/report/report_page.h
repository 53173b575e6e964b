#pragma once
// The file of --report: one page of HTML that shows a solved scene to turn around, its patches'
// numbers and how the run went. It needs a browser with WebGL, and no network.
//
// The page is page.html with the style page.css, the scripts *.js and the data. JSON holds
// all that is not a number by patch (run_data.h). Numbers by patch or vertex are arrays of
// little-endian bytes in base64, each in an element whose id names it:
//
//   position     float32 x 3  of each vertex, world units, relative to `centre` of the JSON
//   light        float32 x 3  radiosity of each vertex, smoothed as in smooth.h
//   corners      uint32  x 4  vertices of each patch; triangle: [3] == [2]
//   triangles    uint32  x 4  patch and three vertices, in the order of patches: what is drawn of
//                             those on whose sides corners of others lie (absent where none is)
//   area         float32
//   radiosity    float32 x 3
//   error        float32 x 3  standard error of the radiosity; absent where it is zero, may be NaN
//   face, material, group  uint32; material and group count in the JSON's lists
//   hits         float32      rays that hit the patch; absent where they are not counted
//   vertices     float32 x 3  of the hemisphere that patches share, z away from the patch
//   cells        uint32  x 4  its triangles: three vertices, and the first of four children or 0
//   shares       float32      of each triangle: its part of a diffuse patch's power
//   counts       uint8        of each patch at each vertex: surfaces, 254 or more; 255: not counted
//                             (these four where the method is guided by densities)
//   light-1, -2, -4 ...  float16 x 3  radiosity after these steps, as multiples of `unit`
//   lamp-0, -1 ...  float16 x 3   radiosity by each lamp of --layers, as multiples of `lamp_unit`
//   smooth-lamp-0 ...  float16 x 3  the same of each vertex, smoothed
//   lamp-of      uint32       the lamp that each patch is of; 4294967295: of none
//   reflectance, emission  float32 x 3, where there are textures: means over each patch
//
// That is 60 bytes a patch, 84 with textures, 41 more with densities of depth 2, 6 for each step
// that has its light, 24 a vertex, and 16 a listed triangle; base64 makes 4 of 3.

#include "app/report/run_data.h"

#include <string>

namespace hemilux {

/// Writes the page, array by array. Throws OutputError and Interrupted.
void write_report_page(const std::string& path, const ReportContent& content);

} // namespace hemilux
