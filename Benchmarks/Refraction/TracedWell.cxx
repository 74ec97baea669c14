// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedWell.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace meniscus::benchmark
{

//------------------------------------------------------------------------------
TracedMesh MembraneOf(const reference::MembraneMesh& mesh)
{
  TracedMesh result;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    result.AddPoint(mesh.Points.data() + i);
  }
  result.Normals.assign(mesh.Normals.begin(), mesh.Normals.end());
  result.Triangles.assign(mesh.Triangles.begin(), mesh.Triangles.end());
  result.Finish();
  return result;
}

//------------------------------------------------------------------------------
TracedMesh ObjectOf(vtkPolyData* data)
{
  TracedMesh result;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    result.AddPoint(data->GetPoint(i));
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    data->GetCellPoints(i, ids);
    for (const vtkIdType k : { 1, 2 })
    {
      for (const vtkIdType c : { vtkIdType(0), k, k + 1 })
      {
        result.Triangles.push_back(static_cast<std::uint32_t>(ids->GetId(c)));
      }
    }
  }
  result.Finish();
  return result;
}

//------------------------------------------------------------------------------
TriangleColors ColorsOf(vtkPolyData* data)
{
  TriangleColors result;
  vtkDataArray* colors = data->GetCellData()->GetScalars();
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    std::uint32_t rgba = 0xff000000u;
    for (int c = 0; c < 3; ++c)
    {
      rgba |= static_cast<std::uint32_t>(colors->GetComponent(i, c)) << (8 * c);
    }
    result.Colors.insert(result.Colors.end(), { rgba, rgba });
  }
  return result;
}

//------------------------------------------------------------------------------
TracedView ViewOf(const test::PixelCamera& camera)
{
  return { camera.GetEye(), camera.GetForward(), camera.GetRight(), camera.GetUp(),
    camera.GetPixels() };
}

//------------------------------------------------------------------------------
test::PlacePicture PlacesOf(const RefractionTracer& tracer, const test::PixelCamera& camera)
{
  const TracedView view = ViewOf(camera);
  test::PlacePicture picture(static_cast<std::size_t>(view.Pixels) * view.Pixels);
  TracePixels(tracer, view,
    [&picture](const TracedPacket& packet, int k, std::size_t number)
    {
      if (packet.Triangle[k] == TracedPacket::None)
      {
        return;
      }
      test::PlacePixel& pixel = picture[number];
      pixel.Covered = true;
      for (int i = 0; i < 3; ++i)
      {
        pixel.Place[i] = packet.Place[i][k] + packet.Depth[k] * packet.Refracted[i][k];
      }
    });
  return picture;
}

} // namespace meniscus::benchmark
