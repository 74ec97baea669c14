//VTK::System::Dec
#extension GL_ARB_gpu_shader5 : enable
#extension GL_ARB_shader_bit_encoding : enable

// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lists the entries of a tile per fragment (vtkTetrahedraEntryTiles).

in vec2 texCoord;

//VTK::Output::Dec

//VTK::TetrahedraOptions::Dec

//VTK::TetrahedraBehind::Dec

//VTK::TetrahedraRays::Dec

//VTK::TetrahedraEntryTiles::Dec

uniform vec2 tileCount;

vec4 list[TILE_CAPACITY / 4];
int count;

void addFace(int face)
{
  if (count < TILE_CAPACITY)
  {
    list[count / 4][count % 4] = float(face);
  }
  ++count;
}

bool isListFull()
{
  return count > TILE_CAPACITY;
}

void main()
{
  for (int i = 0; i < TILE_CAPACITY / 4; ++i)
  {
    list[i] = vec4(-1.0);
  }
  count = 0;
  int last;
  int end;
  bool alike = startTile(floor(texCoord * tileCount), last, end);
  searchNodes(0, last, end);
  if (!alike || isListFull())
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
