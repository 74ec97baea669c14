//VTK::System::Dec
#extension GL_ARB_gpu_shader5 : enable

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Casts one ray per fragment through a tetrahedral mesh, in one pass. The frame and its names are
// those of Module/Volume/RayFrame.h, the tables those of TetrahedralMesh.h and BoundaryTree.h.
//
// The walk works in the ray-aligned projection: a vertex has coordinates (u, v) about the ray, the
// same function of vertex and ray wherever it is needed, rounded to whole grid units. The sign of an
// edge as seen by the ray is exact (integers), a ray through an edge or a vertex counts as displaced
// by (e, e^2) for an arbitrarily small e, and edges whose ends coincide are ordered by vertex. So
// every cell that is entered has exactly one face to leave by, and a walk that begins on the
// boundary ends on the boundary.

in vec2 texCoord;

//VTK::Output::Dec

#ifdef GL_ARB_gpu_shader5
#define EXACTLY_AS_WRITTEN precise
#else
#define EXACTLY_AS_WRITTEN
#endif

uniform samplerBuffer vertices;      // position, normalised scalar
uniform isamplerBuffer cells;        // per cell: 4 vertices, 4 links
uniform samplerBuffer treeNodes;     // per node: (center, skip), (half, first face)
uniform isamplerBuffer treeFaces;    // 3 vertices (first one complemented: faces in), cell face
uniform samplerBuffer intervals;     // transfer function: 3 texels per interval
uniform sampler2D opaqueDepth;

uniform int numberOfNodes;
uniform int numberOfCells;
uniform int numberOfIntervals;
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
uniform mat3 viewToWorld;
uniform int enteringSign;            // outward * enteringSign > 0: counter-clockwise is entering
uniform float nearDepth;
uniform vec2 depthNumerator;
uniform vec2 depthDenominator;
uniform float terminationTransmittance;

const int FACES_PER_LEAF = 4;
// The mesh's radius in grid units: coordinates about a ray that meets the mesh stay below 2^23,
// where floats are whole numbers and products fit the exact comparison.
const float GRID_RADIUS = 4194304.0;
// Bounds, in grid units, the difference between a vertex's rounded coordinate and the same sum over
// a box that holds the vertex: 3.5 of rounding sums below 2^23, 1.25 of the half extent's, 0.5 of
// rounding to the grid.
const float BOX_MARGIN = 8.0;
// The same for depths, which are below 2 in size.
const float DEPTH_MARGIN = 1.9073486328125e-06;
// Two products and their difference, each rounded to 2^-24 of its size.
const float CERTAIN = 2.384185791015625e-07;

// A vertex about the ray: u, v (grid units), depth, scalar.
#define RayVertex vec4

// Optical depth of a piece beyond which nothing can be told apart; keeps infinities out.
const float LARGEST_DEPTH = 1.0e+30;

// The ray.
vec3 rayU;
vec3 rayV;
vec2 rayOrigin;
float rayLengthPerDepth;
float endDepth;

// Where the walk is: the face just entered by, ascending vertices.
RayVertex a;
RayVertex b;
RayVertex c;
vec3 edges;          // twice the areas that edges ab, bc, ca span with the ray
bool turnsLeft;      // abc is counter-clockwise about the ray
int cell;
int face;
float faceDepth;     // where the ray meets that face
float faceScalar;
float depthNow;      // the largest depth reached
int steps;

// What has been collected.
vec3 color;
float transmittance;
bool finished;

// The transfer function's current interval.
int interval;
vec4 intervalRange;  // lower, upper, attenuation, slope
vec3 intervalColor;
vec3 intervalColorSlope;

//--- Exact orientation -----------------------------------------------------------------------------

// Sign of p * q - r * s for whole numbers below 2^23 in size, in pieces of 12 bits.
int signOfDifference(int p, int q, int r, int s)
{
  ivec4 high = ivec4(p, q, r, s) >> 12;
  ivec4 low = ivec4(p, q, r, s) & 4095;
  int bottom = low.x * low.y - low.z * low.w;
  int middle = high.x * low.y + low.x * high.y - high.z * low.w - low.z * high.w + (bottom >> 12);
  int top = high.x * high.y - high.z * high.w + (middle >> 12);
  int rest = (middle & 4095) | (bottom & 4095);
  return top != 0 ? sign(top) : sign(rest);
}

bool turnsLeftExactly(RayVertex p, RayVertex q, bool pBeforeQ)
{
  int s = signOfDifference(int(p.x), int(q.y), int(p.y), int(q.x));
  if (s != 0)
  {
    return s > 0;
  }
  if (p.y != q.y)
  {
    return q.y < p.y;
  }
  return p.x != q.x ? q.x > p.x : pBeforeQ;
}

