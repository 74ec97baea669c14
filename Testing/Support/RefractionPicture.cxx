// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionPicture.h"

#include "vtkCellArrayIterator.h"
#include "vtkGenericCell.h"
#include "vtkStaticCellLocator.h"

namespace meniscus::test
{
namespace
{

struct DrawnCorner
{
  glm::dvec3 Pixel;
  glm::dvec3 Place;
};

void DrawTriangle(
  const std::array<DrawnCorner, 3>& corner, const PixelCamera& camera, PlacePicture& picture)
{
  const glm::dvec3 p[3] = { corner[0].Pixel, corner[1].Pixel, corner[2].Pixel };
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  const double last = camera.GetPixels() - 1.0;
  const auto bound = [last](double value) { return std::min(std::max(value, 0.0), last); };
  const int x0 = static_cast<int>(bound(std::min({ p[0].x, p[1].x, p[2].x }) - 1.0));
  const int x1 = static_cast<int>(bound(std::max({ p[0].x, p[1].x, p[2].x }) + 1.0));
  const int y0 = static_cast<int>(bound(std::min({ p[0].y, p[1].y, p[2].y }) - 1.0));
  const int y1 = static_cast<int>(bound(std::max({ p[0].y, p[1].y, p[2].y }) + 1.0));
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      double w[3];
      for (int i = 0; i < 3; ++i)
      {
        const glm::dvec3& a = p[(i + 1) % 3];
        const glm::dvec3& b = p[(i + 2) % 3];
        w[i] = ((b.x - a.x) * (y + 0.5 - a.y) - (b.y - a.y) * (x + 0.5 - a.x)) / area / p[i].z;
      }
      // Borders belong to both sides; the depth, which is the same there, decides.
      constexpr double border = -1e-12;
      if (!(w[0] * p[0].z >= border && w[1] * p[1].z >= border && w[2] * p[2].z >= border))
      {
        continue;
      }
      const double sum = w[0] + w[1] + w[2];
      PlacePixel& pixel = picture[static_cast<std::size_t>(y * camera.GetPixels() + x)];
      if (1.0 / sum < pixel.Depth)
      {
        pixel = { true, 1.0 / sum,
          (w[0] * corner[0].Place + w[1] * corner[1].Place + w[2] * corner[2].Place) / sum };
      }
    }
  }
}

}

//------------------------------------------------------------------------------
PixelCamera::PixelCamera(
  const glm::dvec3& eye, const glm::dvec3& target, double halfTangent, int pixels)
  : Eye(eye)
  , Forward(glm::normalize(target - eye))
  , Pixels(pixels)
{
  this->Right = halfTangent * glm::normalize(glm::cross(this->Forward, glm::dvec3(0, 0, 1)));
  this->Up = glm::cross(this->Right, this->Forward);
}

//------------------------------------------------------------------------------
glm::dvec3 PixelCamera::GetRay(int x, int y) const
{
  return glm::normalize(this->Forward + (2.0 * (x + 0.5) / this->Pixels - 1.0) * this->Right +
    (2.0 * (y + 0.5) / this->Pixels - 1.0) * this->Up);
}

//------------------------------------------------------------------------------
glm::dvec3 PixelCamera::Project(const glm::dvec3& point) const
{
  const glm::dvec3 d = point - this->Eye;
  const double depth = glm::dot(d, this->Forward);
  const double scale = 1.0 / (depth * glm::dot(this->Right, this->Right));
  return { 0.5 * this->Pixels * (1.0 + glm::dot(d, this->Right) * scale),
    0.5 * this->Pixels * (1.0 + glm::dot(d, this->Up) * scale), depth };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeMembrane(
  const meniscus::reference::MembraneMesh& mesh, bool withNormals)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    points->InsertNextPoint(mesh.Points.data() + i);
    normals->InsertNextTuple(mesh.Normals.data() + i);
  }
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    triangles->InsertNextCell({ mesh.Triangles[i], mesh.Triangles[i + 1], mesh.Triangles[i + 2] });
  }
  auto membrane = vtkSmartPointer<vtkPolyData>::New();
  membrane->SetPoints(points);
  membrane->SetPolys(triangles);
  if (withNormals)
  {
    membrane->GetPointData()->SetNormals(normals);
  }
  return membrane;
}

//------------------------------------------------------------------------------
PlacePicture DrawPlaces(vtkPolyData* data, const PixelCamera& camera)
{
  PlacePicture picture(static_cast<std::size_t>(camera.GetPixels()) * camera.GetPixels());
  vtkDataArray* places = data->GetPointData()->GetArray("Place");
  const auto iterator = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    iterator->GetCurrentCell(count, ids);
    for (vtkIdType k = 2; k < count; ++k)
    {
      std::array<DrawnCorner, 3> corner;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const vtkIdType id = ids[i == 0 ? 0 : k - 2 + static_cast<vtkIdType>(i)];
        double x[3];
        data->GetPoint(id, x);
        corner[i].Pixel = camera.Project({ x[0], x[1], x[2] });
        places->GetTuple(id, x);
        corner[i].Place = glm::dvec3(x[0], x[1], x[2]);
      }
      DrawTriangle(corner, camera, picture);
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
void AddPlaces(vtkPolyData* data)
{
  vtkNew<vtkDoubleArray> place;
  place->SetName("Place");
  place->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    place->InsertNextTuple(p);
  }
  data->GetPointData()->AddArray(place);
}

