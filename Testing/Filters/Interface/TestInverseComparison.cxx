// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Depth images of a board and a ring behind refracting surfaces, turned back into true positions,
// next to the places that were traced in double precision. Writes the figure of the page on undoing
// refraction.
#include "BoardScene.h"
#include "StackPicture.h"

#include "vtkDepthImagePoints.h"
#include "vtkTruePositionFilter.h"

namespace
{

using namespace meniscus::test;
using namespace meniscus::reference;

constexpr int Pixels = 512;
constexpr int Side = Pixels / 2;
constexpr double Glass = 1.5;
constexpr double Water = 1.333;
constexpr double BoardSize = 120.0;

// A board with a ring that leans on it.
BoardScene MakeObject()
{
  return { MakeBoard(-100.0, BoardSize),
    Ring{ { 12.0, -68.0, -6.0 }, glm::normalize(glm::dvec3(0.5, 0.6, 0.6)), 26.0, 8.0 } };
}

// A view, the paths of its rays, and the indices along them.
struct InverseScene
{
  StackPicture View;
  std::vector<ExactSurface> Surfaces;
  std::function<std::optional<ExactPath>(const glm::dvec3& direction)> Trace;
};

// The place that a pixel sees, and the one where it is seen.
struct SeenPixel
{
  PlacePixel Truth;
  glm::dvec3 Virtual;
};

std::vector<SeenPixel> TraceSeen(const InverseScene& scene, vtkPolyData* object)
{
  const PlaceTracer tracer = MakeMeshTracer(object);
  std::vector<SeenPixel> seen(static_cast<std::size_t>(Pixels) * Pixels);
  for (int i = 0; i < Pixels * Pixels; ++i)
  {
    SeenPixel& pixel = seen[static_cast<std::size_t>(i)];
    const auto path = scene.Trace(scene.View.Camera.GetRay(i % Pixels, i / Pixels));
    if (path)
    {
      pixel.Truth = tracer(path->Points.back(), path->Directions.back());
      const double length = glm::length(pixel.Truth.Place - path->Points.back());
      pixel.Virtual = MakeImage(scene.Surfaces, *path, length).Virtual;
    }
  }
  return seen;
}

// Distances from the eye; 0 for pixels that show nothing.
vtkSmartPointer<vtkImageData> MakeDepthImage(
  const std::vector<SeenPixel>& seen, const glm::dvec3& eye)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(Pixels, Pixels, 1);
  image->AllocateScalars(VTK_DOUBLE, 1);
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    image->GetPointData()->GetScalars()->SetTuple1(
      static_cast<vtkIdType>(i), seen[i].Truth.Covered ? glm::length(seen[i].Virtual - eye) : 0.0);
  }
  return image;
}

vtkSmartPointer<vtkCamera> MakeCamera(const PixelCamera& camera)
{
  auto result = vtkSmartPointer<vtkCamera>::New();
  const glm::dvec3& eye = camera.GetEye();
  const glm::dvec3 target = eye + 100.0 * camera.GetForward();
  result->SetPosition(eye.x, eye.y, eye.z);
  result->SetFocalPoint(target.x, target.y, target.z);
  result->SetViewUp(camera.GetUp().x, camera.GetUp().y, camera.GetUp().z);
  const double degrees = 180.0 / std::acos(-1.0);
  result->SetViewAngle(2.0 * degrees * std::atan(glm::length(camera.GetUp())));
  return result;
}

vtkSmartPointer<vtkTruePositionFilter> MakeInverse(const StackPicture& view)
{
  auto filter = vtkSmartPointer<vtkTruePositionFilter>::New();
  const glm::dvec3& eye = view.Camera.GetEye();
  filter->SetEyePosition(eye.x, eye.y, eye.z);
  view.SetInterfaces(filter.Get());
  return filter;
}

// True positions of the pixels of a depth image.
PlacePicture FindPlaces(const InverseScene& scene, vtkImageData* depths)
{
  vtkNew<vtkDepthImagePoints> points;
  points->SetInputData(depths);
  points->SetCamera(MakeCamera(scene.View.Camera));
  points->SetDepthTypeToRange();
  const auto inverse = MakeInverse(scene.View);
  inverse->SetInputConnection(points->GetOutputPort());
  inverse->Update();
  vtkPointSet* output = inverse->GetOutput();
  PlacePicture picture(static_cast<std::size_t>(Pixels) * Pixels);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(output->GetPointData()->GetArray("SeenState")->GetTuple1(i), 1.0);
    PlacePixel& pixel =
      picture[static_cast<std::size_t>(output->GetPointData()->GetArray("PixelId")->GetTuple1(i))];
    pixel.Covered = true;
    output->GetPoint(i, &pixel.Place.x);
  }
  return picture;
}

