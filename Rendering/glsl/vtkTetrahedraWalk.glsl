// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Walk/PacketWalk.h (step through a cell)
//
// Walk of a ray through a tetrahedral mesh. The loops are flat, with one step or one piece of the
// optical model per turn, so that adjacent rays do not wait for each other's inner loops.

#if COMPACT_CELLS
// Per cell: the exclusive or of its vertices, from which the fourth follows given three; 4 links.
#define CELL_SIZE 5
#define FIRST_LINK 1
#else
// Per cell: 4 vertices, 4 links, a texel each.
#define CELL_SIZE 8
#define FIRST_LINK 4
#endif
uniform isamplerBuffer cells;

// Number `index` of the table of cells.
int cellValue(int index)
{
#if WIDE_CELLS
  return texelFetch(cells, index >> 2)[index & 3];
#else
  return texelFetch(cells, index).r;
#endif
}

#if REFRACTED
uniform bool beginsInside;           // true if a refracted leg may begin inside the mesh
uniform int firstLeg;                // legs [firstLeg, endLeg) are drawn
uniform int endLeg;
#endif
uniform int numberOfCells;
uniform float tileSize;
uniform mat3 viewToWorld;            // in units of viewToWorldUnit
uniform float viewToWorldUnit;
uniform float nearDepth;
uniform float farDepth;
uniform vec2 depthNumerator;
uniform vec2 depthDenominator;
#if NUMBER_OF_CLIPPING_PLANES > 0
// Per plane, >= 0 on its kept side: dot(constant, (1, i, j)) + depth * dot(perDepth, (1, i, j)),
// with the pixel (i, j) counted from the image's centre.
uniform vec3 clippingConstant[NUMBER_OF_CLIPPING_PLANES];
uniform vec3 clippingPerDepth[NUMBER_OF_CLIPPING_PLANES];
#if REFRACTED
// Distance of a point of the frame of the view: dot(clippingInFrame, (x, y, depth, 1)).
uniform vec4 clippingInFrame[NUMBER_OF_CLIPPING_PLANES];
#endif
#endif
uniform samplerBuffer intervals;     // functions of the optical model by intervals, 3 texels each
#if VERTEX_GRADIENTS
uniform samplerBuffer vertexGradients;
#endif
#if VERTEX_LIGHT
uniform samplerBuffer vertexLight;
#endif
#if VERTEX_COMPONENTS
uniform samplerBuffer vertexComponents;
#endif
#if CELL_SCALARS
uniform samplerBuffer cellScalars;   // one per cell; those of the vertices are not used
#endif

vec2 rayPixel;       // from the image's centre
vec2 rayTilePixel;   // from its lower left corner
float rayLengthPerDepth; // per grid unit of depth
int startDepth;
int endDepth;
#if REFRACTED
int rayLeg;          // number of the leg that is cast
float legDepth;      // drawn depth at which it begins
float legStart;      // depth of that point in the frame of the leg
float legPerDepth;   // depth in that frame per drawn depth
float legEnd;        // depth there at which the leg meets the next interface, or NOWHERE
int legEndAt;        // the same in grid units
int cycleStart;      // link to the face inside the mesh by which the leg's first walk began, or -1
int cycleSteps;      // number of steps before that walk
#if FADED
float legPath;       // world length of the legs behind the first interface up to this one
#endif
ivec4 nearFace;      // that face: vertices, counter-clockwise, and link
const int NEAR_FACE = -2;
#endif

// State of the walk: the face just entered by, with its vertices counter-clockwise about the ray.
RayVertex a;
RayVertex b;
RayVertex c;
ivec3 corners;       // indices of these vertices
int apex;            // vertex of the cell opposite the face entered by
// Surfaces in a cell need its fourth vertex, which the face that the ray leaves it by lacks.
#define KEEPS_DROPPED (SHADING && (CELL_SCALARS || (VERTEX_LIGHT && !MEDIUM_LIGHT)))
#if KEEPS_DROPPED
int dropped;
RayVertex droppedVertex;
#endif
vec3 edges;          // twice the areas that edges ab, bc, ca span with the ray
int cell;
int face;
int faceDepth;       // depth at which the ray meets that face: an integer
float faceRest;      // and the remainder, at most 1/2
float faceScalar;    // for scalars of cells: that of the last integrated cell
int depthNow;        // the largest depth reached

