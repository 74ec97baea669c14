// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The walk of a ray through a tetrahedral mesh. The loops are flat, one step or one piece of the
// optical model per turn: rays side by side do not wait for each other's inner loops.

#if COMPACT_CELLS
// Per cell: the exclusive or of its vertices, from which three give the fourth; 4 links.
#define CELL_SIZE 5
#define FIRST_LINK 1
#else
// Per cell: 4 vertices, 4 links.
#define CELL_SIZE 8
#define FIRST_LINK 4
#endif
uniform isamplerBuffer cells;
uniform sampler3D entryTiles;        // per tile: faces to enter by, see vtkTetrahedraEntryTilesFS
uniform int numberOfCells;
uniform float tileSize;
uniform mat3 viewToWorld;            // in units of viewToWorldUnit
uniform float viewToWorldUnit;
uniform float nearDepth;
uniform vec2 depthNumerator;
uniform vec2 depthDenominator;
#if NUMBER_OF_CLIPPING_PLANES > 0
// Per plane, on its kept side >= 0: dot(constant, (1, i, j)) + depth * dot(perDepth, (1, i, j)), with
// the pixel (i, j) counted from the image's centre.
uniform vec3 clippingConstant[NUMBER_OF_CLIPPING_PLANES];
uniform vec3 clippingPerDepth[NUMBER_OF_CLIPPING_PLANES];
#endif
#if VERTEX_GRADIENTS
uniform samplerBuffer vertexGradients;
#endif
#if CELL_SCALARS
uniform samplerBuffer cellScalars;   // one per cell; those of the vertices do not count
#endif

const float BEFORE_EVERYTHING = -1.0e+30;
const int TILE_CAPACITY = 32;

vec2 rayPixel;       // from the image's centre
vec2 rayTilePixel;   // from its lower left corner
float rayLengthPerDepth;
float startDepth;
float endDepth;

// Where the walk is: the face just entered by, its vertices counter-clockwise about the ray.
RayVertex a;
RayVertex b;
RayVertex c;
ivec3 corners;       // their numbers
int apex;            // the vertex of the cell that the face entered by does not have
vec3 edges;          // twice the areas that edges ab, bc, ca span with the ray
int cell;
int face;
float faceDepth;     // where the ray meets that face
float faceScalar;    // of scalars of cells, the last one that counted
float depthNow;      // the largest depth reached

// The segment whose ray integral is pending.
float segmentLength;
float segmentStart;  // scalars
float segmentEnd;
float segmentDone;   // fraction integrated
float segmentScalar; // scalar there
#if VERTEX_GRADIENTS
vec3 gradientA;      // at the face's vertices
vec3 gradientB;
vec3 gradientC;
vec3 faceGradient;   // where the ray meets the face
vec3 segmentGradientStart;
vec3 segmentGradientEnd;
#endif
#if NEEDS_POSITION
float segmentStartDepth;
float segmentEndDepth;
#endif

//--- What the optical model does -------------------------------------------------------------------

// The ray begins.
void startRay();
// It enters a connected part of the mesh, or comes back into it, with this scalar.
void startPart(float scalar);
// Takes in the next piece of the pending segment; returns whether the segment is done.
bool integratePiece();
// Whether the rest of the ray cannot be seen.
bool isRayDone();
// Premultiplied colour of the ray.
vec4 finishRay();

//--- Walk ------------------------------------------------------------------------------------------

