// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Limits of a ray, its refracted legs, and the loop over them.

//--- Limits --------------------------------------------------------------------------------------

// World length of a grid unit of depth.
float lengthPerGridDepth()
{
  float perDepth = length(viewToWorld * rayAlong) * DEPTH_UNIT;
  return min(viewToWorldUnit * perDepth, LARGEST_LENGTH_PER_DEPTH);
}

// Depth on the sight ray of a window depth, see RayFrame::DepthAt().
float depthOf(float opaque)
{
  vec2 shares = vec2(opaque, 1.0 - opaque);
  return opaque < 1.0 ? dot(shares, depthNumerator) / dot(shares, depthDenominator) : farDepth;
}

// Narrows the ray to the part where height + depth * perDepth, with the depth in the frame, is not
// negative.
void clip(float height, float perDepth)
{
  int met = gridDepthOf(-height / perDepth);
  startDepth = perDepth > 0.0 ? max(startDepth, met) : startDepth;
  endDepth = perDepth < 0.0 ? min(endDepth, met) : endDepth;
  endDepth = perDepth == 0.0 && height < 0.0 ? BEFORE_EVERYTHING : endDepth;
}

#if REFRACTED
//--- Refracted legs ------------------------------------------------------------------------------

// Distance by which an entry may lie in front of the sight point if the leg before reports that
// point outside of the mesh: 2^-10 of the frame's unit. The errors of vertices are less than 2^-24,
// with u and v rounded to floats; along a ray that leaves the boundary at an angle of 2^-14 this is
// 2^-10. A superfluous entry costs a few steps and does not change the result.
const int START_MARGIN = 1048576;

// Vertex of a cell opposite one of its faces.
int oppositeVertex(int index, ivec3 numbers)
{
#if COMPACT_CELLS
  int all = cellValue(CELL_SIZE * index);
#else
  int all = cellValue(CELL_SIZE * index) ^ cellValue(CELL_SIZE * index + 1) ^
    cellValue(CELL_SIZE * index + 2) ^ cellValue(CELL_SIZE * index + 3);
#endif
  return all ^ numbers.x ^ numbers.y ^ numbers.z;
}

// Finds the face by which the leg enters one of the two cells at the face that the leg before
// reached last, if that entry is not behind the sight point: a walk from there reaches
// the sight point. Returns false if the ray misses these cells.
bool findNearFace(int sightDepth)
{
  int front = cellValue(CELL_SIZE * cell + FIRST_LINK + face) >> 2;
  int number = front < 0 ? 4 : 0;
  bool found = false;
  nearFace = ivec4(0); // goes around the loop, see walk()
  while (!found && number < 8)
  {
    // Counter-clockwise about a ray that leaves the cell by the face between the two cells; so are
    // the other faces about a ray that enters by them.
    bool inFront = number < 4;
    int index = inFront ? front : cell;
    ivec3 n = inFront ? corners : corners.xzy;
    int last = oppositeVertex(index, corners);
    int k = number % 4;
    int opposite = k == 0 ? last : (k == 1 ? n.x : (k == 2 ? n.y : n.z));
    nearFace.xyz = k == 0 ? n.xzy
      : ivec3(last, k == 1 ? n.yz : (k == 2 ? n.zx : n.xy));
    nearFace.w = 4 * index + int(n.x < opposite) + int(n.y < opposite) + int(n.z < opposite) +
      int(last < opposite);
    ProjectedFace f = seeFace(NEAR_FACE);
    found = f.entered && f.depth <= sightDepth;
    number += found ? 0 : 1;
  }
  return found;
}

// A leg's texels of refractedRays.
struct RefractedRayLine
{
  ivec4 line;       // offset and slope in the grid
  float start;      // depth of the sight point in the line's frame
  float perDepth;   // depth there per drawn depth; 0 if the ray has no such leg
  int frame;
  int startAt;      // the start in grid units
};

// Depth of a float in grid units, with its correction in grid units.
int refinedDepth(float depth, int rest)
{
  return gridDepthOf(depth) + (rest & 255) - 128;
}