// The segment whose ray integral is pending.
float segmentLength;
float segmentStart;  // scalars
float segmentEnd;
float segmentDone;   // fraction integrated
float segmentScalar; // scalar at that fraction
#if VERTEX_VALUES
// Values interpolated besides depth and scalar.
#if VERTEX_VALUES == 1
#define VertexValues vec3
#define GRADIENT_OF(values) values
#define LIGHT_OF(values) values
#define COMPONENTS_OF(values) values
#else
#if VERTEX_VALUES == 2
#define VertexValues mat2x3
#else
#define VertexValues mat3x3
#endif
#define GRADIENT_OF(values) values[0]
#define LIGHT_OF(values) values[VERTEX_GRADIENTS]
#define COMPONENTS_OF(values) values[VERTEX_GRADIENTS + MEDIUM_LIGHT]
#endif
VertexValues valuesA; // at the face's vertices
VertexValues valuesB;
VertexValues valuesC;
VertexValues faceValues; // at the intersection of the ray and the face
VertexValues segmentValuesStart;
VertexValues segmentValuesEnd;
bool segmentIsNew;

VertexValues fetchValues(int vertex)
{
  VertexValues values;
#if VERTEX_GRADIENTS
  GRADIENT_OF(values) = texelFetch(vertexGradients, vertex).xyz;
#endif
#if MEDIUM_LIGHT
  LIGHT_OF(values) = texelFetch(vertexLight, vertex).xyz;
#endif
#if VERTEX_COMPONENTS
  COMPONENTS_OF(values) = texelFetch(vertexComponents, vertex).xyz;
#endif
  return values;
}
#endif
#if NEEDS_POSITION
float segmentStartDepth;
float segmentEndDepth;
#endif

//--- Interface of the optical model --------------------------------------------------------------

// Starts the ray.
void startRay();
// Called when the ray enters a connected part of the mesh, or comes back to it, with this scalar.
void startPart(float scalar);
// Integrates the next piece of the pending segment; returns true if the segment is done.
bool integratePiece();
// True if the rest of the ray cannot be seen.
bool isRayDone();
// Premultiplied colour of the ray.
vec4 finishRay();

//--- Walk ----------------------------------------------------------------------------------------

// Advances to the exit of a cell, `crossing` behind the face entered by, and makes its segment the
// pending one; returns false if it is empty. The part before the largest depth reached (after
// rounding, in an inverted cell, or where cells overlap) has been integrated already and is
// skipped. So is a cell with a vertex without a scalar.
#if VERTEX_VALUES
bool advance(int exitDepth, float crossing, float perCrossing, float exitScalar,
  VertexValues exitValues)
#else
bool advance(int exitDepth, float crossing, float perCrossing, float exitScalar)
#endif
{
  int from = max(depthNow, startDepth);
  int to = min(exitDepth, endDepth);
  bool late = from > faceDepth;
  bool early = exitDepth > endDepth;
  float length = late || early ? float(to - from) : crossing;
#if CELL_SCALARS
  // One scalar for the whole cell.
  segmentEnd = texelFetch(cellScalars, cell).r;
  segmentStart = segmentEnd;
#else
  float perDepth = (exitScalar - faceScalar) * perCrossing;
  segmentStart = late ? faceScalar + float(from - faceDepth) * perDepth : faceScalar;
  segmentEnd = early ? faceScalar + float(to - faceDepth) * perDepth : exitScalar;
#endif
  segmentScalar = segmentStart;
  segmentDone = 0.0;
  segmentLength = length * rayLengthPerDepth;
#if NEEDS_POSITION
  segmentStartDepth = frameDepthOf(from);
  segmentEndDepth = frameDepthOf(to);
#endif
#if VERTEX_VALUES
  VertexValues valuesPerDepth = (exitValues - faceValues) * perCrossing;
  segmentValuesStart =
    late ? faceValues + float(from - faceDepth) * valuesPerDepth : faceValues;
  segmentValuesEnd = early ? faceValues + float(to - faceDepth) * valuesPerDepth : exitValues;
  segmentIsNew = true;
  faceValues = exitValues;
#endif
  faceDepth = exitDepth;
  depthNow = max(depthNow, exitDepth);
#if CELL_SCALARS && SEES_JUMPS
  // Cells that the ray passes in a point count: a displaced ray meets their faces. The depth of a
  // face is off by up to 4 * 2^-24 of the distance from the last one, below 2^31.
  bool counts = length > -1024.0 && abs(segmentEnd) <= LARGEST_CHANGE;
#else
  bool counts = length > 0.0 && abs(segmentEnd - segmentStart) <= LARGEST_CHANGE;
#endif
#if CELL_SCALARS
  faceScalar = counts || exitDepth <= startDepth ? segmentEnd : faceScalar;
#if !SEES_JUMPS
  // A jump may cross any number of the transfer function's intervals.
  if (counts)
  {
    startPart(segmentEnd);
  }
#endif
#else
  faceScalar = exitScalar;
#if SEES_JUMPS
  // Scalars before and behind a cell without one are not connected.
  if (length > 0.0 && !counts)
  {
    startPart(exitScalar);
  }
#endif
#endif
  return counts;
}

