// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelMeshes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace meniscus
{
namespace test
{

//------------------------------------------------------------------------------
MeshArrays SingleTetrahedron()
{
  return { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 1, 2, 3 } };
}

//------------------------------------------------------------------------------
MeshArrays KuhnGrid(int n)
{
  MeshArrays mesh;
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        mesh.Points.insert(mesh.Points.end(), { i / double(n), j / double(n), k / double(n) });
      }
    }
  }
  // From one corner of the cube to the opposite one, along the axes in every order.
  const std::int64_t axis[3] = { 1, n + 1, std::int64_t(n + 1) * (n + 1) };
  const int orders[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
    { 2, 1, 0 } };
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        for (const auto& order : orders)
        {
          std::int64_t vertex = i + j * axis[1] + k * axis[2];
          mesh.Cells.push_back(vertex);
          for (const int step : order)
          {
            vertex += axis[step];
            mesh.Cells.push_back(vertex);
          }
        }
      }
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
void Jitter(MeshArrays& mesh, double amount, unsigned int seed)
{
  std::mt19937 random(seed);
  for (double& coordinate : mesh.Points)
  {
    // The generator's raw numbers: distributions differ between libraries.
    coordinate += amount * (2.0 * (random() / 4294967295.0) - 1.0);
  }
}

//------------------------------------------------------------------------------
RayFrame FrameAlongZ(const TetrahedralMesh& mesh, double extent, int pixels)
{
  RayFrameInput input;
  input.WorldToView = glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5, -0.5, -10.0));
  input.ViewToClip = glm::ortho(-extent, extent, -extent, extent, 1.0, 30.0);
  input.Center = mesh.GetCenter();
  input.Radius = mesh.GetRadius();
  input.ImageSize = glm::dvec2(pixels);
  RayFrame frame;
  ComputeRayFrame(input, frame);
  return frame;
}

//------------------------------------------------------------------------------
std::vector<TransferFunctionInterval> ConstantFunction(double attenuation)
{
  return BuildIntervals({ { 0.0, attenuation, glm::dvec3(1.0) } }, ScalarNormalization());
}

}
}
