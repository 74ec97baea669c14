// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Rays/ExactEdgeTest.h (sign of an edge)
//
// The rays of an image, and the mesh's boundary in the frame of one ray: the code that the passes
// share. The frame and its names are those of Module/Volume/Rays/RayFrame.h, the tables those of
// TetrahedralMesh.h and BoundaryTree.h.
//
// All decisions are made in the ray-aligned projection: a vertex has coordinates (u, v) relative to
// the ray, the same function of vertex and ray wherever it is needed. Vertices are placed once per
// view in integers (vtkTetrahedraPlaceFS), from which u and v follow as floats by a difference of
// integers, always the same: near the ray all digits are kept. The sign of an edge relative to the
// ray is computed exactly from these floats. A ray through an edge or a vertex is treated as
// displaced by (e, e^2) for an arbitrarily small e, and edges whose ends coincide are ordered by
// vertex. Therefore every cell that is entered has exactly one face by which to leave, and a walk
// that begins on the boundary ends on the boundary.

#ifdef GL_ARB_gpu_shader5
#define EXACTLY_AS_WRITTEN precise
#else
#define EXACTLY_AS_WRITTEN
#endif

uniform isamplerBuffer vertices;     // placed: x, y, depth in grid units; bits of the scalar
uniform samplerBuffer treeNodes;     // per node: (center, skip), (half, face or -1)
uniform isamplerBuffer treeFaces;    // 3 vertices (first complemented: faces inwards), cell face

uniform int numberOfNodes;
uniform vec2 imageCenter;
uniform vec3 rowX;
uniform vec3 rowY;
uniform vec3 rowDepth;
uniform vec2 originBase;
uniform vec2 originPerColumn;
uniform vec2 originPerRow;
uniform vec2 slopeBase;
uniform vec2 slopePerColumn;
uniform vec2 slopePerRow;
// Grid units of x and y per unit of the frame.
uniform float gridPerUnit;
// Offset and slope of a pixel's ray in the grid, see FixedPointRays::GetGridMaps(): three times (x,
// y, fractions of x and y in units of 2^-15), for the base, per half column and per half row.
uniform int gridOffset[12];
uniform int gridSlope[12];
uniform int enteringSign;            // outward * enteringSign > 0: counter-clockwise is entering
#if REFRACTED
// A ray has several legs, one more behind each refracting interface. Leg 0 is the sight ray; of the
// others there are two adjacent texels per pixel, see Module/Volume/Refracted/RefractedRayTexels.h,
// those of leg k in image number k - 1, one above the other. They are in one of several frames,
// given by their rows and by their axes in the frame of the view.
uniform isampler2D refractedRays;
uniform vec3 frameRowX[NUMBER_OF_FRAMES];
uniform vec3 frameRowY[NUMBER_OF_FRAMES];
uniform vec3 frameRowDepth[NUMBER_OF_FRAMES];
uniform vec3 frameAxisX[NUMBER_OF_FRAMES];
uniform vec3 frameAxisY[NUMBER_OF_FRAMES];
uniform vec3 frameAxisDepth[NUMBER_OF_FRAMES];
uniform float frameGridPerUnit[NUMBER_OF_FRAMES];
uniform int frameFirstVertex[NUMBER_OF_FRAMES]; // start of the vertices placed in each frame
#endif

// Units of the frame per grid unit of depth (PacketVertex::GridPerDepth).
const float DEPTH_UNIT = 1.0 / GRID_PER_DEPTH;
// Unit of slopes (FixedPointRays::ShaderSlopeUnit).
const float SLOPE_UNIT = 1.0 / 2147483648.0;
// The mesh's radius in grid units, projected along a ray, is less than 2^30 - 2^12
// (FixedPointRays), and coordinates relative to a ray that meets the mesh are below 2^31.
//
// Bound, in grid units, of the difference between a vertex's u or v and the same sum in floats over
// a box that holds the vertex. Terms are below 2^30 and rounded to 2^-24 of themselves: 3.5 * 64
// for those of a dot product and their sums, 3 * 64 for the rows, 3 * 32 for the box (of vertices
// in floats), 1.25 * 64 for the half extent, 2 * 64 for the origin, 65 for u itself and its
// rounding to float: 785.
const float BOX_MARGIN = 1024.0;
// The same bound for depths, which are below 2 in magnitude.
const float DEPTH_MARGIN = 1.9073486328125e-06;

// Depths in grid units. The mesh is within 2^30; limits of rays are clamped to that.
const int BEFORE_EVERYTHING = -2147483647;
const int AFTER_EVERYTHING = 2147483647;
const float LARGEST_LIMIT = 1073741824.0;

// A vertex relative to the ray: u and v as bits of floats, depth in grid units, bits of the scalar.
#define RayVertex ivec4

