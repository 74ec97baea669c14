//VTK::System::Dec
#extension GL_ARB_gpu_shader5 : enable

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Rays/FixedPointRays.cxx (place of a vertex)
//
// Places vertices in the grid of a view (Module/Volume/Rays/FixedPointRays.h), one per fragment.
// The kernel does the same in double precision; here it is done in 64-bit fixed point. Coefficients
// are integers and remainders, whose products are added in floats: these are below 3/4 of a grid
// unit and precise to 2^-22 of it. Results are rounded by 1/2. All shaders that read the vertices
// read these integers.

in vec2 texCoord;

out ivec4 placed;

uniform isamplerBuffer modelVertices; // fixed-point position, bits of the normalised scalar
uniform int firstVertex;              // first vertex of the fragments
uniform int columns;                  // number of vertices in a row of fragments
uniform int rows;                     // number of rows of fragments
uniform int toGrid[9];                // rows in units of 2^-31
uniform float toGridRest[9];          // remainders of these, at most 1/2

// a * b = high * 2^32 + low
void multiply(ivec3 a, ivec3 b, out ivec3 high, out uvec3 low)
{
#ifdef GL_ARB_gpu_shader5
  ivec3 bits;
  imulExtended(a, b, high, bits);
  low = uvec3(bits);
#else
  // By halves of 16 bits; the lower ones are unsigned.
  ivec3 lowA = a & 0xffff;
  ivec3 lowB = b & 0xffff;
  ivec3 highA = a >> 16;
  ivec3 highB = b >> 16;
  ivec3 first = highA * lowB + ivec3((uvec3(lowA) * uvec3(lowB)) >> 16u);
  ivec3 second = lowA * highB + (first & 0xffff);
  high = highA * highB + (first >> 16) + (second >> 16);
  low = uvec3(a) * uvec3(b);
#endif
}

// A row times a position, in whole units: the 64-bit sum of three products over 2^31, rounded. The
// last three bits of each product are dropped, so that the sum of the lower words fits.
int along(int row, ivec3 position)
{
  ivec3 high;
  uvec3 low;
  multiply(ivec3(toGrid[row], toGrid[row + 1], toGrid[row + 2]), position, high, low);
  low >>= 3u;
  vec3 rests = vec3(toGridRest[row], toGridRest[row + 1], toGridRest[row + 2]);
  int more = int(0.125 * dot(rests, vec3(position)));
  // 1/2 to round, and 1 because `more` may be negative.
  uint sum = low.x + low.y + low.z + uint(more + (3 << 27));
  return 2 * (high.x + high.y + high.z) + int(sum >> 28) - 1;
}

void main()
{
  ivec2 fragment = ivec2(texCoord * vec2(float(columns), float(rows)));
  ivec4 vertex = texelFetch(modelVertices, firstVertex + fragment.y * columns + fragment.x);
  placed = ivec4(along(0, vertex.xyz), along(3, vertex.xyz), along(6, vertex.xyz), vertex.w);
}