// Advances to the exit of a cell and makes its segment the pending one; false if it is empty. What
// lies before the largest depth reached, because of rounding, an inverted cell or cells that overlap,
// has been passed already and does not count again. Nor does a cell with a vertex without scalar.
#if VERTEX_GRADIENTS
bool advance(float exitDepth, float exitScalar, vec3 exitGradient)
#else
bool advance(float exitDepth, float exitScalar)
#endif
{
  float from = max(depthNow, startDepth);
  float to = min(exitDepth, endDepth);
#if CELL_SCALARS
  // One scalar throughout the cell. Isosurfaces also see the jump to it, unless the ray begins behind
  // that.
  segmentEnd = texelFetch(cellScalars, cell).r;
#if BLEND_MODE == ISOSURFACES
  segmentStart = startDepth <= faceDepth ? faceScalar : segmentEnd;
#else
  segmentStart = segmentEnd;
#endif
#else
  float perDepth = (exitScalar - faceScalar) / (exitDepth - faceDepth);
  segmentStart = from > faceDepth ? faceScalar + (from - faceDepth) * perDepth : faceScalar;
  segmentEnd = to < exitDepth ? faceScalar + (to - faceDepth) * perDepth : exitScalar;
#endif
  segmentScalar = segmentStart;
  segmentDone = 0.0;
  segmentLength = (to - from) * rayLengthPerDepth;
#if NEEDS_POSITION
  segmentStartDepth = from;
  segmentEndDepth = to;
#endif
#if VERTEX_GRADIENTS
  vec3 gradientPerDepth = (exitGradient - faceGradient) / (exitDepth - faceDepth);
  segmentGradientStart =
    from > faceDepth ? faceGradient + (from - faceDepth) * gradientPerDepth : faceGradient;
  segmentGradientEnd =
    to < exitDepth ? faceGradient + (to - faceDepth) * gradientPerDepth : exitGradient;
  faceGradient = exitGradient;
#endif
  faceDepth = exitDepth;
  depthNow = max(depthNow, exitDepth);
  bool counts = to > from && abs(segmentEnd - segmentStart) <= 4.0;
#if CELL_SCALARS
  faceScalar = counts || exitDepth <= startDepth ? segmentEnd : faceScalar;
#if BLEND_MODE != ISOSURFACES
  // Scalars that jump may be any number of the transfer function's intervals apart.
  if (counts)
  {
    startPart(segmentEnd);
  }
#endif
#else
  faceScalar = exitScalar;
#endif
  return counts;
}

// Crosses `cell` from `face`. Yields the link to follow; returns whether a segment is pending.
bool stepThroughCell(out int link)
{
#if COMPACT_CELLS
  int number = texelFetch(cells, CELL_SIZE * cell).r ^ corners.x ^ corners.y ^ corners.z;
#else
  int number = texelFetch(cells, CELL_SIZE * cell + face).r;
#endif
  apex = number;
  RayVertex x = fetchVertex(number);
  vec3 areas = vec3(edgeArea(x, a), edgeArea(x, b), edgeArea(x, c));
  bool leftOfA = edgeTurnsLeft(x, a, areas.x, number < corners.x);
  bool leftOfB = edgeTurnsLeft(x, b, areas.y, number < corners.y);
  bool leftOfC = edgeTurnsLeft(x, c, areas.z, number < corners.z);
  areas = abs(areas);

  // The ray leaves between two consecutive edges from x, left of one and right of the next. The third
  // vertex drops out; its rank among the cell's is where the link to follow stands.
  bool dropC = leftOfA && !leftOfB;
  bool dropA = !dropC && leftOfB && !leftOfC;
  bool dropB = !dropC && !dropA;
  int dropped = dropA ? corners.x : (dropB ? corners.y : corners.z);
  int rank = int(number < dropped) + int(corners.x < dropped) + int(corners.y < dropped) +
    int(corners.z < dropped);
  link = texelFetch(cells, CELL_SIZE * cell + FIRST_LINK + rank).r;

  // The exit face: x takes the dropped vertex's place, which keeps the sense of rotation.
  edges = vec3(dropC ? edges.x : (dropA ? areas.y : areas.x),
    dropA ? edges.y : (dropB ? areas.z : areas.y), dropB ? edges.z : (dropA ? areas.z : areas.x));
  a = dropA ? x : a;
  b = dropB ? x : b;
  c = dropC ? x : c;
  corners = ivec3(
    dropA ? number : corners.x, dropB ? number : corners.y, dropC ? number : corners.z);

  // A face without projected area keeps depth and scalar.
  float total = edges.x + edges.y + edges.z;
  vec2 exit = total > 0.0 ? (edges.y * a.zw + edges.z * b.zw + edges.x * c.zw) * (1.0 / total)
                          : vec2(faceDepth, faceScalar);
#if VERTEX_GRADIENTS
  vec3 gradientX = texelFetch(vertexGradients, number).xyz;
  gradientA = dropA ? gradientX : gradientA;
  gradientB = dropB ? gradientX : gradientB;
  gradientC = dropC ? gradientX : gradientC;
  return advance(exit.x, exit.y,
    total > 0.0
      ? (edges.y * gradientA + edges.z * gradientB + edges.x * gradientC) * (1.0 / total)
      : faceGradient);
#else
  return advance(exit.x, exit.y);
#endif
}