RefractedRayLine fetchRefractedRayLine(ivec2 pixel, int leg)
{
  RefractedRayLine line;
  line.line = fetchLegTexel(pixel, leg, 0);
  ivec4 place = fetchLegTexel(pixel, leg, 1);
  line.start = intBitsToFloat(place.y);
  line.perDepth = intBitsToFloat(place.z);
  line.frame = place.w & 255;
  line.startAt = refinedDepth(line.start, place.w >> 16);
  return line;
}

// Finds the end of the leg: the beginning of the next one.
void findLegEnd(ivec2 pixel)
{
  legEnd = NOWHERE;
  legEndAt = AFTER_EVERYTHING;
  if (rayLeg + 1 < NUMBER_OF_LEGS)
  {
    ivec4 place = fetchLegTexel(pixel, rayLeg + 1, 1);
    legEnd = intBitsToFloat(place.x);
    legEndAt = refinedDepth(legEnd, place.w >> 8);
  }
}

// True if the ray goes on to an interface, and the leg behind it is drawn.
bool meetsDrawnLeg()
{
  return legEnd < NOWHERE && rayLeg + 1 < endLeg;
}

// Limits of a refracted leg. Geometry in the depth buffer behind the first interface is drawn at
// the depths of sight rays (Eq. 2.4); where nothing is drawn, the far plane is no limit.
void limitRefractedLeg(float opaque, RefractedRayLine line)
{
  startDepth = line.startAt;
  if (nearDepth > legDepth)
  {
    startDepth = gridDepthOf(line.start + (nearDepth - legDepth) * line.perDepth);
  }
  endDepth = opaque < 1.0
    ? gridDepthOf(line.start + (depthOf(opaque) - legDepth) * line.perDepth)
    : AFTER_EVERYTHING;
  endDepth = min(endDepth, legEndAt);
#if NUMBER_OF_CLIPPING_PLANES > 0
  for (int i = 0; i < NUMBER_OF_CLIPPING_PLANES; ++i)
  {
    clip(dot(clippingInFrame[i], vec4(rayPlace, 1.0)), dot(clippingInFrame[i].xyz, rayAlong));
  }
#endif
  endDepth = startDepth < endDepth ? endDepth : BEFORE_EVERYTHING;
}
#endif

//--- Ray -----------------------------------------------------------------------------------------

// The visible part of leg 0: from the near plane to opaque geometry, within the clipping planes.
void limitRay(float opaque)
{
  startDepth = gridDepthOf(nearDepth);
  endDepth = gridDepthOf(depthOf(opaque));
#if REFRACTED
  endDepth = min(endDepth, legEndAt);
#endif
#if NUMBER_OF_CLIPPING_PLANES > 0
  vec3 place = vec3(1.0, rayPixel);
  for (int i = 0; i < NUMBER_OF_CLIPPING_PLANES; ++i)
  {
    clip(dot(clippingConstant[i], place), dot(clippingPerDepth[i], place));
  }
  endDepth = startDepth < endDepth ? endDepth : BEFORE_EVERYTHING;
#endif
}

// Casts the leg that is set up: from nearFace on, if that is its first entry, then from
// the entries after `lastDepth`, if there are more. Adds the cells crossed and the walks that did
// not end on the boundary.
void castLeg(int lastDepth, inout int steps, inout int lost)
{
  int lastFace = -1;
#if REFRACTED
  cycleSteps = steps;
#endif
  // The condition comes last, as in walk().
  bool goesOn = !isRayDone() && depthNow < endDepth;
  do
  {
    if (goesOn)
    {
      findEntries(lastDepth, lastFace);
    }
    goesOn = goesOn && entryFaces.x != -1;
    if (goesOn)
    {
      lastFace = entryFaces.x;
      int entryDepth = entryDepths.x;
      enterFirst();
      startPart(faceScalar);
      bool ended = walk(steps);
#if REFRACTED
      // A walk that returns to its start inside the mesh has integrated nothing twice; the rest
      // follows from the boundary.
      bool wasNear = lastFace == NEAR_FACE;
      entryDepth = wasNear ? (ended ? lastDepth : BEFORE_EVERYTHING) : entryDepth;
      lastFace = wasNear ? -1 : lastFace;
      ended = ended || wasNear || (cycleStart >= 0 && 4 * cell + face == cycleStart);
#endif
      lastDepth = entryDepth;
      lost += ended ? 0 : 1;
    }
    goesOn = goesOn && !isRayDone() && depthNow < endDepth && (entryFaces.x != -1 || moreEntries);
  } while (goesOn);
}

