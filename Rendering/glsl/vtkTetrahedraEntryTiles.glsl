// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Entries/EntryTiles.cxx (faces that a tile is entered by)
//
// Lists, for each tile of the image, the boundary faces by which a ray of the tile may enter the
// mesh: up to 32 faces in 8 texels, padded with -1. If a tile has more faces, its list begins with
// -2. The computation uses the tile's central ray, in its grid units, and bounds the difference to
// the others.
//
// With REFRACTED, sight rays end at the first interface. With BEHIND the rays are those of a
// refracted leg; if those of a tile are in several frames, its list also begins with -2.

uniform float tileSize;
#if BEHIND
uniform int listedLeg;               // number of the leg
#endif

// Bound, relative to the products of which areas consist, of the effect of rounding u and v to
// floats (2^-24) for the central ray and for another, and of the sums here: 4 * 2^-24 and a few
// times 2^-24.
const float AREA_ROUNDING = 9.5367431640625e-07;
// Largest deviation of (u, v) from affine functions of the pixel, in grid units: 1/2 for the
// rounding of a ray's offset (behind a membrane), 1/4 for its slope, 1/4 for the product of slope
// and depth, and 2 for halves that are rounded down in fetchNearVertex.
const float GRID_ROUNDING = 3.0;

// Largest distance of the rays of a tile, half of the mesh's radius. If they are farther apart, the
// tree is searched instead.
const float LARGEST_REACH = 536870912.0;
// Largest refinement of a sight point's depth.
const int DEPTH_SLACK = 128;

// Largest difference of (u, v) of a vertex at depth 0 among the rays, and its increase per unit of
// depth.
vec2 reach;
vec2 reachPerDepth;

vec2 listedTile; // column and row of the tile

// Largest difference of the area of (ray, p, q) among the rays: with p and q displaced by d and d +
// t (q.z - p.z), it changes by d x (q - p) + t (q.z - p.z) x p and the product of the two.
float areaReach(vec3 p, vec3 q)
{
  vec2 d = reach + reachPerDepth * abs(p.z);
  vec2 t = reachPerDepth * abs(q.z - p.z);
  vec2 edge = abs(q.xy - p.xy);
  vec2 from = abs(p.xy) + d;
  return d.x * edge.y + d.y * edge.x + t.x * from.y + t.y * from.x;
}

// Bound of the rounding error of that area for any of the rays.
float areaRounding(vec3 p, vec3 q)
{
  vec2 from = abs(p.xy) + reach + reachPerDepth * abs(p.z) + vec2(GRID_ROUNDING);
  vec2 to = abs(q.xy) + reach + reachPerDepth * abs(q.z) + vec2(GRID_ROUNDING);
  return AREA_ROUNDING * (from.x * to.y + from.y * to.x) +
    GRID_ROUNDING * (from.x + from.y + to.x + to.y);
}

// Largest difference of the area of (p, q, r) among the rays: it is caused by the slopes only.
float faceAreaReach(vec3 p, vec3 q, vec3 r)
{
  vec3 e = abs(q - p);
  vec3 f = abs(r - p);
  vec2 te = reachPerDepth * e.z;
  vec2 tf = reachPerDepth * f.z;
  return te.x * (f.y + tf.y) + te.y * (f.x + tf.x) + tf.x * e.y + tf.y * e.x;
}

// A vertex relative to the central ray: u and v in grid units, depth in the frame.
vec3 seen(RayVertex p)
{
  return vec3(placeOf(p), frameDepthOf(p.z));
}

// As fetchVertex, about the tile's central ray, which may miss the mesh by twice LARGEST_REACH:
// differences are computed from halves of integers, which fit.
RayVertex fetchNearVertex(int index)
{
  ivec4 p = texelFetch(vertices, FIRST_VERTEX + index);
  vec2 rest;
  ivec2 leading = multiplySlope(p.z, rest);
  vec2 uv = 2.0 * vec2((p.xy >> 1) - (rayOffset >> 1) - (leading >> 1)) - rest;
  return ivec4(floatBitsToInt(uv), p.zw);
}

// True if a ray of the tile may enter the mesh by the face.
bool mayEnter(int index)
{
  ivec4 record = texelFetch(treeFaces, index);
  RayVertex p = fetchNearVertex(record.x < 0 ? ~record.x : record.x);
  RayVertex q = fetchNearVertex(record.y);
  RayVertex r = fetchNearVertex(record.z);
  float entering = float((record.x < 0 ? -1 : 1) * enteringSign);
  vec3 areas = entering * vec3(edgeArea(p, q), edgeArea(q, r), edgeArea(r, p));
  vec3 a = seen(p);
  vec3 b = seen(q);
  vec3 c = seen(r);
  areas += vec3(areaRounding(a, b), areaRounding(b, c), areaRounding(c, a));
  vec3 reaches = vec3(areaReach(a, b), areaReach(b, c), areaReach(c, a));
  return all(greaterThanEqual(areas + reaches, vec3(0.0))) &&
    areas.x + areas.y + areas.z + faceAreaReach(a, b, c) >= 0.0;
}

