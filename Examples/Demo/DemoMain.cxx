// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
//
// meniscus_demo [MESH.vtu] [--output FOLDER]: images of both main functions, with generated data or
// the user's mesh.
#include "DemoVolumeInput.h"
#include "RefractionDemo.h"
#include "StackDemo.h"
#include "SurfaceDemo.h"
#include "VolumeDemo.h"
#include "WellDemo.h"

#include "vtkUnstructuredGrid.h"

#include <cstdio>
#include <cstring>
#include <string>

#include <vtksys/SystemTools.hxx>

int main(int argc, char* argv[])
{
  std::string mesh;
  std::string folder = "demo-output";
  for (int i = 1; i < argc; ++i)
  {
    if (std::strcmp(argv[i], "--output") == 0 && i + 1 < argc)
    {
      folder = argv[++i];
    }
    else if (argv[i][0] != '-' && mesh.empty())
    {
      mesh = argv[i];
    }
    else
    {
      std::printf("usage: %s [MESH.vtu] [--output FOLDER]\n", argv[0]);
      return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
    }
  }
  if (!vtksys::SystemTools::MakeDirectory(folder))
  {
    std::fprintf(stderr, "error: the folder %s cannot be made\n", folder.c_str());
    return 1;
  }
  const auto grid = mesh.empty() ? MakeDemoMesh() : ReadDemoMesh(mesh);
  if (!grid)
  {
    return 1;
  }
  const bool volume = RunVolumeDemo(grid, folder);
  const bool refraction = RunRefractionDemo(folder);
  const bool well = RunWellDemo(folder);
  const bool stack = RunStackDemo(folder);
  const bool surface = RunSurfaceDemo(folder);
  return volume && refraction && well && stack && surface ? 0 : 1;
}