// Twice the area of (ray, p, q), rounded.
float edgeArea(RayVertex p, RayVertex q)
{
  return p.x * q.y - p.y * q.x;
}

// Whether (ray, p, q) is counter-clockwise.
bool edgeTurnsLeft(RayVertex p, RayVertex q, float area, bool pBeforeQ)
{
  if (abs(area) > CERTAIN * (abs(p.x * q.y) + abs(p.y * q.x)))
  {
    return area > 0.0;
  }
  return turnsLeftExactly(p, q, pBeforeQ);
}

RayVertex fetchVertex(int index)
{
  vec4 p = texelFetch(vertices, index);
  EXACTLY_AS_WRITTEN vec2 uv =
    floor(vec2(dot(rayU, p.xyz), dot(rayV, p.xyz)) - rayOrigin + vec2(0.5));
  return vec4(uv, dot(rowDepth, p.xyz), p.w);
}

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
    if (texelFetch(intervals, 3 * middle).y < s)
    {
      low = middle + 1;
    }
    else
    {
      high = middle;
    }
  }
  interval = low;
  loadInterval();
}

// 1 - exp(-x) for x in [0, 1], to 2e-9: x times a Chebyshev interpolant of (1 - exp(-x)) / x.
vec4 absorbed(vec4 x)
{
  return x * (0.99999999793357 + x * (-0.49999979725212 + x * (0.16666340311502 +
    x * (-0.04164684931339 + x * (0.00827550484353 +
    x * (-0.00130077495785 + x * 0.00012907631016))))));
}

// Density-emitter integral over a piece whose attenuation and colour are linear: Moreland and Angel,
// "A Fast High Accuracy Volume Renderer for Unstructured Data" (2004), with psi by Gauss-Legendre
// quadrature of 4 points over parts of optical depth <= 1 (error below 2e-6). Their
// cf - cb zeta + (cb - cf) psi is written cf (1 - psi) + cb (psi - zeta), free of cancellation.
void addPiece(float s0, float s1, float pieceLength)
{
  const vec4 nodes = vec4(0.06943184420297, 0.33000947820757, 0.66999052179243, 0.93056815579703);
  const vec4 weights = vec4(0.17392742256873, 0.32607257743127, 0.32607257743127, 0.17392742256873);

  vec2 densities = intervalRange.z + (vec2(s0, s1) - intervalRange.x) * intervalRange.w;
  densities = clamp(densities * pieceLength, 0.0, LARGEST_DEPTH);
  float density = densities.x;
  float slope = densities.y - density;
  if (!(density + densities.y > 0.0))
  {
    return;
  }
  vec3 colorFront = intervalColor + (s0 - intervalRange.x) * intervalColorSlope;
  vec3 colorSlope = (s1 - s0) * intervalColorSlope;
  float start = 0.0;
  while (start < 1.0 && transmittance > terminationTransmittance)
  {
    float part = 1.0 - start;
    float depth = part * (density + 0.5 * part * slope);
    if (depth > 1.0)
    {
      // The part of optical depth 1: part (density + part slope / 2) = 1, root without cancellation.
      part = min(part, 2.0 / (density + sqrt(max(0.0, density * density + 2.0 * slope))));
      depth = min(1.0, part * (density + 0.5 * part * slope));
    }
    float gone = absorbed(vec4(depth)).x;
    float front = dot(weights,
      absorbed(clamp(part * nodes * (density + 0.5 * part * nodes * slope), 0.0, 1.0)));
    color += transmittance * (colorFront * gone + colorSlope * part * max(0.0, gone - front));
    transmittance -= transmittance * gone;
    colorFront += part * colorSlope;
    density = max(0.0, density + part * slope);
    start += part;
  }
}

// The ray integral of a segment with a linear scalar, split at the transfer function's points.
void addSegment(float s0, float s1, float depth0, float depth1)
{
  if (!(abs(s1 - s0) <= 4.0))
  {
    return; // a vertex of the cell has no scalar
  }
  if (s0 < intervalRange.x || s0 > intervalRange.y)
  {
    findInterval(s0);
  }
  float segmentLength = (depth1 - depth0) * rayLengthPerDepth;
  float change = s1 - s0;
  float from = s0;
  float done = 0.0;
  while (transmittance > terminationTransmittance)
  {
    bool upward = s1 > intervalRange.y;
    bool downward = s1 < intervalRange.x;
    bool last = !upward && !downward;
    float to = last ? s1 : (upward ? intervalRange.y : intervalRange.x);
    float reached = last ? 1.0 : clamp((to - s0) / change, done, 1.0);
    addPiece(from, to, (reached - done) * segmentLength);
    if (last)
    {
      return;
    }
    done = reached;
    from = to;
    interval += upward ? 1 : -1;
    loadInterval();
  }
}

