//VTK::System::Dec
#extension GL_ARB_gpu_shader5 : enable

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Casts one ray per fragment through a tetrahedral mesh, in one pass. The loops are flat, one step or
// one piece of the ray integral per turn: rays side by side do not wait for each other's inner loops.

in vec2 texCoord;

//VTK::Output::Dec

//VTK::TetrahedraRays::Dec

uniform isamplerBuffer cells;        // per cell: 4 vertices, 4 links
uniform samplerBuffer intervals;     // transfer function: 3 texels per interval
uniform sampler3D entryTiles;        // per tile: faces to enter by, see vtkTetrahedraEntryTilesFS
uniform sampler2D opaqueDepth;

uniform int numberOfCells;
uniform int numberOfIntervals;
uniform float tileSize;
uniform mat3 viewToWorld; // in units of viewToWorldUnit
uniform float viewToWorldUnit;
uniform float nearDepth;
uniform vec2 depthNumerator;
uniform vec2 depthDenominator;
uniform float terminationTransmittance;

const float BEFORE_EVERYTHING = -1.0e+30;
const int TILE_CAPACITY = 32;
// Optical depth of a piece beyond which nothing can be told apart; keeps infinities out.
const float LARGEST_DEPTH = 1.0e+30;

float rayLengthPerDepth;
float endDepth;

// Where the walk is: the face just entered by, its vertices counter-clockwise about the ray.
RayVertex a;
RayVertex b;
RayVertex c;
ivec3 corners;       // their numbers
vec3 edges;          // twice the areas that edges ab, bc, ca span with the ray
int cell;
int face;
float faceDepth;     // where the ray meets that face
float faceScalar;
float depthNow;      // the largest depth reached

// The segment whose ray integral is pending.
float segmentLength;
float segmentStart;  // scalars
float segmentEnd;
float segmentDone;   // fraction integrated
float segmentScalar; // scalar there

// What has been collected.
vec3 color;
float transmittance;

// The transfer function's current interval.
int interval;
vec4 intervalRange;  // lower, upper, attenuation, slope
vec3 intervalColor;
vec3 intervalColorSlope;

//--- Ray integral ----------------------------------------------------------------------------------

void loadInterval()
{
  intervalRange = texelFetch(intervals, 3 * interval);
  intervalColor = texelFetch(intervals, 3 * interval + 1).rgb;
  intervalColorSlope = texelFetch(intervals, 3 * interval + 2).rgb;
}

void findInterval(float s)
{
  int low = 0;
  int high = numberOfIntervals - 1;
  while (low < high)
  {
    int middle = (low + high) / 2;
    bool above = texelFetch(intervals, 3 * middle).y < s;
    low = above ? middle + 1 : low;
    high = above ? high : middle;
  }
  interval = low;
  loadInterval();
}

// 1 - exp(-x) for x in [0, 1], to 2e-9: x times a Chebyshev interpolant of (1 - exp(-x)) / x.
float absorbed(float x)
{
  return x * (0.99999999793357 + x * (-0.49999979725212 + x * (0.16666340311502 +
    x * (-0.04164684931339 + x * (0.00827550484353 +
    x * (-0.00130077495785 + x * 0.00012907631016))))));
}

// 1 - psi, the mean over a piece of what has been absorbed up to a place: the integral over [0, 1] of
// 1 - exp(-(a x + (t - a) x^2)), with density a at the front and optical depth t <= 1. A polynomial of
// degree 5, exact to first order, fitted to 3e-7 for all densities that are nowhere negative.
float absorbedOnAverage(float t, float a)
{
  float p0 = t * (0.3333333333 + t * (-0.0999792881 + t * (0.0236830118 +
    t * (-0.0043518064 + t * 0.0004903571))));
  float p1 = 0.1666666667 + t * (-0.0500173281 + t * (0.0119526605 +
    t * (-0.0023320093 + t * 0.0003181505)));
  float p2 = -0.0166512718 + t * (0.0047084626 + t * (-0.0008994605 + t * 0.0000935654));
  float p3 = 0.0011768438 + t * (-0.0003058993 + t * 0.0000410537);
  float p4 = -0.0000596959 + t * 0.0000104829;
  return p0 + a * (p1 + a * (p2 + a * (p3 + a * (p4 + a * 0.0000017222))));
}

