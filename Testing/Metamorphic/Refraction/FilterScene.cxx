// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterScene.h"

#include "vtkRefractedGeometryFilter.h"

namespace meniscus::test
{

namespace
{

const double Pi = std::acos(-1.0);

void AddRows(FilterScene& scene, int rows, int columns, bool isClosed)
{
  const int across = isClosed ? columns : columns + 1;
  for (const auto& [row, i] : Product(rows, columns))
  {
    const vtkIdType a = row * across + i;
    const vtkIdType b = row * across + (i + 1) % across;
    scene.Quads.push_back({ a, b, b + across, a + across });
  }
  scene.QuadsPerRow = columns;
}

void AddSheet(FilterScene& scene, const glm::dvec3& center, double size, RandomNumbers& random)
{
  const glm::dvec3 x = random.GetDirection();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.GetDirection()));
  const int count = 3 + random.Below(6);
  for (const auto& [j, i] : Product(count + 1, count + 1))
  {
    scene.Points.push_back(
      center + size * ((2.0 * i / count - 1.0) * x + (2.0 * j / count - 1.0) * y));
  }
  AddRows(scene, count, count, false);
}

// A ball without its poles: its quads are symmetric trapezoids, which are plane.
void AddBall(FilterScene& scene, const glm::dvec3& center, double radius, RandomNumbers& random)
{
  const glm::dvec3 x = random.GetDirection();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.GetDirection()));
  const glm::dvec3 z = glm::cross(x, y);
  const int rows = 3 + random.Below(5);
  const int columns = 2 * rows;
  for (int j = 0; j <= rows; ++j)
  {
    const double polar = Pi * (0.1 + 0.8 * j / rows);
    for (int i = 0; i < columns; ++i)
    {
      const double turn = 2.0 * Pi * i / columns;
      scene.Points.push_back(center +
        radius *
          (std::sin(polar) * (std::cos(turn) * x + std::sin(turn) * y) + std::cos(polar) * z));
    }
  }
  AddRows(scene, rows, columns, true);
}

// Two triangles with a common side as the corners of a strip: the side's ends are second and third.
bool JoinTriangles(const std::int64_t* a, const std::int64_t* b, std::array<vtkIdType, 4>& strip)
{
  for (const auto& [i, j] : Product(3, 3))
  {
    if (a[(i + 1) % 3] == b[(j + 2) % 3] && a[(i + 2) % 3] == b[(j + 1) % 3])
    {
      strip = { a[i], a[(i + 1) % 3], a[(i + 2) % 3], b[j] };
      return true;
    }
  }
  return false;
}

} // anonymous namespace