// Advances to the exit of a cell. What lies before the largest depth reached, because of rounding, an
// inverted cell or cells that overlap, has been passed already and does not count again.
void advance(float exitDepth, float exitScalar)
{
  float from = max(depthNow, nearDepth);
  float to = min(exitDepth, endDepth);
  if (to > from)
  {
    float perDepth = (exitScalar - faceScalar) / (exitDepth - faceDepth);
    float s0 = from > faceDepth ? faceScalar + (from - faceDepth) * perDepth : faceScalar;
    float s1 = to < exitDepth ? faceScalar + (to - faceDepth) * perDepth : exitScalar;
    addSegment(s0, s1, from, to);
  }
  faceDepth = exitDepth;
  faceScalar = exitScalar;
  depthNow = max(depthNow, exitDepth);
  finished = depthNow >= endDepth || transmittance <= terminationTransmittance;
}

//--- Walk ------------------------------------------------------------------------------------------

// Crosses `cell` from `face`; returns the link to follow.
int stepThroughCell()
{
  int base = 8 * cell;
  RayVertex x = fetchVertex(texelFetch(cells, base + face).r);
  vec3 areas = vec3(edgeArea(x, a), edgeArea(x, b), edgeArea(x, c));
  bool withA = edgeTurnsLeft(x, a, areas.x, face <= 0) == turnsLeft;
  bool withB = edgeTurnsLeft(x, b, areas.y, face <= 1) == turnsLeft;
  bool withC = edgeTurnsLeft(x, c, areas.z, face <= 2) == turnsLeft;
  areas = abs(areas);

  // The ray leaves between the consecutive edges xP, xQ of which it is left of one, right of the other.
  int dropped = withA && !withB ? 2 : (withB && !withC ? 0 : 1);
  RayVertex p = dropped == 0 ? b : a;
  RayVertex q = dropped == 2 ? b : c;
  float areaP = dropped == 0 ? areas.y : areas.x;
  float areaQ = dropped == 2 ? areas.y : areas.z;
  float areaPQ = dropped == 0 ? edges.y : (dropped == 1 ? edges.z : edges.x);
  int link = texelFetch(cells, base + 4 + dropped + (dropped >= face ? 1 : 0)).r;

  // A face without projected area keeps depth and scalar.
  float total = areaPQ + areaP + areaQ;
  if (total > 0.0)
  {
    vec2 exit = (areaPQ * x.zw + areaQ * p.zw + areaP * q.zw) / total;
    advance(exit.x, exit.y);
  }

  // The exit face, ascending: x in place of the dropped vertex, moved to its rank.
  int place = face - (dropped < face ? 1 : 0);
  a = place == 0 ? x : p;
  b = place == 1 ? x : (place == 0 ? p : q);
  c = place == 2 ? x : q;
  edges = place == 0 ? vec3(areaP, areaPQ, areaQ)
                     : (place == 1 ? vec3(areaP, areaQ, areaPQ) : vec3(areaPQ, areaQ, areaP));
  turnsLeft = turnsLeft != (((place - dropped) & 1) != 0);
  return link;
}

// Walks from the boundary to the boundary. False if the ray is lost.
bool walk()
{
  // A ray crosses a cell once through each of its 4 faces, in 2 orientations, at the most.
  int limit = 8 * numberOfCells;
  for (int n = 0; n < limit; ++n)
  {
    int link = stepThroughCell();
    ++steps;
    if (link < 0 || finished)
    {
      return true;
    }
    cell = link >> 2;
    face = link & 3;
  }
  return false;
}

//--- Entry -----------------------------------------------------------------------------------------

// Whether the ray enters the mesh through a face; its three vertices about the ray, area and depth.
bool entersFace(int index, out RayVertex p, out RayVertex q, out RayVertex r, out vec3 areas,
  out bool left, out int cellFace)
{
  ivec4 record = texelFetch(treeFaces, index);
  int outward = record.x < 0 ? -1 : 1;
  left = outward * enteringSign > 0;
  cellFace = record.w;
  p = fetchVertex(record.x < 0 ? ~record.x : record.x);
  q = fetchVertex(record.y);
  areas.x = edgeArea(p, q);
  if (edgeTurnsLeft(p, q, areas.x, true) != left)
  {
    return false;
  }
  r = fetchVertex(record.z);
  areas.y = edgeArea(q, r);
  areas.z = edgeArea(r, p);
  return edgeTurnsLeft(q, r, areas.y, true) == left && edgeTurnsLeft(r, p, areas.z, false) == left;
}

