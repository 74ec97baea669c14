#version 430

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lists the entries of a tile per group (vtkTetrahedraEntryTiles): the twin of the fragment shader
// (vtkTetrahedraEntryTilesFS). Invocations share the tree: one alone would wait for some hundred
// nodes, one after the other. The order of the faces in a list depends on chance; the rays sort
// them.

layout(local_size_x = 32) in;

layout(rgba32f, binding = 0) uniform writeonly image3D tileImage;

//VTK::TetrahedraOptions::Dec

//VTK::TetrahedraBehind::Dec

//VTK::TetrahedraRays::Dec

//VTK::TetrahedraEntryTiles::Dec

uniform int firstLayer;

// The tree is cut into at most 2^SUBTREE_LEVELS subtrees, some for each invocation: next to each
// other in the tree, and therefore in space, are those of different ones.
const int SUBTREE_LEVELS = 8;

shared int faces[TILE_CAPACITY];
shared int count;

void addFace(int face)
{
  int place = atomicAdd(count, 1);
  if (place < TILE_CAPACITY)
  {
    faces[place] = face;
  }
}

bool isListFull()
{
  return count > TILE_CAPACITY;
}

// Nodes [first, last) of a subtree: at each level one half of the faces, as the tree is built
// (Module/Volume/Mesh/BoundaryTree.h). With n faces it has 2 n - 1 nodes, of which its root is the
// first. None if the tree ends above.
void findSubtree(int number, out int first, out int last)
{
  first = 0;
  int size = (numberOfNodes + 1) / 2;
  for (int level = SUBTREE_LEVELS - 1; level >= 0; --level)
  {
    bool second = ((number >> level) & 1) == 1;
    int fewer = size / 2;
    bool leaf = size <= 1;
    first += leaf ? 0 : (second ? 2 * fewer : 1);
    size = leaf ? (second ? 0 : size) : (second ? size - fewer : fewer);
  }
  last = first + max(2 * size - 1, 0);
}

void main()
{
  int lane = int(gl_LocalInvocationIndex);
  faces[lane] = -1;
  if (lane == 0)
  {
    count = 0;
  }
  barrier();
  int nodes;
  int end;
  ivec2 tile = ivec2(gl_WorkGroupID.xy);
  bool alike = startTile(vec2(tile), nodes, end);
  for (int i = lane; i < (1 << SUBTREE_LEVELS); i += TILE_CAPACITY)
  {
    int first;
    int last;
    findSubtree(i, first, last);
    searchNodes(first, min(last, nodes), end);
  }
  barrier();
  if (lane < TILE_CAPACITY / 4)
  {
    ivec4 four =
      ivec4(faces[4 * lane], faces[4 * lane + 1], faces[4 * lane + 2], faces[4 * lane + 3]);
    four.x = lane == 0 && (!alike || isListFull()) ? -2 : four.x;
    imageStore(tileImage, ivec3(tile, firstLayer + lane), vec4(four));
  }
}