// Walks from the boundary to the boundary, or until the ray ends. Adds to the number of steps; false
// if the ray is lost.
bool walk(inout int steps)
{
  // A ray crosses a cell once through each of its 4 faces, in 2 orientations, at the most.
  int limit = steps + 8 * numberOfCells;
  int link = 0;
  bool pending = false;
  bool ended = false;
  // What is read after the loop goes around it: Mesa's llvmpipe (22.3) lets rays that are done go on
  // computing values that are only used behind a loop, and those come out wrong (test of lost rays).
  while (!ended && steps < limit)
  {
    if (!pending)
    {
      pending = stepThroughCell(link);
      ++steps;
    }
    if (pending)
    {
      pending = !integratePiece();
    }
    ended = isRayDone() || (!pending && (link < 0 || depthNow >= endDepth));
    if (!pending)
    {
      cell = link >> 2;
      face = link & 3;
    }
  }
  return ended;
}

//--- Entry -----------------------------------------------------------------------------------------

// A boundary face as seen by the ray.
struct SeenFace
{
  RayVertex p;
  RayVertex q;
  RayVertex r;
  ivec3 numbers;
  vec3 areas;
  vec2 point;   // depth and scalar where the ray meets it
  bool left;    // pqr is counter-clockwise if entered
  bool entered;
  int cellFace;
};

SeenFace seeFace(int index)
{
  SeenFace f;
  ivec4 record = texelFetch(treeFaces, index);
  f.left = (record.x < 0 ? -1 : 1) * enteringSign > 0;
  f.numbers = ivec3(record.x < 0 ? ~record.x : record.x, record.yz);
  f.cellFace = record.w;
  f.p = fetchVertex(f.numbers.x);
  f.q = fetchVertex(f.numbers.y);
  f.r = fetchVertex(f.numbers.z);
  f.areas = vec3(edgeArea(f.p, f.q), edgeArea(f.q, f.r), edgeArea(f.r, f.p));
  f.entered = edgeTurnsLeft(f.p, f.q, f.areas.x, true) == f.left &&
    edgeTurnsLeft(f.q, f.r, f.areas.y, true) == f.left &&
    edgeTurnsLeft(f.r, f.p, f.areas.z, false) == f.left;
  f.areas = abs(f.areas);
  float total = f.areas.x + f.areas.y + f.areas.z;
  // A face without projected area is met at its first vertex.
  f.point = total > 0.0
    ? (f.areas.y * f.p.zw + f.areas.z * f.q.zw + f.areas.x * f.r.zw) / total
    : f.p.zw;
  return f;
}

// The next entries of the ray in the order of depth, then number; -1 where there are none.
vec4 entryDepths;
ivec4 entryFaces;
bool moreEntries;

bool isBefore(float depth, int number, float otherDepth, int otherNumber)
{
  return depth < otherDepth || (depth == otherDepth && number < otherNumber);
}

void insertEntry(float depth, int number)
{
  moreEntries = moreEntries || entryFaces.w >= 0;
  for (int i = 0; i < 4; ++i)
  {
    if (entryFaces[i] < 0 || isBefore(depth, number, entryDepths[i], entryFaces[i]))
    {
      float otherDepth = entryDepths[i];
      int otherNumber = entryFaces[i];
      entryDepths[i] = depth;
      entryFaces[i] = number;
      depth = otherDepth;
      number = otherNumber;
      if (number < 0)
      {
        return;
      }
    }
  }
}

// Finds the next entries after (lastDepth, lastFace) among the faces listed for the ray's tile,
// or among those of the tree if they did not fit.
void collectEntries(float lastDepth, int lastFace)
{
  ivec2 tile = ivec2(rayTilePixel / tileSize);
  bool listed = texelFetch(entryTiles, ivec3(tile, 0), 0).x > -1.5;
  entryFaces = ivec4(-1);
  entryDepths = vec4(0.0);
  moreEntries = false;
  int at = 0;
  int end = listed ? TILE_CAPACITY : numberOfNodes;
  while (at < end)
  {
    int candidate;
    if (listed)
    {
      candidate = int(texelFetch(entryTiles, ivec3(tile, at / 4), 0)[at % 4]);
      at = candidate < 0 ? end : at + 1;
    }
    else
    {
      meetsBox(at, vec2(0.0), vec2(0.0), vec2(lastDepth, endDepth), at, candidate);
    }
    if (candidate >= 0)
    {
      SeenFace f = seeFace(candidate);
      if (f.entered && f.point.x < endDepth &&
        isBefore(lastDepth, lastFace, f.point.x, candidate))
      {
        insertEntry(f.point.x, candidate);
      }
    }
  }
}

