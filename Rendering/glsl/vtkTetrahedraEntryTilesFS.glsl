//VTK::System::Dec
#extension GL_ARB_gpu_shader5 : enable

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Lists, for each tile of the image, the boundary faces by which a ray of the tile may enter the
// mesh: up to 32 faces in 8 targets, filled up with -1. The list of a tile with more begins with -2.
// Works with the tile's central ray, in its grid units, and bounds the difference to the others.
//
// With BENDING, rays straight on end at the membrane. With BEHIND the rays are those behind it; the list
// of a tile where these are of several frames begins with -2, too.

in vec2 texCoord;

//VTK::Output::Dec

//VTK::TetrahedraOptions::Dec

//VTK::TetrahedraBehind::Dec

//VTK::TetrahedraRays::Dec

uniform float tileSize;
uniform vec2 tileCount;

const int CAPACITY = 32;
// Bounds rounding of a sum of three edge areas, each to 2^24.
const float AREA_MARGIN = 67108864.0;

// By how much (u, v) of a vertex at depth 0, and more per unit of depth, differs among the rays.
vec2 reach;
vec2 reachPerDepth;

// By how much the area of (ray, p, q) differs among the rays: with p and q displaced by d and
// d + t (q.z - p.z), it changes by d x (q - p) + t (q.z - p.z) x p and the product of the two.
float areaReach(RayVertex p, RayVertex q)
{
  vec2 d = reach + reachPerDepth * abs(p.z);
  vec2 t = reachPerDepth * abs(q.z - p.z);
  vec2 edge = abs(q.xy - p.xy);
  vec2 from = abs(p.xy) + d;
  return d.x * edge.y + d.y * edge.x + t.x * from.y + t.y * from.x + AREA_MARGIN;
}

// By how much the area of (p, q, r) seen along the rays differs: by the slopes only.
float faceAreaReach(RayVertex p, RayVertex q, RayVertex r)
{
  vec3 e = abs(q.xyz - p.xyz);
  vec3 f = abs(r.xyz - p.xyz);
  vec2 te = reachPerDepth * e.z;
  vec2 tf = reachPerDepth * f.z;
  return te.x * (f.y + tf.y) + te.y * (f.x + tf.x) + tf.x * e.y + tf.y * e.x + AREA_MARGIN;
}

// Whether some ray of the tile may enter the mesh by the face.
bool mayEnter(int index)
{
  ivec4 record = texelFetch(treeFaces, index);
  RayVertex p = fetchVertex(record.x < 0 ? ~record.x : record.x);
  RayVertex q = fetchVertex(record.y);
  RayVertex r = fetchVertex(record.z);
  float entering = float((record.x < 0 ? -1 : 1) * enteringSign);
  vec3 areas = entering * vec3(edgeArea(p, q), edgeArea(q, r), edgeArea(r, p));
  vec3 reaches = vec3(areaReach(p, q), areaReach(q, r), areaReach(r, p));
  return all(greaterThanEqual(areas + reaches, vec3(0.0))) &&
    areas.x + areas.y + areas.z + faceAreaReach(p, q, r) >= 0.0;
}

#if BENDING
// A texel of the tile's pixel number i; those outside of the image are the next in it.
vec4 fetchLine(int i, int texel)
{
  int columns = int(tileSize);
  ivec2 size = ivec2(textureSize(bentLines, 0).x / 2, textureSize(bentLines, 0).y);
  ivec2 corner = ivec2(floor(texCoord * tileCount) * tileSize);
  ivec2 pixel = min(corner + ivec2(i % columns, i / columns), size - 1);
  return texelFetch(bentLines, ivec2(2 * pixel.x + texel, pixel.y), 0);
}
#endif

// Sets up the central ray. Yields where all rays end; whether there is one for all. False if there is
// none.
#if BEHIND
bool setUpTile(out float end, out bool alike)
{
  // Origin and slope.
  vec4 least = vec4(1.0e+30);
  vec4 most = vec4(-1.0e+30);
  int frame = -1;
  end = AFTER_EVERYTHING;
  alike = true;
  for (int i = 0; i < int(tileSize * tileSize); ++i)
  {
    vec4 place = fetchLine(i, 1);
    if (place.z > 0.0)
    {
      vec4 line = fetchLine(i, 0);
      least = min(least, line);
      most = max(most, line);
      alike = alike && (frame < 0 || frame == int(place.w));
      frame = int(place.w);
    }
  }
  if (frame < 0)
  {
    return false;
  }
  vec4 middle = 0.5 * (least + most);
  setUpBentRay(frame, middle.xy, middle.zw, vec2(0.0));
  // The lines are those of the pixels' centres: there is no room between for rounding to the grid.
  vec4 spread = 0.5 * (most - least);
  reach = spread.xy * gridScale + vec2(BOX_MARGIN);
  reachPerDepth = spread.zw * gridScale;
  return true;
}
#else
bool setUpTile(out float end, out bool alike)
{
  vec2 pixel = (floor(texCoord * tileCount) + vec2(0.5)) * tileSize - imageCenter;
  setUpRay(pixel, vec2(0.0));
  vec2 originReach = 0.5 * tileSize * (abs(originPerColumn) + abs(originPerRow));
  vec2 slopeReach = 0.5 * tileSize * (abs(slopePerColumn) + abs(slopePerRow));
  reach = originReach * gridScale;
  reachPerDepth = slopeReach * gridScale;
  alike = true;
#if BENDING
  end = BEFORE_EVERYTHING;
  for (int i = 0; i < int(tileSize * tileSize); ++i)
  {
    end = max(end, fetchLine(i, 1).x);
  }
#else
  end = AFTER_EVERYTHING;
#endif
  return true;
}
#endif

void main()
{
  float end;
  bool alike;
  bool nearMesh = setUpTile(end, alike) && alike &&
    all(lessThanEqual(
      abs(rayOrigin), vec2(GRID_RADIUS + BOX_MARGIN) + reach + 2.0 * reachPerDepth));

  vec4 list[8];
  for (int i = 0; i < 8; ++i)
  {
    list[i] = vec4(-1.0);
  }
  int count = alike ? 0 : CAPACITY + 1;
  int node = nearMesh ? 0 : numberOfNodes;
  while (node < numberOfNodes && count <= CAPACITY)
  {
    int leaf;
    meetsBox(node, reach, reachPerDepth, vec2(BEFORE_EVERYTHING, end), node, leaf);
    if (leaf >= 0 && mayEnter(leaf))
    {
      if (count < CAPACITY)
      {
        list[count / 4][count % 4] = float(leaf);
      }
      ++count;
    }
  }
  if (count > CAPACITY)
  {
    list[0].x = -2.0;
  }
  gl_FragData[0] = list[0];
  gl_FragData[1] = list[1];
  gl_FragData[2] = list[2];
  gl_FragData[3] = list[3];
  gl_FragData[4] = list[4];
  gl_FragData[5] = list[5];
  gl_FragData[6] = list[6];
  gl_FragData[7] = list[7];
}