// Integrates the next piece of the pending segment: up to the end of the segment, to that of the
// transfer function's interval or to an optical depth of 1. Returns whether the segment is done.
//
// Density-emitter integral with linear attenuation and colour: Moreland and Angel, "A Fast High
// Accuracy Volume Renderer for Unstructured Data" (2004). Their cf - cb zeta + (cb - cf) psi is written
// cf (1 - psi) + cb (psi - zeta), free of cancellation.
bool integratePiece()
{
  // A segment that begins outside of the interval first moves the interval, by an empty piece.
  bool inside = segmentScalar >= intervalRange.x && segmentScalar <= intervalRange.y;
  float target = inside ? segmentEnd : segmentScalar;
  bool upward = target > intervalRange.y;
  bool downward = target < intervalRange.x;
  bool last = inside && !upward && !downward;
  float to = upward ? intervalRange.y : (downward ? intervalRange.x : segmentEnd);
  float reached =
    last ? 1.0 : clamp((to - segmentStart) / (segmentEnd - segmentStart), segmentDone, 1.0);
  reached = inside ? reached : segmentDone;
  to = inside ? to : segmentScalar;

  float pieceLength = (reached - segmentDone) * segmentLength;
  vec2 offsets = vec2(segmentScalar, to) - intervalRange.x;
  vec2 densities =
    clamp((intervalRange.z + offsets * intervalRange.w) * pieceLength, 0.0, LARGEST_DEPTH);
  float slope = densities.y - densities.x;
  float depth = 0.5 * (densities.x + densities.y);
  float part = 1.0;
  bool whole = depth <= 1.0;
  if (!whole)
  {
    // part (density + part slope / 2) = 1, the root without cancellation.
    part = min(1.0, 2.0 / (densities.x + sqrt(max(0.0, densities.x * densities.x + 2.0 * slope))));
    depth = 1.0;
  }
  float gone = absorbed(depth);
  float front = absorbedOnAverage(depth, part * densities.x);
  vec3 colorStart = intervalColor + offsets.x * intervalColorSlope;
  vec3 colorChange = part * (offsets.y - offsets.x) * intervalColorSlope;
  color += transmittance * (colorStart * gone + colorChange * max(0.0, gone - front));
  transmittance -= transmittance * gone;

  segmentDone = whole ? reached : segmentDone + part * (reached - segmentDone);
  segmentScalar = whole ? to : segmentScalar + part * (to - segmentScalar);
  if (whole && !last)
  {
    interval += upward ? 1 : -1;
    loadInterval();
  }
  return whole && last;
}

// Advances to the exit of a cell and makes its segment the pending one; false if it is empty. What
// lies before the largest depth reached, because of rounding, an inverted cell or cells that overlap,
// has been passed already and does not count again. Nor does a cell with a vertex without scalar.
bool advance(float exitDepth, float exitScalar)
{
  float from = max(depthNow, nearDepth);
  float to = min(exitDepth, endDepth);
  float perDepth = (exitScalar - faceScalar) / (exitDepth - faceDepth);
  segmentStart = from > faceDepth ? faceScalar + (from - faceDepth) * perDepth : faceScalar;
  segmentEnd = to < exitDepth ? faceScalar + (to - faceDepth) * perDepth : exitScalar;
  segmentScalar = segmentStart;
  segmentDone = 0.0;
  segmentLength = (to - from) * rayLengthPerDepth;
  faceDepth = exitDepth;
  faceScalar = exitScalar;
  depthNow = max(depthNow, exitDepth);
  return to > from && abs(segmentEnd - segmentStart) <= 4.0;
}

//--- Walk ------------------------------------------------------------------------------------------

// Crosses `cell` from `face`. Yields the link to follow; returns whether a segment is pending.
bool stepThroughCell(out int link)
{
  int number = texelFetch(cells, 8 * cell + face).r;
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
  link = texelFetch(cells, 8 * cell + 4 + rank).r;

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
  return advance(exit.x, exit.y);
}

// Walks from the boundary to the boundary, or until the ray ends. Adds to the number of steps; false
// if the ray is lost.
bool walk(inout int steps)
{
  // A ray crosses a cell once through each of its 4 faces, in 2 orientations, at the most.
  int limit = steps + 8 * numberOfCells;
  int link = 0;
  bool pending = false;
  while (true)
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
    bool ended = transmittance <= terminationTransmittance ||
      (!pending && (link < 0 || depthNow >= endDepth));
    if (ended || steps >= limit)
    {
      return ended;
    }
    if (!pending)
    {
      cell = link >> 2;
      face = link & 3;
    }
  }
  return true;
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

// Finds the next entries after (lastDepth, lastFace) among the faces listed for the fragment's tile,
// or among those of the tree if they did not fit.
void collectEntries(float lastDepth, int lastFace)
{
  ivec2 tile = ivec2(gl_FragCoord.xy / tileSize);
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
  faceScalar = f.point.y;
  depthNow = max(depthNow, faceDepth);
  entryFaces = ivec4(entryFaces.yzw, -1);
  entryDepths = vec4(entryDepths.yzw, 0.0);
}

void main()
{
  color = vec3(0.0);
  transmittance = 1.0;
  depthNow = BEFORE_EVERYTHING;
  bool meetsMesh = setUpRay(gl_FragCoord.xy - imageCenter, vec2(0.0));
  rayLengthPerDepth = viewToWorldUnit * length(viewToWorld * vec3(raySlope, 1.0));
  float opaque = 2.0 * texture(opaqueDepth, texCoord).r - 1.0;
  vec2 fraction = opaque * vec2(depthNumerator.x, depthDenominator.x) +
    vec2(depthNumerator.y, depthDenominator.y);
  endDepth = fraction.x / fraction.y;

  int steps = 0;
  int lost = 0;
  float lastDepth = BEFORE_EVERYTHING;
  int lastFace = -1;
  entryFaces = ivec4(-1);
  moreEntries = meetsMesh;
  while (transmittance > terminationTransmittance && depthNow < endDepth)
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
    findInterval(faceScalar);
    lost += walk(steps) ? 0 : 1;
  }
  gl_FragData[0] = vec4(color, 1.0 - transmittance);
  gl_FragData[1] = vec4(float(steps), float(lost), 0.0, 0.0);
}