// Puts the walk on the first of the entries found, and removes it from them.
void enterFirst()
{
  SeenFace f = seeFace(entryFaces.x);
  a = f.left ? f.p : f.q;
  b = f.left ? f.q : f.p;
  c = f.r;
  corners = f.left ? f.numbers : f.numbers.yxz;
  edges = f.left ? f.areas : f.areas.xzy;
  cell = f.cellFace >> 2;
  face = f.cellFace & 3;
  faceDepth = f.point.x;
#if CELL_SCALARS
  faceScalar = texelFetch(cellScalars, cell).r;
#else
  faceScalar = f.point.y;
#endif
  depthNow = max(depthNow, faceDepth);
#if VERTEX_GRADIENTS
  gradientA = texelFetch(vertexGradients, corners.x).xyz;
  gradientB = texelFetch(vertexGradients, corners.y).xyz;
  gradientC = texelFetch(vertexGradients, corners.z).xyz;
  float total = edges.x + edges.y + edges.z;
  faceGradient = total > 0.0
    ? (edges.y * gradientA + edges.z * gradientB + edges.x * gradientC) / total
    : gradientA;
#endif
  entryFaces = ivec4(entryFaces.yzw, -1);
  entryDepths = vec4(entryDepths.yzw, 0.0);
}

//--- Ray -------------------------------------------------------------------------------------------

// The visible part of the ray: from the near plane to opaque geometry, within the clipping planes.
void limitRay(float opaque)
{
  vec2 fraction = (2.0 * opaque - 1.0) * vec2(depthNumerator.x, depthDenominator.x) +
    vec2(depthNumerator.y, depthDenominator.y);
  startDepth = nearDepth;
  endDepth = fraction.x / fraction.y;
#if NUMBER_OF_CLIPPING_PLANES > 0
  vec3 place = vec3(1.0, rayPixel);
  for (int i = 0; i < NUMBER_OF_CLIPPING_PLANES; ++i)
  {
    float height = dot(clippingConstant[i], place);
    float perDepth = dot(clippingPerDepth[i], place);
    float met = -height / perDepth;
    startDepth = perDepth > 0.0 ? max(startDepth, met) : startDepth;
    endDepth = perDepth < 0.0 ? min(endDepth, met) : endDepth;
    endDepth = perDepth == 0.0 && height < 0.0 ? BEFORE_EVERYTHING : endDepth;
  }
  endDepth = startDepth < endDepth ? endDepth : BEFORE_EVERYTHING;
#endif
}

// Casts the ray of a pixel, given by its centre, up to an opaque depth of the window, in [0, 1].
// Yields cells crossed and walks that did not end on the boundary.
vec4 castRay(vec2 pixel, float opaque, out int steps, out int lost)
{
  rayTilePixel = pixel;
  rayPixel = pixel - imageCenter;
  depthNow = BEFORE_EVERYTHING;
  steps = 0;
  lost = 0;
  bool meetsMesh = setUpRay(rayPixel, vec2(0.0));
  rayLengthPerDepth = viewToWorldUnit * length(viewToWorld * vec3(raySlope, 1.0));
  limitRay(opaque);
  startRay();

  float lastDepth = BEFORE_EVERYTHING;
  int lastFace = -1;
  entryFaces = ivec4(-1);
  moreEntries = meetsMesh;
  while (!isRayDone() && depthNow < endDepth)
  {
    if (entryFaces.x < 0 && moreEntries)
    {
      collectEntries(lastDepth, lastFace);
    }
    if (entryFaces.x < 0)
    {
      break;
    }
    lastFace = entryFaces.x;
    enterFirst();
    lastDepth = faceDepth;
    startPart(faceScalar);
    lost += walk(steps) ? 0 : 1;
  }
  return finishRay();
}