#if REFRACTED
// Sets up the next leg, after the one before has reached its end. Returns in `lastDepth` the depth
// from which entries are used. Returns false if no part of the leg is drawn.
bool setUpNextLeg(float opaque, out int lastDepth)
{
  // True if the leg before was drawn up to the interface, and no clipping plane has ended it. Where
  // that leg began inside the mesh, no further entries have been searched for; the next one then
  // begins on the boundary.
  bool arrived =
    rayLeg >= firstLeg && endDepth == legEndAt && entryFaces.x < 0 && !moreEntries;
  bool inside = depthNow >= endDepth;
#if FADED
  legPath +=
    rayLeg > 0 ? (legEnd - legStart) * (rayLengthPerDepth * GRID_PER_DEPTH) : 0.0;
#endif
  ++rayLeg;
  ivec2 pixel = ivec2(rayTilePixel);
  RefractedRayLine line = fetchRefractedRayLine(pixel, rayLeg);
  legDepth += (legEnd - legStart) / legPerDepth;
  legStart = line.start;
  legPerDepth = line.perDepth;
  findLegEnd(pixel);
  bool casts = line.perDepth > 0.0 && setUpRefractedRay(line.frame, line.line, vec2(0.0)) &&
    rayLeg >= firstLeg;
  rayLengthPerDepth = lengthPerGridDepth();
  limitRefractedLeg(opaque, line);
  casts = casts && startDepth < endDepth;
  depthNow = BEFORE_EVERYTHING;
  bool within =
    casts && arrived && inside && beginsInside && cell >= 0 && findNearFace(line.startAt);
  entryFaces = ivec4(within ? NEAR_FACE : -1, -1, -1, -1);
  cycleStart = within ? nearFace.w : -1;
  moreEntries = casts;
  lastDepth =
    within || (arrived && !inside) ? line.startAt - START_MARGIN : BEFORE_EVERYTHING;
  return casts;
}
#endif

// Casts the ray of a pixel, given by its centre, up to an opaque window depth in [0, 1]. Returns
// the cells crossed and the walks that did not end on the boundary.
vec4 castRay(vec2 pixel, float opaque, out int steps, out int lost)
{
  rayTilePixel = pixel;
  rayPixel = pixel - imageCenter;
  depthNow = BEFORE_EVERYTHING;
  steps = 0;
  lost = 0;
  bool meetsMesh = setUpRay(rayPixel, vec2(0.0));
  rayLengthPerDepth = lengthPerGridDepth();
  startRay();
  int lastDepth = BEFORE_EVERYTHING;
  startEntries(meetsMesh);
#if REFRACTED
  rayLeg = 0;
  legDepth = 0.0;
  legStart = 0.0;
  legPerDepth = 1.0;
#if FADED
  legPath = 0.0;
#endif
  cycleStart = -1;
  findLegEnd(ivec2(pixel));
  limitRay(opaque);
  // Leg 0 comes first, if a ray of the tile enters the mesh there, then the others: all in one
  // loop, in which adjacent rays take the turns that they need.
  moreEntries =
    meetsMesh && firstLeg == 0 && fetchTile(ivec2(pixel / tileSize), 0).x != -1.0;
  bool casts = moreEntries;
  bool goesOn = casts || meetsDrawnLeg();
  while (goesOn)
  {
    casts = casts || setUpNextLeg(opaque, lastDepth);
    if (casts)
    {
      castLeg(lastDepth, steps, lost);
    }
    goesOn = meetsDrawnLeg() && !isRayDone();
    casts = false;
  }
#else
  limitRay(opaque);
  castLeg(lastDepth, steps, lost);
#endif
  return finishRay();
}
