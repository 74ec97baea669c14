// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Search for a ray's next entries. With LONG_LISTS every tile has a list of faces of any length,
// see Module/Volume/Entries/EntryTiles.h; otherwise it has a list of at most 32 faces, and the tree
// is searched for tiles with more.

// The next entries of the ray in the order of depth, then number; -1 where there are none.
ivec4 entryDepths;   // in grid units
ivec4 entryFaces;
bool moreEntries;    // true if there may be further entries behind them

bool isBefore(int depth, int number, int otherDepth, int otherNumber)
{
  return depth < otherDepth || (depth == otherDepth && number < otherNumber);
}

#if LONG_LISTS
uniform isamplerBuffer tileBegins;   // start of each tile's list, and end of the last one
uniform isamplerBuffer tileFaces;    // the lists, from near to far
uniform samplerBuffer nearestDepths; // by face, a depth before which no ray enters by it
uniform int tileColumns;
uniform float longListTileSize;

int listAt;          // first face that has not been examined
int listEnd;
int listFace;        // that face and the depth of its entry; AFTER_EVERYTHING beyond the list
int listDepth;
ivec4 entryPlaces;   // places in the list of the entries found
// Entries for which there was no room: the first place in the list, and the smallest depth of them.
int leftOutAt;
int leftOutDepth;
int leftOutFace;

void fetchListed()
{
  bool within = listAt < listEnd;
  listFace = within ? texelFetch(tileFaces, listAt).r : 0;
  listDepth = within ? gridDepthOf(texelFetch(nearestDepths, listFace).r) : AFTER_EVERYTHING;
}

// Sets up the search for the sight ray.
void startEntries(bool meetsMesh)
{
  ivec2 tile = ivec2(rayTilePixel / longListTileSize);
  int number = tile.y * tileColumns + tile.x;
  listAt = meetsMesh ? texelFetch(tileBegins, number).r : 0;
  listEnd = meetsMesh ? texelFetch(tileBegins, number + 1).r : 0;
  entryFaces = ivec4(-1);
  entryDepths = ivec4(0);
  entryPlaces = ivec4(0);
  leftOutAt = listEnd;
  leftOutDepth = AFTER_EVERYTHING;
  leftOutFace = 0;
  moreEntries = meetsMesh;
  fetchListed();
}

// No entry behind one that is left out is taken, so that all of them come in order.
void insertEntry(int depth, int number, int place)
{
  if (isBefore(depth, number, leftOutDepth, leftOutFace))
  {
    for (int i = 0; i < 4; ++i)
    {
      if (number >= 0 &&
        (entryFaces[i] < 0 || isBefore(depth, number, entryDepths[i], entryFaces[i])))
      {
        int otherDepth = entryDepths[i];
        int otherNumber = entryFaces[i];
        int otherPlace = entryPlaces[i];
        entryDepths[i] = depth;
        entryFaces[i] = number;
        entryPlaces[i] = place;
        depth = otherDepth;
        number = otherNumber;
        place = otherPlace;
      }
    }
    leftOutDepth = number >= 0 ? depth : leftOutDepth;
    leftOutFace = number >= 0 ? number : leftOutFace;
  }
  leftOutAt = number >= 0 ? min(leftOutAt, place) : leftOutAt;
}

// Examines faces of the list until none of the others can be entered before the next entry after
// (lastDepth, lastFace). The loop's condition comes last, as in walk().
void findEntries(int lastDepth, int lastFace)
{
  if (entryFaces.x < 0 && leftOutAt < listEnd)
  {
    // All entries before those left out have been taken.
    listAt = leftOutAt;
    leftOutAt = listEnd;
    leftOutDepth = AFTER_EVERYTHING;
    fetchListed();
  }
  bool looks = listDepth < endDepth && (entryFaces.x < 0 || listDepth <= entryDepths.x);
  do
  {
    if (looks)
    {
      ProjectedFace f = seeFace(listFace);
      if (f.entered && f.depth < endDepth && isBefore(lastDepth, lastFace, f.depth, listFace))
      {
        insertEntry(f.depth, listFace, listAt);
      }
      ++listAt;
      fetchListed();
      looks = listDepth < endDepth && (entryFaces.x < 0 || listDepth <= entryDepths.x);
    }
  } while (looks);
}