//------------------------------------------------------------------------------
PlacePicture TraceRays(const PixelCamera& camera, const RayTracer& rays, const PlaceTracer& object)
{
  const int pixels = camera.GetPixels();
  PlacePicture picture(static_cast<std::size_t>(pixels) * pixels);
  for (const auto& [y, x] : Product(pixels, pixels))
  {
    const std::optional<LastLeg> leg = rays(camera.GetRay(x, y));
    if (leg)
    {
      picture[static_cast<std::size_t>(y * pixels + x)] = object(leg->Start, leg->Direction);
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
RayTracer MakeFieldRays(const reference::HeightField& membrane, const glm::dvec3& eye)
{
  return [membrane, eye](const glm::dvec3& ray) -> std::optional<LastLeg>
  {
    const glm::dvec3 s = membrane.Intersect(eye, ray, -eye.y / std::min(ray.y, -1e-3));
    const auto behind = membrane.Refract(eye, s, 1.0);
    if (behind && std::max(std::fabs(s.x), std::fabs(s.z)) <= 0.5 * membrane.Side)
    {
      return LastLeg{ s, *behind - s };
    }
    return std::nullopt;
  };
}

//------------------------------------------------------------------------------
PlacePicture TracePlaces(
  const reference::HeightField& membrane, const PixelCamera& camera, const PlaceTracer& object)
{
  return TraceRays(camera, MakeFieldRays(membrane, camera.GetEye()), object);
}

//------------------------------------------------------------------------------
PlaceTracer MakeSquareTracer(double y, double size)
{
  return [y, size](const glm::dvec3& start, const glm::dvec3& direction)
  {
    PlacePixel pixel;
    if (y < 0.0 ? direction.y < 0.0 : direction.y > 0.0)
    {
      pixel.Place = start + direction * ((y - start.y) / direction.y);
      pixel.Covered = std::max(std::fabs(pixel.Place.x), std::fabs(pixel.Place.z)) <= 0.5 * size;
    }
    return pixel;
  };
}

//------------------------------------------------------------------------------
PlaceTracer MakeMeshTracer(vtkPolyData* triangles, double length)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(triangles);
  locator->BuildLocator();
  return [locator = vtkSmartPointer<vtkStaticCellLocator>(locator),
           cell = vtkSmartPointer<vtkGenericCell>::New(),
           length](const glm::dvec3& start, const glm::dvec3& direction)
  {
    PlacePixel pixel;
    glm::dvec3 from = start;
    glm::dvec3 to = start + length * direction;
    double t = 0.0;
    double pcoords[3];
    int part = 0;
    vtkIdType id = -1;
    constexpr double tolerance = 1e-9; // of the locator, for rays along edges
    pixel.Covered = locator->IntersectWithLine(
                      &from.x, &to.x, tolerance, t, &pixel.Place.x, pcoords, part, id, cell) != 0;
    return pixel;
  };
}

//------------------------------------------------------------------------------
PixelCamera PictureScene::GetCamera() const
{
  return { this->Eye, { 0.0, 0.0, 0.0 }, 0.5 * this->Field.Side / this->Eye.y };
}

//------------------------------------------------------------------------------
const std::vector<PictureScene>& GetPictureScenes()
{
  using reference::HeightField;
  const double pi = std::acos(-1.0);
  const HeightField dome{ HeightField::Shape::Dome, 200.0, 30.0, 0.025, 1.0, 1.5 };
  const HeightField waves{ HeightField::Shape::Waves, 200.0, 4.0, 0.03 * pi, 1.0, 1.333 };
  static const std::vector<PictureScene> scenes = {
    { "dome, object centred", dome, { 0.0, 500.0, 0.0 }, 64, 120.0, 60.0, 8 },
    { "dome, object aside", dome, { 60.0, 450.0, 30.0 }, 64, 120.0, 80.0, 8 },
    { "dome, near its focus", dome, { 0.0, 500.0, 10.0 }, 64, 75.0, 30.0, 4 },
    { "waves with caustics", waves, { 20.0, 300.0, 10.0 }, 96, 180.0, 120.0, 6 },
    { "waves, one large tile beyond the border", waves, { 20.0, 300.0, 10.0 }, 96, 60.0, 400.0, 1 },
  };
  return scenes;
}

//------------------------------------------------------------------------------
double GetFootprint(const PlacePicture& picture, const PixelCamera& camera, std::size_t pixel)
{
  const auto row = static_cast<std::size_t>(camera.GetPixels());
  double largest = 0.0;
  for (const std::size_t j : { pixel - 1, pixel + 1, pixel - row, pixel + row })
  {
    if (j < picture.size())
    {
      largest = std::max(largest, glm::length(picture[j].Place - picture[pixel].Place));
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
PlaceComparison ComparePlaces(
  const PlacePicture& truth, const PlacePicture& other, const PixelCamera& camera)
{
  PlaceComparison result;
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    result.Covered += truth[i].Covered;
    result.Coverage += truth[i].Covered != other[i].Covered;
    if (truth[i].Covered && other[i].Covered)
    {
      const double error = glm::length(truth[i].Place - other[i].Place);
      errors.push_back(error / GetFootprint(truth, camera, i));
      result.Place += errors.back() > PlaceComparison::AcceptedPixels;
    }
  }
  if (!errors.empty())
  {
    const auto at = static_cast<std::size_t>(PlaceComparison::Part * (errors.size() - 1.0));
    std::nth_element(
      errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(at), errors.end());
    result.Error = errors[at];
  }
  return result;
}

}