// The ray: (u, v) = (x, y) - rayOffset - rayFraction - depth * raySlope.
ivec2 rayOffset;
vec2 rayFraction;
vec2 raySlope;
vec2 raySlopeHigh;   // leading 9 digits of the slope
vec2 raySlopeLow;    // remaining digits
// The ray in floats: u = dot(rayU, p) - rayOrigin.x, likewise v.
vec3 rayU;
vec3 rayV;
vec2 rayOrigin;
vec3 rayPlace;       // position at depth 0, in the frame of the view
vec3 rayAlong;       // change of the position per depth
#if REFRACTED
vec3 rayDepth;       // depth = dot(rayDepth, p)
int rayFirstVertex;  // start of the vertices placed for the ray
float rayGrid;       // grid units of x and y per unit of the frame
#define ROW_DEPTH rayDepth
#define FIRST_VERTEX rayFirstVertex
#define RAY_GRID rayGrid
#else
#define ROW_DEPTH rowDepth
#define FIRST_VERTEX 0
#define RAY_GRID gridPerUnit
#endif

// Sets the slope in the grid, given in units of SLOPE_UNIT, as an integer and a fraction.
void setSlope(ivec2 slope, vec2 fraction)
{
  raySlope = vec2(slope) * SLOPE_UNIT;
  raySlopeHigh = vec2(slope >> 22) * (1.0 / 512.0);
  ivec2 low = slope & 4194303;
  raySlopeLow = (vec2(low) + fraction) * SLOPE_UNIT;
}

// Sets up the line (x, y) = origin + depth * slope of the frame with these rows, except for
// rayPlace, rayAlong and the line in the grid. Returns false if it misses the mesh's bounding
// sphere by more than `reach` grid units.
bool setUpLine(vec3 toX, vec3 toY, vec3 toDepth, vec2 origin, vec2 slope, vec2 reach)
{
#if REFRACTED
  rayDepth = toDepth;
#endif
  rayU = (toX - slope.x * toDepth) * RAY_GRID;
  rayV = (toY - slope.y * toDepth) * RAY_GRID;
  rayOrigin = origin * RAY_GRID;
  return all(lessThanEqual(
    abs(rayOrigin), vec2(length(rayU), length(rayV)) + vec2(BOX_MARGIN) + reach));
}

// An affine function of the pixel in the grid, rounded down, and the remainder in units of 2^-15;
// `halves` counts half pixels from the image's centre.
ivec4 gridValue(int map[12], ivec2 halves)
{
  ivec4 sum = ivec4(map[0], map[1], map[2], map[3]) +
    halves.x * ivec4(map[4], map[5], map[6], map[7]) +
    halves.y * ivec4(map[8], map[9], map[10], map[11]);
  return ivec4(sum.xy + (sum.zw >> 15), sum.zw & 32767);
}

// Sets up the ray of a pixel counted from the image's centre.
bool setUpRay(vec2 pixel, vec2 reach)
{
  vec2 origin = originBase + pixel.x * originPerColumn + pixel.y * originPerRow;
  vec2 slope = slopeBase + pixel.x * slopePerColumn + pixel.y * slopePerRow;
  rayPlace = vec3(origin, 0.0);
  rayAlong = vec3(slope, 1.0);
  ivec2 halves = ivec2(floor(2.0 * pixel + vec2(0.5)));
  ivec4 offset = gridValue(gridOffset, halves);
  rayOffset = offset.xy;
  rayFraction = vec2(offset.zw) * (1.0 / 32768.0);
  ivec4 gridded = gridValue(gridSlope, halves);
  setSlope(gridded.xy, vec2(gridded.zw) * (1.0 / 32768.0));
#if REFRACTED
  rayFirstVertex = 0;
  rayGrid = gridPerUnit;
#endif
  return setUpLine(rowX, rowY, rowDepth, origin, slope, reach);
}

#if REFRACTED
// Size of the image in pixels.
ivec2 legImageSize()
{
  return textureSize(refractedRays, 0) / ivec2(2, NUMBER_OF_LEGS - 1);
}

// First or second texel of a pixel's refracted leg.
ivec4 fetchLegTexel(ivec2 pixel, int leg, int texel)
{
  ivec2 place = ivec2(2 * pixel.x + texel, (leg - 1) * legImageSize().y + pixel.y);
  return texelFetch(refractedRays, place, 0);
}

// Sets up a line of a frame from its offset and slope in the grid.
bool setUpRefractedRay(int frame, ivec4 line, vec2 reach)
{
  rayFirstVertex = frameFirstVertex[frame];
  rayGrid = frameGridPerUnit[frame];
  rayOffset = line.xy;
  rayFraction = vec2(0.0);
  setSlope(line.zw, vec2(0.0));
  vec2 origin = vec2(line.xy) / rayGrid;
  vec2 slope = vec2(line.zw) * (GRID_PER_DEPTH * SLOPE_UNIT / rayGrid);
  rayPlace = origin.x * frameAxisX[frame] + origin.y * frameAxisY[frame];
  rayAlong = slope.x * frameAxisX[frame] + slope.y * frameAxisY[frame] + frameAxisDepth[frame];
  return setUpLine(
    frameRowX[frame], frameRowY[frame], frameRowDepth[frame], origin, slope, reach);
}
#endif