#else
uniform sampler3D entryTiles;        // per tile: faces to enter by (vtkTetrahedraEntryTilesFS)
#if REFRACTED
uniform sampler3D refractedTiles;    // the same for the refracted legs, one behind the other
#endif

// Bound of the depths of the mesh, which are within 2^30 - 2048 plus rounding (GRID_PER_DEPTH); the
// difference of two such bounds still fits an int.
const int FARTHEST_DEPTH = 1073741823;
const int LARGEST_REACH = 2147483646;
// DEPTH_MARGIN in grid units, by which the boxes of the tree are enlarged: with a smaller reach the
// search would make no progress.
const int SMALLEST_REACH = 2048;

int searchReach;     // depth behind the last entry in which the tree is searched

int twice(int reach)
{
  return reach > FARTHEST_DEPTH ? LARGEST_REACH : 2 * reach;
}

// The depth at a distance of `reach` behind `first`, or `farthest` if that is nearer.
int behind(int first, int reach, int farthest)
{
  return farthest - first < reach ? farthest : first + reach;
}

void startEntries(bool meetsMesh)
{
  entryFaces = ivec4(-1);
  entryDepths = ivec4(0);
  searchReach = LARGEST_REACH;
  moreEntries = meetsMesh;
}

void insertEntry(int depth, int number)
{
  moreEntries = moreEntries || entryFaces.w >= 0;
  for (int i = 0; i < 4; ++i)
  {
    if (entryFaces[i] < 0 || isBefore(depth, number, entryDepths[i], entryFaces[i]))
    {
      int otherDepth = entryDepths[i];
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

vec4 fetchTile(ivec2 tile, int layer)
{
#if REFRACTED
  if (rayLeg > 0)
  {
    return texelFetch(refractedTiles, ivec3(tile, (rayLeg - 1) * (TILE_CAPACITY / 4) + layer), 0);
  }
#endif
  return texelFetch(entryTiles, ivec3(tile, layer), 0);
}

// Finds the next entries after (lastDepth, lastFace) among the faces listed for the ray's tile, or
// in the tree if the list was too long. The tree is searched in a range of depths behind the last
// entry that holds about four entries, so that each search visits few of its nodes.
void collectEntries(int lastDepth, int lastFace)
{
  ivec2 tile = ivec2(rayTilePixel / tileSize);
  bool listed = fetchTile(tile, 0).x > -1.5;
  int farthest = min(endDepth, FARTHEST_DEPTH);
  int first = clamp(lastDepth, -FARTHEST_DEPTH, farthest);
  ivec2 range = ivec2(first, listed ? farthest : behind(first, searchReach, farthest));
  entryFaces = ivec4(-1);
  entryDepths = ivec4(0);
  moreEntries = false;
  int at = 0;
  int end = listed ? TILE_CAPACITY : numberOfNodes;
  do
  {
    // The tree is descended outside of the loop over a list: llvmpipe executes all of a loop in
    // each turn.
    int candidate = -1;
    if (!listed)
    {
      meetsBox(at, vec2(0.0), vec2(0.0), range, at, candidate);
    }
    do
    {
      if (listed)
      {
        candidate = int(fetchTile(tile, at / 4)[at % 4]);
        at = candidate < 0 ? end : at + 1;
      }
      if (candidate >= 0)
      {
        ProjectedFace f = seeFace(candidate);
        if (f.entered && f.depth < endDepth && f.depth <= range.y &&
          isBefore(lastDepth, lastFace, f.depth, candidate))
        {
          insertEntry(f.depth, candidate);
        }
      }
    } while (listed && at < end);
    // If the range holds no entry, the next range has twice the depth.
    bool again = at >= end && !listed && entryFaces.x < 0 && range.y < farthest;
    searchReach = again ? twice(searchReach) : searchReach;
    range = again ? ivec2(range.y, behind(range.y, searchReach, farthest)) : range;
    at = again ? 0 : at;
  } while (at < end);
  searchReach =
    moreEntries ? max(twice(entryDepths.w - first), SMALLEST_REACH) : twice(searchReach);
  moreEntries = moreEntries || range.y < farthest;
}

void findEntries(int lastDepth, int lastFace)
{
  if (entryFaces.x == -1 && moreEntries)
  {
    collectEntries(lastDepth, lastFace);
  }
}
#endif
