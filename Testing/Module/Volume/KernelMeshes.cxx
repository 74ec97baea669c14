// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "KernelMeshes.h"

namespace meniscus::test
{

//------------------------------------------------------------------------------
MeshArrays SingleTetrahedron()
{
  return { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 1, 2, 3 } };
}

//------------------------------------------------------------------------------
MeshArrays KuhnGrid(int n)
{
  return KuhnBlock(n, n, n, n);
}

//------------------------------------------------------------------------------
MeshArrays KuhnBlock(int nx, int ny, int nz, double perUnit)
{
  MeshArrays mesh;
  for (const auto& [k, j, i] : Product(nz + 1, ny + 1, nx + 1))
  {
    mesh.Points.insert(mesh.Points.end(), { i / perUnit, j / perUnit, k / perUnit });
  }
  // From one corner of the cube to the opposite one, along the axes in every order.
  const std::int64_t axis[3] = { 1, nx + 1, std::int64_t(nx + 1) * (ny + 1) };
  const int orders[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
    { 2, 1, 0 } };
  for (const auto& [k, j, i] : Product(nz, ny, nx))
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
MeshArrays Moved(MeshArrays mesh, const Motion& motion)
{
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const glm::dvec3 p = motion(mesh.PointAt(static_cast<std::int64_t>(i / 3)));
    std::copy(&p.x, &p.x + 3, mesh.Points.data() + i);
  }
  return mesh;
}

//------------------------------------------------------------------------------
MeshArrays Joined(const MeshArrays& a, const MeshArrays& b)
{
  MeshArrays both = a;
  const auto first = static_cast<std::int64_t>(a.Points.size() / 3);
  both.Points.insert(both.Points.end(), b.Points.begin(), b.Points.end());
  for (const std::int64_t id : b.Cells)
  {
    both.Cells.push_back(first + id);
  }
  return both;
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