// Moves a point of the ray, given by an integer depth and the remainder, to that in which it meets
// the face abc, and interpolates the scalar. Returns the difference of the depths, and 1 / total
// area in `inverse`. Depths of corners are relative to the integer, which is exact: differences
// fit, since depths are below 2^30 in magnitude. The rounding error is therefore that of the mean
// distance of the corners from the point, weighted by the areas that edges span with the ray: small
// cells are as precise as large ones. A face without projected area keeps the given values and
// returns 0.
float moveToFace(inout int depth, inout float rest, inout float scalar, out float inverse,
  out float perCrossing)
{
  float total = edges.x + edges.y + edges.z;
  bool real = total > 0.0;
  inverse = 1.0 / total;
  vec3 ahead = vec3(ivec3(a.z, b.z, c.z) - ivec3(depth));
  float weighted = dot(edges.yzx, ahead);
  float moved = weighted * inverse;
  perCrossing = total / (weighted - rest * total);
  float whole = roundEven(moved);
#if SEES_JUMPS
  // Relative to the corner with the largest weight: where the corners with weight have one scalar,
  // as along an edge in an isosurface, the result is exactly that scalar.
  vec3 weights = edges.yzx * inverse;
  vec3 scalars = vec3(vertexScalar(a), vertexScalar(b), vertexScalar(c));
  float first = weights.x >= max(weights.y, weights.z)
    ? scalars.x
    : (weights.y >= weights.z ? scalars.y : scalars.z);
  float met = first + dot(weights, scalars - vec3(first));
#else
  float first = vertexScalar(a);
  float met = first +
    (edges.z * (vertexScalar(b) - first) + edges.x * (vertexScalar(c) - first)) * inverse;
#endif
  scalar = real ? met : scalar;
  float crossing = real ? moved - rest : 0.0;
  rest = real ? moved - whole : rest;
  depth += real ? int(whole) : 0;
  inverse = real ? inverse : 0.0;
  return crossing;
}

#if VERTEX_VALUES
// Values at the intersection of the ray with the face abc.
VertexValues meetValues(float inverse)
{
  return (edges.y * valuesA + edges.z * valuesB + edges.x * valuesC) * inverse;
}
#endif

// A cell to be entered: the vertex opposite the face and the links to its neighbours.
struct Ahead
{
  int number;
  RayVertex x;
#if !COMPACT_CELLS
  ivec4 links;
#endif
};

Ahead fetchAhead(int cellFace)
{
  Ahead ahead;
  int index = cellFace >> 2;
#if COMPACT_CELLS
  ahead.number = cellValue(CELL_SIZE * index) ^ corners.x ^ corners.y ^ corners.z;
#else
  ahead.number = texelFetch(cells, 2 * index)[cellFace & 3];
  ahead.links = texelFetch(cells, 2 * index + 1);
#endif
  ahead.x = fetchVertex(ahead.number);
  return ahead;
}