// Integer part of the product of a depth and the ray's slope, and the rest, with the fraction of
// the ray's offset. The leading 15 digits of one times the leading 9 digits of the other are an
// integer of 24 digits, which is exact; the rest is below 2^22 and has an error of 1/4.
ivec2 multiplySlope(int depth, out vec2 rest)
{
  float high = float(depth & -32768);
  float low = float(depth & 32767);
  EXACTLY_AS_WRITTEN vec2 leading = high * raySlopeHigh;
  EXACTLY_AS_WRITTEN vec2 more = high * raySlopeLow + (low * raySlope + rayFraction);
  rest = more;
  return ivec2(leading);
}

RayVertex fetchVertex(int index)
{
  ivec4 p = texelFetch(vertices, FIRST_VERTEX + index);
  vec2 rest;
  ivec2 leading = multiplySlope(p.z, rest);
  EXACTLY_AS_WRITTEN vec2 uv = vec2(p.xy - rayOffset - leading) - rest;
  return ivec4(floatBitsToInt(uv), p.zw);
}

vec2 placeOf(RayVertex p)
{
  return intBitsToFloat(p.xy);
}

float vertexScalar(RayVertex p)
{
  return intBitsToFloat(p.w);
}

// Depth in the frame.
float frameDepthOf(int depth)
{
  return float(depth) * DEPTH_UNIT;
}

// A depth of the frame in grid units, or a value before or behind the whole mesh if it is there.
int gridDepthOf(float depth)
{
  return int(clamp(depth * GRID_PER_DEPTH, -LARGEST_LIMIT, LARGEST_LIMIT));
}

// The 12 leading binary digits of a float's 24; the remaining ones are the difference.
vec2 leadingDigits(vec2 x)
{
  return intBitsToFloat(floatBitsToInt(x) & -4096);
}

// Twice the area of (ray, p, q), a.x b.y - a.y b.x: its sign and zero are exact, and its magnitude
// has a relative error of 2^-22, however much of the products cancels. The products' rounding
// errors are found without error (T. J. Dekker, 1971; products of 12 digits are exact, whether
// fused or not) and added: the method of Cornea, Harrison and Tang, whose relative error is at most
// 2^-23 or so (C.-P. Jeannerod, "A radix-independent error analysis of the Cornea-Harrison-Tang
// method", 2016). Coordinates are multiples of 2^-15 below 2^31, so nothing under- or overflows.
float edgeArea(RayVertex p, RayVertex q)
{
  vec2 a = placeOf(p);
  vec2 b = placeOf(q).yx;
  vec2 highA = leadingDigits(a);
  vec2 highB = leadingDigits(b);
  EXACTLY_AS_WRITTEN vec2 lowA = a - highA;
  EXACTLY_AS_WRITTEN vec2 lowB = b - highB;
  EXACTLY_AS_WRITTEN vec2 product = a * b;
  EXACTLY_AS_WRITTEN vec2 rest =
    ((highA * highB - product) + highA * lowB + lowA * highB) + lowA * lowB;
  EXACTLY_AS_WRITTEN float area = (product.x - product.y) + (rest.x - rest.y);
  return area;
}

// True if (ray, p, q) is counter-clockwise, with the ray displaced by (e, e^2): the area less e
// (q.y - p.y) plus e^2 (q.x - p.x).
bool edgeTurnsLeft(RayVertex p, RayVertex q, float area, bool pBeforeQ)
{
  vec2 a = placeOf(p);
  vec2 b = placeOf(q);
  float decisive = area != 0.0 ? area : (a.y != b.y ? a.y - b.y : b.x - a.x);
  return decisive > 0.0 || (decisive == 0.0 && pBeforeQ);
}

// True if box number `node` of the boundary tree may hold a vertex, in a range of depths in grid
// units, within a distance of the ray; the distance in grid units is `reach` plus `reachPerDepth`
// per unit of depth. Returns the node to continue with, and the leaf's face or -1.
bool meetsBox(
  int node, vec2 reach, vec2 reachPerDepth, ivec2 depthRange, out int next, out int leaf)
{
  vec4 center = texelFetch(treeNodes, 2 * node);
  vec4 extent = texelFetch(treeNodes, 2 * node + 1);
  float depth = dot(ROW_DEPTH, center.xyz);
  float depthReach = dot(abs(ROW_DEPTH), extent.xyz) + DEPTH_MARGIN;
  vec2 middle = vec2(dot(rayU, center.xyz), dot(rayV, center.xyz)) - rayOrigin;
  vec2 extentUV = vec2(dot(abs(rayU), extent.xyz), dot(abs(rayV), extent.xyz)) + vec2(BOX_MARGIN) +
    reach + reachPerDepth * (abs(depth) + depthReach);
  bool hit = abs(middle.x) <= extentUV.x && abs(middle.y) <= extentUV.y &&
    depth - depthReach <= frameDepthOf(depthRange.y) &&
    depth + depthReach >= frameDepthOf(depthRange.x);
  leaf = hit ? int(extent.w) : -1;
  next = hit ? node + 1 : int(center.w);
  return hit;
}
