// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rays of an image and the mesh's boundary as seen by one of them: the part that the passes
// share. The frame and its names are those of Module/Volume/RayFrame.h, the tables those of
// TetrahedralMesh.h and BoundaryTree.h.
//
// All decisions are taken in the ray-aligned projection: a vertex has coordinates (u, v) about the
// ray, the same function of vertex and ray wherever it is needed, rounded to whole grid units. The
// sign of an edge as seen by the ray is exact, a ray through an edge or a vertex counts as displaced
// by (e, e^2) for an arbitrarily small e, and edges whose ends coincide are ordered by vertex. So
// every cell that is entered has exactly one face to leave by, and a walk that begins on the
// boundary ends on the boundary.

#ifdef GL_ARB_gpu_shader5
#define EXACTLY_AS_WRITTEN precise
#else
#define EXACTLY_AS_WRITTEN
#endif

uniform samplerBuffer vertices;      // position, normalised scalar
uniform samplerBuffer treeNodes;     // per node: (center, skip), (half, face or -1)
uniform isamplerBuffer treeFaces;    // 3 vertices (first one complemented: faces in), cell face

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
uniform int enteringSign;            // outward * enteringSign > 0: counter-clockwise is entering
#if BENDING
// Rays go on behind a membrane: per pixel two texels side by side, see Module/Volume/BentLines.h, in
// one of several frames, given by their rows and by their axes in the frame of the view.
uniform sampler2D bentLines;
uniform vec3 frameRowX[6];
uniform vec3 frameRowY[6];
uniform vec3 frameRowDepth[6];
uniform vec3 frameAxisX[6];
uniform vec3 frameAxisY[6];
uniform vec3 frameAxisDepth[6];
#endif

// The mesh's radius in grid units: coordinates about a ray that meets the mesh stay below 2^23,
// where floats are whole numbers.
const float GRID_RADIUS = 4194304.0;
// Bounds, in grid units, the difference between a vertex's rounded coordinate and the same sum over
// a box that holds the vertex: 3.5 of rounding sums below 2^23, 1.25 of the half extent's, 0.5 of
// rounding to the grid.
const float BOX_MARGIN = 8.0;
// The same for depths, which are below 2 in size.
const float DEPTH_MARGIN = 1.9073486328125e-06;
// Products of grid coordinates are below 2^46, so rounding puts their difference off by less than
// 2^24. 32-bit integers know it up to a multiple of 2^32.
const float WRAP = 4294967296.0;

// Depths.
const float BEFORE_EVERYTHING = -1.0e+30;
const float AFTER_EVERYTHING = 1.0e+30;

// A vertex about the ray: u, v (grid units), depth, scalar.
#define RayVertex vec4

// The ray: u = dot(rayU, p) - rayOrigin.x, likewise v.
vec3 rayU;
vec3 rayV;
vec2 rayOrigin;
vec2 gridScale;      // grid units per frame unit, in u and v
vec3 rayPlace;       // at depth 0, in the frame of the view
vec3 rayAlong;       // what is added to it per depth
#if BENDING
vec3 rayDepth;       // depth = dot(rayDepth, p)
#define ROW_DEPTH rayDepth
#else
#define ROW_DEPTH rowDepth
#endif

// Sets up the line (x, y) = origin + depth * slope of the frame with these rows, but for rayPlace and
// rayAlong. False if it passes by the mesh's bounding sphere by more than `reach` grid units.
bool setUpLine(vec3 toX, vec3 toY, vec3 toDepth, vec2 origin, vec2 slope, vec2 reach)
{
#if BENDING
  rayDepth = toDepth;
#endif
  rayU = toX - slope.x * toDepth;
  rayV = toY - slope.y * toDepth;
  gridScale = vec2(GRID_RADIUS) / vec2(length(rayU), length(rayV));
  rayU *= gridScale.x;
  rayV *= gridScale.y;
  rayOrigin = origin * gridScale;
  return all(lessThanEqual(abs(rayOrigin), vec2(GRID_RADIUS + BOX_MARGIN) + reach));
}