// Crosses `cell` from `face`. Computes the link to follow; returns true if a segment is pending.
bool stepThroughCell(Ahead ahead, out int link)
{
  int number = ahead.number;
  apex = number;
  RayVertex x = ahead.x;
  vec3 areas = vec3(edgeArea(x, a), edgeArea(x, b), edgeArea(x, c));
  bool leftOfA = edgeTurnsLeft(x, a, areas.x, number < corners.x);
  bool leftOfB = edgeTurnsLeft(x, b, areas.y, number < corners.y);
  bool leftOfC = edgeTurnsLeft(x, c, areas.z, number < corners.z);
  areas = abs(areas);

  // The ray leaves between two consecutive edges from x: left of one and right of the next. The
  // third vertex is dropped; its rank among the cell's vertices is the index of the link to follow.
  bool dropC = leftOfA && !leftOfB;
  bool dropA = !dropC && leftOfB && !leftOfC;
  bool dropB = !dropC && !dropA;
  int lacking = dropA ? corners.x : (dropB ? corners.y : corners.z);
  int rank = int(number < lacking) + int(corners.x < lacking) + int(corners.y < lacking) +
    int(corners.z < lacking);
#if KEEPS_DROPPED
  dropped = lacking;
  droppedVertex = dropA ? a : (dropB ? b : c);
#endif
#if COMPACT_CELLS
  link = cellValue(CELL_SIZE * cell + FIRST_LINK + rank);
#else
  link = ahead.links[rank];
#endif

  // Exit face: x replaces the dropped vertex, which keeps the sense of rotation.
  edges = vec3(dropC ? edges.x : (dropA ? areas.y : areas.x),
    dropA ? edges.y : (dropB ? areas.z : areas.y), dropB ? edges.z : (dropA ? areas.z : areas.x));
  a = dropA ? x : a;
  b = dropB ? x : b;
  c = dropC ? x : c;
  corners = ivec3(
    dropA ? number : corners.x, dropB ? number : corners.y, dropC ? number : corners.z);

  int exitDepth = faceDepth;
  float exitScalar = faceScalar;
  float inverse;
  float perCrossing;
  float crossing = moveToFace(exitDepth, faceRest, exitScalar, inverse, perCrossing);
#if VERTEX_VALUES
  VertexValues valuesX = fetchValues(number);
  valuesA = dropA ? valuesX : valuesA;
  valuesB = dropB ? valuesX : valuesB;
  valuesC = dropC ? valuesX : valuesC;
  return advance(
    exitDepth, crossing, perCrossing, exitScalar, inverse > 0.0 ? meetValues(inverse) : faceValues);
#else
  return advance(exitDepth, crossing, perCrossing, exitScalar);
#endif
}

// Walks from the boundary to the boundary, or until the ray ends. Adds to the number of steps;
// returns false if the ray is lost. A walk that begins inside the mesh reaches the boundary, too,
// or returns to its start: every face and side has one predecessor. A later walk that comes to that
// start ends there, since its other cells have been crossed: they are not crossed again, because
// depths that are rounded otherwise could make a piece of them count twice.
bool walk(inout int steps)
{
  // A ray crosses a cell at most once through each of its 4 faces, in 2 orientations.
  int limit = steps + 8 * numberOfCells;
  int link = 4 * cell + face;
  bool pending = false;
  bool ended = false;
#if REFRACTED
  bool closedCycle = false;
#else
  const bool closedCycle = false;
#endif
  // The cell ahead is fetched before the segment behind is integrated, which hides the latency.
  // With long lists most walks are one cell long: the segment is integrated in the same turn.
  //
  // Values that are read after the loop are carried around it: Mesa's llvmpipe (22.3) lets finished
  // rays continue to compute values that are only used behind a loop, and those come out wrong
  // (test of lost rays). With llvmpipe a loop also takes one superfluous turn if its condition
  // comes first; in meshes whose cells share no points that is every second turn.
  do
  {
    Ahead ahead = fetchAhead(max(link, 0));
#if !LONG_LISTS
    pending = pending && !integratePiece();
    ended = ended || isRayDone() || (!pending && (link < 0 || depthNow >= endDepth));
#endif
    bool goesOn = !pending && !ended;
#if REFRACTED
    closedCycle = goesOn && steps > cycleSteps && link == cycleStart;
    goesOn = goesOn && !closedCycle;
#endif
    if (goesOn)
    {
      cell = link >> 2;
      face = link & 3;
      pending = stepThroughCell(ahead, link);
      ++steps;
    }
#if LONG_LISTS
    pending = pending && !integratePiece();
    ended = ended || isRayDone() || (!pending && (link < 0 || depthNow >= endDepth));
#endif
  } while (!ended && !closedCycle && steps < limit);
  cell = link >> 2;
  face = link & 3;
  return ended;
}