// Largest distance between places and their images by the filter, moved back.
double MeasureRoundTrip(const StackPicture& view, const PlacePicture& places)
{
  std::vector<Point> points;
  for (const PlacePixel& pixel : places)
  {
    if (pixel.Covered)
    {
      points.push_back({ pixel.Place.x, pixel.Place.y, pixel.Place.z });
    }
  }
  const auto forward = view.MakeFilter(MakePoints(points), false);
  const auto inverse = MakeInverse(view);
  inverse->SetInputConnection(forward->GetOutputPort());
  inverse->Update();
  vtkPointSet* output = inverse->GetOutput();
  // Places next to the border of a surface may be seen through its exact form only.
  EXPECT_GT(output->GetNumberOfPoints(), static_cast<vtkIdType>(points.size() * 999 / 1000));
  vtkDataArray* sources = output->GetPointData()->GetArray("SourcePointId");
  double largest = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const Point& truth = points[static_cast<std::size_t>(sources->GetTuple1(i))];
    glm::dvec3 found(0.0);
    output->GetPoint(i, &found.x);
    largest = std::max(largest, glm::length(found - glm::dvec3(truth[0], truth[1], truth[2])));
  }
  return largest;
}

//------------------------------------------------------------------------------
// Points from above, each as a dot of the colour that the picture has of it; the highest one shows.
void ShowFromAbove(ComparisonSheet& sheet, int row, int column, const PlacePicture& places,
  const std::vector<glm::dvec3>& colours)
{
  constexpr double half = 0.55 * BoardSize;
  std::vector<double> heights(static_cast<std::size_t>(Side) * Side, -1e300);
  for (int i = 0; i < Side * Side; ++i)
  {
    sheet.SetPixel(row, column, i % Side, i / Side, glm::dvec3(0.91, 0.925, 0.94));
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double x = 0.5 * Side * (1.0 - places[i].Place.x / half);
    const double y = 0.5 * Side * (1.0 + places[i].Place.z / half);
    if (places[i].Covered && x >= 0.0 && x < Side && y >= 0.0 && y < Side)
    {
      double& height = heights[static_cast<std::size_t>(y) * Side + static_cast<std::size_t>(x)];
      if (places[i].Place.y > height)
      {
        height = places[i].Place.y;
        sheet.SetPixel(row, column, static_cast<int>(x), static_cast<int>(y), colours[i]);
      }
    }
  }
}

// Errors from white, 1e-15, to black, 1e-3; the largest of several pixels.
void ShowErrors(
  ComparisonSheet& sheet, int row, int column, const PlacePicture& truth, const PlacePicture& found)
{
  constexpr int part = Pixels / Side;
  for (int i = 0; i < Side * Side; ++i)
  {
    double largest = 0.0;
    for (int k = 0; k < part * part; ++k)
    {
      const auto at = static_cast<std::size_t>(
        (i / Side * part + k / part) * Pixels + i % Side * part + k % part);
      largest =
        std::max(largest, truth[at].Covered ? glm::length(truth[at].Place - found[at].Place) : 0.0);
    }
    const double shade = (std::log10(std::max(largest, 1e-15)) + 15.0) / 12.0;
    sheet.SetPixel(row, column, i % Side, i / Side, glm::dvec3(1.0 - shade));
  }
}

void ShowPicture(
  ComparisonSheet& sheet, int row, int column, const std::vector<glm::dvec3>& colours)
{
  constexpr int part = Pixels / Side;
  for (int i = 0; i < Side * Side; ++i)
  {
    glm::dvec3 sum(0.0);
    for (int k = 0; k < part * part; ++k)
    {
      sum += colours[static_cast<std::size_t>(
        (i / Side * part + k / part) * Pixels + i % Side * part + k % part)];
    }
    sheet.SetPixel(row, column, i % Side, i / Side, sum / static_cast<double>(part * part));
  }
}