#if REFRACTED
// A texel of a leg of the tile's pixel number i; the nearest pixel of the image if that is outside.
ivec4 fetchLine(int i, int leg, int texel)
{
  int columns = int(tileSize);
  ivec2 corner = ivec2(listedTile * tileSize);
  ivec2 pixel = min(corner + ivec2(i % columns, i / columns), legImageSize() - 1);
  return fetchLegTexel(pixel, leg, texel);
}
#endif

// Sets up the central ray. Returns in `end` the depth at which all rays have ended, and in `alike`
// whether one list can serve all rays. Returns false if there is no ray.
#if BEHIND
bool setUpTile(out int end, out bool alike)
{
  // Offset and slope.
  ivec4 least = ivec4(2147483647);
  ivec4 most = ivec4(-2147483647);
  int frame = -1;
  end = AFTER_EVERYTHING;
  alike = true;
  for (int i = 0; i < int(tileSize * tileSize); ++i)
  {
    ivec4 place = fetchLine(i, listedLeg, 1);
    if (intBitsToFloat(place.z) > 0.0)
    {
      ivec4 line = fetchLine(i, listedLeg, 0);
      least = min(least, line);
      most = max(most, line);
      alike = alike && (frame < 0 || frame == (place.w & 255));
      frame = place.w & 255;
    }
  }
  if (frame < 0)
  {
    return false;
  }
  // Within 2 units, since halves are rounded.
  setUpRefractedRay(frame, (least >> 1) + (most >> 1), vec2(0.0));
  // The lines pass the pixel centres, so no margin for rounding to the grid is needed between them.
  vec4 spread = 0.5 * (vec4(most) - vec4(least));
  reach = spread.xy + vec2(BOX_MARGIN);
  reachPerDepth = spread.zw * (GRID_PER_DEPTH * SLOPE_UNIT) + vec2(BOX_MARGIN);
  return true;
}
#else
bool setUpTile(out int end, out bool alike)
{
  vec2 pixel = (listedTile + vec2(0.5)) * tileSize - imageCenter;
  setUpRay(pixel, vec2(0.0));
  vec2 originReach = 0.5 * tileSize * (abs(originPerColumn) + abs(originPerRow));
  vec2 slopeReach = 0.5 * tileSize * (abs(slopePerColumn) + abs(slopePerRow));
  reach = originReach * gridPerUnit;
  reachPerDepth = slopeReach * gridPerUnit;
  // The slope of a tile that extends beyond the image may not fit an integer.
  alike = all(lessThan(abs(rayAlong.xy) * gridPerUnit, vec2(GRID_PER_DEPTH)));
#if REFRACTED
  end = BEFORE_EVERYTHING;
  for (int i = 0; i < int(tileSize * tileSize); ++i)
  {
    end = max(end, gridDepthOf(intBitsToFloat(fetchLine(i, 1, 1).x)) + DEPTH_SLACK);
  }
#else
  end = AFTER_EVERYTHING;
#endif
  return true;
}
#endif

//--- Interface of the lists ----------------------------------------------------------------------

// Adds a face to the list of the tile.
void addFace(int face);
// True if a face has come for which there was no room.
bool isListFull();

//--- Search --------------------------------------------------------------------------------------

// Sets up a tile. Returns false if no list can serve all of its rays; `last` is the number of nodes
// to be searched, 0 for a tile without rays to the mesh, and `end` the depth at which rays end.
bool startTile(vec2 tile, out int last, out int end)
{
  listedTile = tile;
  bool alike;
  bool nearMesh = setUpTile(end, alike) &&
    all(lessThanEqual(abs(rayOrigin),
      vec2(length(rayU), length(rayV)) + vec2(BOX_MARGIN) + reach + 2.0 * reachPerDepth));
  // Coordinates relative to the central ray of a tile that is larger than the mesh may overflow.
  alike = alike && !(nearMesh && any(greaterThan(reach + reachPerDepth, vec2(LARGEST_REACH))));
  last = nearMesh && alike ? numberOfNodes : 0;
  return alike;
}

// Adds the faces by which rays of the tile may enter, among the nodes [node, last) of the tree.
void searchNodes(int node, int last, int end)
{
  while (node < last && !isListFull())
  {
    // The tree is descended to the next leaf in a loop of its own: llvmpipe executes all of a loop
    // in each turn. The leaf is carried around that loop, see walk().
    int leaf = -1;
    do
    {
      int found;
      meetsBox(node, reach, reachPerDepth, ivec2(BEFORE_EVERYTHING, end), node, found);
      leaf = max(leaf, found);
    } while (leaf < 0 && node < last);
    if (leaf >= 0 && mayEnter(leaf))
    {
      addFace(leaf);
    }
  }
}