// Depth and scalar where the ray meets the current face; its lowest depth if it has no area.
vec2 onFace(RayVertex p, RayVertex q, RayVertex r, vec3 areas)
{
  vec3 w = abs(areas);
  float total = w.x + w.y + w.z;
  return total > 0.0 ? (w.y * p.zw + w.z * q.zw + w.x * r.zw) / total
                     : (p.z <= q.z && p.z <= r.z ? p.zw : (q.z <= r.z ? q.zw : r.zw));
}

// Moves to the next entry after (lastDepth, lastFace) in the order of depth, then face.
bool enterNext(float lastDepth, int lastFace, out float entryDepth, out int entryFace)
{
  vec3 absU = abs(rayU);
  vec3 absV = abs(rayV);
  vec3 absDepth = abs(rowDepth);
  entryDepth = endDepth;
  entryFace = -1;
  int node = 0;
  while (node < numberOfNodes)
  {
    vec4 center = texelFetch(treeNodes, 2 * node);
    vec4 extent = texelFetch(treeNodes, 2 * node + 1);
    vec2 middle = vec2(dot(rayU, center.xyz), dot(rayV, center.xyz)) - rayOrigin;
    vec2 reach = vec2(dot(absU, extent.xyz), dot(absV, extent.xyz)) + vec2(BOX_MARGIN);
    float depth = dot(rowDepth, center.xyz);
    float depthReach = dot(absDepth, extent.xyz) + DEPTH_MARGIN;
    bool hit = abs(middle.x) <= reach.x && abs(middle.y) <= reach.y &&
      depth - depthReach <= entryDepth && depth + depthReach >= lastDepth;
    int firstFace = int(extent.w);
    if (hit && firstFace >= 0)
    {
      for (int i = 0; i < FACES_PER_LEAF; ++i)
      {
        RayVertex p;
        RayVertex q;
        RayVertex r;
        vec3 areas;
        bool left;
        int cellFace;
        int index = firstFace + i;
        if (!entersFace(index, p, q, r, areas, left, cellFace))
        {
          continue;
        }
        vec2 point = onFace(p, q, r, areas);
        bool after = point.x > lastDepth || (point.x == lastDepth && index > lastFace);
        bool best = point.x < entryDepth || (point.x == entryDepth && index < entryFace);
        if (after && best)
        {
          entryDepth = point.x;
          entryFace = index;
          a = p;
          b = q;
          c = r;
          edges = abs(areas);
          turnsLeft = left;
          cell = cellFace >> 2;
          face = cellFace & 3;
          faceDepth = point.x;
          faceScalar = point.y;
        }
      }
    }
    node = hit ? node + 1 : int(center.w);
  }
  return entryFace >= 0;
}

// The ray of this fragment; false if it passes by the mesh's bounding sphere.
bool setUpRay()
{
  vec2 pixel = gl_FragCoord.xy - imageCenter;
  vec2 origin = originBase + pixel.x * originPerColumn + pixel.y * originPerRow;
  vec2 slope = slopeBase + pixel.x * slopePerColumn + pixel.y * slopePerRow;
  // u = x - slope.x * depth - origin.x and v likewise, in units of a grid as fine as floats allow.
  rayU = rowX - slope.x * rowDepth;
  rayV = rowY - slope.y * rowDepth;
  vec2 scale = vec2(GRID_RADIUS) / vec2(length(rayU), length(rayV));
  rayU *= scale.x;
  rayV *= scale.y;
  rayOrigin = origin * scale;
  rayLengthPerDepth = length(viewToWorld * vec3(slope, 1.0));

  float opaque = 2.0 * texture(opaqueDepth, texCoord).r - 1.0;
  vec2 fraction = opaque * vec2(depthNumerator.x, depthDenominator.x) +
    vec2(depthNumerator.y, depthDenominator.y);
  endDepth = fraction.x / fraction.y;
  return abs(rayOrigin.x) <= GRID_RADIUS + BOX_MARGIN && abs(rayOrigin.y) <= GRID_RADIUS + BOX_MARGIN;
}

void main()
{
  color = vec3(0.0);
  transmittance = 1.0;
  steps = 0;
  finished = !setUpRay();
  intervalRange = vec4(1.0, -1.0, 0.0, 0.0); // no scalar is in it
  depthNow = -1.0e+30;
  float entryDepth = -1.0e+30;
  int entryFace = -1;
  int lost = 0;
  while (!finished && enterNext(entryDepth, entryFace, entryDepth, entryFace))
  {
    depthNow = max(depthNow, entryDepth);
    lost += walk() ? 0 : 1;
  }
  gl_FragData[0] = vec4(color, 1.0 - transmittance);
  gl_FragData[1] = vec4(float(steps), float(lost), 0.0, 0.0);
}