//------------------------------------------------------------------------------
FilterScene MakeFilterScene(RandomNumbers& random)
{
  FilterScene scene;
  scene.Base = RandomScene(random);
  const FilterMode modes[] = { FilterMode::FlatFacets, FilterMode::FirstImage,
    FilterMode::AllImages, FilterMode::AllImages };
  scene.Mode = modes[random.Below(4)];
  const reference::MembraneMesh& mesh = scene.Base.Mesh;
  const auto at = static_cast<std::size_t>(random.Below(static_cast<int>(mesh.Points.size() / 3)));
  const glm::dvec3 point(mesh.Points[3 * at], mesh.Points[3 * at + 1], mesh.Points[3 * at + 2]);
  const glm::dvec3 normal(mesh.Normals[3 * at], mesh.Normals[3 * at + 1], mesh.Normals[3 * at + 2]);
  const double size = random.Uniform(0.1, 0.8);
  // One object in four crosses the membrane.
  const double depth =
    random.Below(4) == 0 ? random.Uniform(-0.5, 0.8) * size : size * random.Uniform(1.1, 4.0);
  const glm::dvec3 center = point - depth * normal;
  if (random.Below(2))
  {
    AddSheet(scene, center, size, random);
  }
  else
  {
    AddBall(scene, center, size, random);
  }
  return scene;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeObject(
  const FilterScene& scene, CellForm form, const std::vector<glm::dvec3>* places)
{
  const std::vector<glm::dvec3>& from = places ? *places : scene.Points;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> truth;
  truth->SetName("Truth");
  truth->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> ones;
  ones->SetName("Ones");
  vtkNew<vtkDoubleArray> index;
  index->SetName("Index");
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    points->InsertNextPoint(&from[i].x);
    truth->InsertNextTuple(&scene.Points[i].x);
    ones->InsertNextValue(1.0);
    index->InsertNextValue(static_cast<double>(i));
  }
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < scene.Quads.size(); ++i)
  {
    const auto& quad = scene.Quads[i];
    if (form == CellForm::Quads)
    {
      cells->InsertNextCell(4, quad.data());
    }
    else if (form == CellForm::Triangles)
    {
      cells->InsertNextCell({ quad[0], quad[1], quad[2] });
      cells->InsertNextCell({ quad[0], quad[2], quad[3] });
    }
    else if (i % static_cast<std::size_t>(scene.QuadsPerRow) == 0)
    {
      std::vector<vtkIdType> strip = { quad[0], quad[3] };
      for (int k = 0; k < scene.QuadsPerRow; ++k)
      {
        const auto& next = scene.Quads[i + static_cast<std::size_t>(k)];
        strip.push_back(next[1]);
        strip.push_back(next[2]);
      }
      cells->InsertNextCell(static_cast<vtkIdType>(strip.size()), strip.data());
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  form == CellForm::Strips ? data->SetStrips(cells) : data->SetPolys(cells);
  data->GetPointData()->AddArray(truth);
  data->GetPointData()->AddArray(ones);
  data->GetPointData()->AddArray(index);
  return data;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeMembraneData(const reference::MembraneMesh& mesh, CellForm form)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    points->InsertNextPoint(mesh.Points.data() + i);
    normals->InsertNextTuple(mesh.Normals.data() + i);
  }
  vtkNew<vtkCellArray> polys;
  vtkNew<vtkCellArray> strips;
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    const std::int64_t* ids = mesh.Triangles.data() + i;
    std::array<vtkIdType, 4> both;
    if (form != CellForm::Triangles && i + 3 < mesh.Triangles.size() &&
      JoinTriangles(ids, ids + 3, both))
    {
      if (form == CellForm::Strips)
      {
        strips->InsertNextCell(4, both.data());
      }
      else
      {
        polys->InsertNextCell({ both[0], both[1], both[3], both[2] });
      }
      i += 3;
      continue;
    }
    // Flat facets show a point in the first facet: the order of the facets stays the same.
    (form == CellForm::Strips ? strips : polys)->InsertNextCell({ ids[0], ids[1], ids[2] });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polys);
  data->SetStrips(strips);
  data->GetPointData()->SetNormals(normals);
  return data;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Convert(vtkPolyData* data, bool isDouble, bool has64Bits)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(data);
  vtkNew<vtkPoints> points;
  points->SetDataType(isDouble ? VTK_DOUBLE : VTK_FLOAT);
  points->DeepCopy(data->GetPoints());
  copy->SetPoints(points);
  for (vtkCellArray* cells : { copy->GetPolys(), copy->GetStrips() })
  {
    has64Bits ? cells->ConvertTo64BitStorage() : cells->ConvertTo32BitStorage();
  }
  return copy;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRefractedGeometryFilter> MakeSceneFilter(
  const FilterScene& scene, vtkPolyData* object, vtkPolyData* membrane)
{
  auto filter = vtkSmartPointer<vtkRefractedGeometryFilter>::New();
  filter->GlobalWarningDisplayOff(); // scenes without an image are among the random ones
  filter->SetInputData(object);
  filter->SetMembraneData(membrane);
  filter->SetEyePosition(scene.Base.Eye.x, scene.Base.Eye.y, scene.Base.Eye.z);
  filter->SetExteriorIndexOfRefraction(scene.Base.Exterior);
  filter->SetInteriorIndexOfRefraction(scene.Base.Interior);
  filter->SetMembraneModel(scene.Mode == FilterMode::FlatFacets
      ? vtkRefractedGeometryFilter::FLAT_FACETS
      : vtkRefractedGeometryFilter::CURVED);
  filter->SetImages(scene.Mode == FilterMode::AllImages ? vtkRefractedGeometryFilter::ALL_IMAGES
                                                        : vtkRefractedGeometryFilter::FIRST_IMAGE);
  filter->SetAngularTolerance(scene.Tolerance);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return filter;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> GetResult(vtkRefractedGeometryFilter* filter)
{
  filter->Update();
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->DeepCopy(filter->GetOutput());
  return result;
}

//------------------------------------------------------------------------------
glm::dvec3 GetTuple(vtkPolyData* data, const char* name, vtkIdType point)
{
  const glm::dvec3 value = TupleOf(data->GetPointData()->GetArray(name), point);
  return value;
}

} // namespace meniscus::test