//--- Entry ---------------------------------------------------------------------------------------

// A boundary face in the projection along a ray.
struct ProjectedFace
{
  RayVertex p;
  RayVertex q;
  RayVertex r;
  ivec3 numbers;
  vec3 areas;
  int depth;    // depth of the intersection with the ray
  bool left;    // pqr is counter-clockwise if entered
  bool entered;
  int cellFace;
};

// @param left true if the vertices are counter-clockwise when the face is entered.
ProjectedFace seeTriangle(ivec3 numbers, bool left)
{
  ProjectedFace f;
  f.left = left;
  f.numbers = numbers;
  f.p = fetchVertex(numbers.x);
  f.q = fetchVertex(numbers.y);
  f.r = fetchVertex(numbers.z);
  f.areas = vec3(edgeArea(f.p, f.q), edgeArea(f.q, f.r), edgeArea(f.r, f.p));
  f.entered = edgeTurnsLeft(f.p, f.q, f.areas.x, numbers.x < numbers.y) == left &&
    edgeTurnsLeft(f.q, f.r, f.areas.y, numbers.y < numbers.z) == left &&
    edgeTurnsLeft(f.r, f.p, f.areas.z, numbers.z < numbers.x) == left;
  f.areas = abs(f.areas);
  // A face without projected area is met at its first vertex.
  float total = f.areas.x + f.areas.y + f.areas.z;
  float ahead = dot(f.areas.zx, vec2(f.q.z - f.p.z, f.r.z - f.p.z)) / total;
  f.depth = f.p.z + (total > 0.0 ? int(roundEven(ahead)) : 0);
  return f;
}

// A face of the boundary; with REFRACTED, also the face inside the mesh that nearFace holds: number
// -2.
ProjectedFace seeFace(int index)
{
#if REFRACTED
  bool isNear = index == NEAR_FACE;
  ivec4 record = texelFetch(treeFaces, isNear ? 0 : index);
  record = isNear ? nearFace : record;
  bool left = isNear || (record.x < 0 ? -1 : 1) * enteringSign > 0;
#else
  ivec4 record = texelFetch(treeFaces, index);
  bool left = (record.x < 0 ? -1 : 1) * enteringSign > 0;
#endif
  ProjectedFace f = seeTriangle(ivec3(record.x < 0 ? ~record.x : record.x, record.yz), left);
  f.cellFace = record.w;
  return f;
}

//VTK::TetrahedraEntries::Dec

// Starts the walk at a face.
void enter(ProjectedFace f)
{
  a = f.left ? f.p : f.q;
  b = f.left ? f.q : f.p;
  c = f.r;
  corners = f.left ? f.numbers : f.numbers.yxz;
  edges = f.left ? f.areas : f.areas.xzy;
  cell = f.cellFace >> 2;
  face = f.cellFace & 3;
  faceDepth = f.depth;
  faceRest = 0.0;
  faceScalar = vertexScalar(f.p);
  float inverse;
  float perCrossing;
  moveToFace(faceDepth, faceRest, faceScalar, inverse, perCrossing);
#if CELL_SCALARS
  faceScalar = texelFetch(cellScalars, cell).r;
#endif
  depthNow = max(depthNow, faceDepth);
#if VERTEX_VALUES
  valuesA = fetchValues(corners.x);
  valuesB = fetchValues(corners.y);
  valuesC = fetchValues(corners.z);
  faceValues = inverse > 0.0 ? meetValues(inverse) : valuesA;
#endif
}

// Starts the walk at the first of the entries found, and removes that from them.
void enterFirst()
{
  enter(seeFace(entryFaces.x));
  entryFaces = ivec4(entryFaces.yzw, -1);
  entryDepths = ivec4(entryDepths.yzw, 0);
#if LONG_LISTS
  entryPlaces = ivec4(entryPlaces.yzw, 0);
#endif
}