// Sets up the ray of a pixel counted from the image's centre.
bool setUpRay(vec2 pixel, vec2 reach)
{
  vec2 origin = originBase + pixel.x * originPerColumn + pixel.y * originPerRow;
  vec2 slope = slopeBase + pixel.x * slopePerColumn + pixel.y * slopePerRow;
  rayPlace = vec3(origin, 0.0);
  rayAlong = vec3(slope, 1.0);
  return setUpLine(rowX, rowY, rowDepth, origin, slope, reach);
}

#if BENDING
// Sets up a line of a frame.
bool setUpBentRay(int frame, vec2 origin, vec2 slope, vec2 reach)
{
  rayPlace = origin.x * frameAxisX[frame] + origin.y * frameAxisY[frame];
  rayAlong = slope.x * frameAxisX[frame] + slope.y * frameAxisY[frame] + frameAxisDepth[frame];
  return setUpLine(
    frameRowX[frame], frameRowY[frame], frameRowDepth[frame], origin, slope, reach);
}
#endif

RayVertex fetchVertex(int index)
{
  vec4 p = texelFetch(vertices, index);
  EXACTLY_AS_WRITTEN vec2 uv =
    floor(vec2(dot(rayU, p.xyz), dot(rayV, p.xyz)) - rayOrigin + vec2(0.5));
  return vec4(uv, dot(ROW_DEPTH, p.xyz), p.w);
}

// Twice the area of (ray, p, q): its sign and zero are exact, its size is to 2^-23, however much of
// the products cancels. On needles of 1e4 seen aslant that is all but 2^-11: what a face's depth is
// interpolated by.
float edgeArea(RayVertex p, RayVertex q)
{
  float rounded = p.x * q.y - p.y * q.x;
  float wrapped = float(int(p.x) * int(q.y) - int(p.y) * int(q.x));
  return wrapped + WRAP * floor((rounded - wrapped) * (1.0 / WRAP) + 0.5);
}

// Whether (ray, p, q) is counter-clockwise, with the ray displaced by (e, e^2): the area less
// e (q.y - p.y) plus e^2 (q.x - p.x).
bool edgeTurnsLeft(RayVertex p, RayVertex q, float area, bool pBeforeQ)
{
  float decisive = area != 0.0 ? area : (p.y != q.y ? p.y - q.y : q.x - p.x);
  return decisive > 0.0 || (decisive == 0.0 && pBeforeQ);
}

// Whether the boundary tree's box number `node` may hold a vertex within `reach` grid units of the
// ray, given per unit of 1 and of depth. Yields the node to go on with and the leaf's face, or -1.
bool meetsBox(int node, vec2 reach, vec2 reachPerDepth, vec2 depthRange, out int next, out int leaf)
{
  vec4 center = texelFetch(treeNodes, 2 * node);
  vec4 extent = texelFetch(treeNodes, 2 * node + 1);
  float depth = dot(ROW_DEPTH, center.xyz);
  float depthReach = dot(abs(ROW_DEPTH), extent.xyz) + DEPTH_MARGIN;
  vec2 middle = vec2(dot(rayU, center.xyz), dot(rayV, center.xyz)) - rayOrigin;
  vec2 extentUV = vec2(dot(abs(rayU), extent.xyz), dot(abs(rayV), extent.xyz)) + vec2(BOX_MARGIN) +
    reach + reachPerDepth * (abs(depth) + depthReach);
  bool hit = abs(middle.x) <= extentUV.x && abs(middle.y) <= extentUV.y &&
    depth - depthReach <= depthRange.y && depth + depthReach >= depthRange.x;
  leaf = hit ? int(extent.w) : -1;
  next = hit ? node + 1 : int(center.w);
  return hit;
}