// Returns the largest error of the positions found.
double ExpectWayBack(ComparisonSheet& sheet, int row, const InverseScene& scene)
{
  const BoardScene object = MakeObject();
  const auto seen = TraceSeen(scene, object.MakeData());
  const PlacePicture found = FindPlaces(scene, MakeDepthImage(seen, scene.View.Camera.GetEye()));
  PlacePicture truth;
  std::vector<glm::dvec3> colours;
  double largest = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    truth.push_back(seen[i].Truth);
    colours.push_back(
      GetColour(truth[i], [&object](const glm::dvec3& place) { return object.GetColour(place); }));
    EXPECT_EQ(truth[i].Covered, found[i].Covered);
    largest =
      std::max(largest, truth[i].Covered ? glm::length(truth[i].Place - found[i].Place) : 0.0);
  }
  ShowPicture(sheet, row, 0, colours);
  ShowFromAbove(sheet, row, 1, found, colours);
  ShowFromAbove(sheet, row, 2, truth, colours);
  ShowErrors(sheet, row, 3, truth, found);
  const PlaceComparison compared = ComparePlaces(truth, found, scene.View.Camera);
  const double around = MeasureRoundTrip(scene.View, truth);
  std::printf("%s: %d pixels, largest error %.1e, there and back %.1e, %d off by half a pixel\n",
    scene.View.Name.c_str(), compared.Covered, largest, around, compared.Place);
  EXPECT_GT(compared.Covered, Pixels * Pixels / 20);
  EXPECT_EQ(compared.Place, 0);
  EXPECT_LT(around, 1e-9);
  return largest;
}

InverseScene MakeExactScene(const StackPicture& view, const std::vector<ExactSurface>& surfaces)
{
  return { view, surfaces, [surfaces, eye = view.Camera.GetEye()](const glm::dvec3& direction) {
            return meniscus::reference::TraceExactly(surfaces, eye, direction);
          } };
}

}

//------------------------------------------------------------------------------
// Planes and spheres are exact, so that only rounding of numbers up to 300 remains; behind waves,
// the error is that of their patches.
TEST(InverseComparison, DepthImagesBecomeTruePositions)
{
  ComparisonSheet sheet({ "pane", "dome port", "waves" },
    { "view", "positions found, from above", "traced, from above", "error" }, Side);
  const glm::dvec3 up(0.0, 1.0, 0.0);
  const PixelCamera above({ 60.0, 130.0, -170.0 }, { 0.0, -60.0, 0.0 }, 0.27, Pixels);
  const InverseScene pane =
    MakeExactScene({ "air, glass, water", { MakePlane(0.0, 800.0, 8), MakePlane(-20.0, 800.0, 8) },
                     { { 1.0, Glass }, { Glass, Water } }, above },
      { { 1.0, Glass, glm::dvec3(0.0), 0.0, up }, { Glass, Water, -20.0 * up, 0.0, up } });
  EXPECT_LT(ExpectWayBack(sheet, 0, pane), 1e-11);

  const glm::dvec3 eye(50.0, 70.0, -120.0);
  const glm::dvec3 centre = eye + glm::dvec3(3.0, -1.0, 4.0);
  const InverseScene port = MakeExactScene(
    { "dome port, eye off its centre",
      { MakeSphere(centre, 10.0, 4, true), MakeSphere(centre, 11.0, 4, true) },
      { { Glass, 1.0 }, { Water, Glass } }, { eye, { 0.0, -90.0, 0.0 }, 0.38, Pixels } },
    { { 1.0, Glass, centre, 10.0, glm::dvec3(0.0), true },
      { Glass, Water, centre, 11.0, glm::dvec3(0.0), true } });
  EXPECT_LT(ExpectWayBack(sheet, 1, port), 1e-11);

  const HeightField field{ HeightField::Shape::Waves, 400.0, 1.5, 0.02 * std::acos(-1.0), 1.0,
    Water };
  const InverseScene waves{ { "waves", { field.MakeMesh(200) }, { { 1.0, Water } }, above },
    { { 1.0, Water, glm::dvec3(0.0) } },
    [&](const glm::dvec3& direction) -> std::optional<ExactPath>
    {
      const auto leg = MakeFieldRays(field, above.GetEye())(direction);
      return leg ? std::optional<ExactPath>({ { leg->Start }, { direction, leg->Direction } })
                 : std::nullopt;
    } };
  ExpectWayBack(sheet, 2, waves);
  sheet.Write(MENISCUS_TEMPORARY_DIR "/inverse-comparison.png");
}
