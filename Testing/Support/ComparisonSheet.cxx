// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ComparisonSheet.h"

#include "vtkPNGWriter.h"

namespace meniscus::test
{
namespace
{

// Levels of colours; files are a third smaller with fewer of them.
constexpr int Step = 5;
constexpr glm::dvec3 Nothing{ 0.91, 0.925, 0.94 };
constexpr glm::dvec3 White{ 1.0 };
constexpr glm::dvec3 OneOnly{ 0.9, 0.0, 0.0 };

glm::dvec3 GetDifference(
  const PlacePixel& drawn, const PlacePicture& traced, const PixelCamera& camera, std::size_t pixel)
{
  if (drawn.Covered != traced[pixel].Covered)
  {
    return OneOnly;
  }
  if (!drawn.Covered)
  {
    return White;
  }
  const double error = glm::length(drawn.Place - traced[pixel].Place);
  const double footprint = GetFootprint(traced, camera, pixel);
  return glm::dvec3(1.0 - error / (PlaceComparison::AcceptedPixels * footprint));
}

}

//------------------------------------------------------------------------------
ComparisonSheet::ComparisonSheet(int rows, int columns, int side)
  : Rows(rows)
  , Side(side)
  , Image(vtkSmartPointer<vtkImageData>::New())
{
  const int width = columns * (side + Gap) - Gap;
  const int height = rows * (side + Gap) - Gap;
  this->Image->SetDimensions(width, height, 1);
  this->Image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memset(this->Image->GetScalarPointer(), 255, 3 * static_cast<std::size_t>(width * height));
}

//------------------------------------------------------------------------------
void ComparisonSheet::SetPixel(int row, int column, int x, int y, const glm::dvec3& colour)
{
  auto* pixel = static_cast<unsigned char*>(this->Image->GetScalarPointer(
    column * (this->Side + Gap) + x, (this->Rows - 1 - row) * (this->Side + Gap) + y, 0));
  for (int c = 0; c < 3; ++c)
  {
    const auto level = std::lround(255.0 / Step * std::clamp(colour[c], 0.0, 1.0));
    pixel[c] = static_cast<unsigned char>(Step * level);
  }
}

//------------------------------------------------------------------------------
void ComparisonSheet::Write(const std::string& path) const
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetCompressionLevel(9);
  writer->SetInputData(this->Image);
  writer->Write();
}

//------------------------------------------------------------------------------
glm::dvec3 GetColour(const PlacePixel& pixel, const PlaceColour& colour)
{
  return pixel.Covered ? colour(pixel.Place) : Nothing;
}

//------------------------------------------------------------------------------
PlaceComparison AddComparison(ComparisonSheet& sheet, int row, const std::string& name,
  const PixelCamera& camera, const PlacePicture& drawn, const PlacePicture& traced,
  const PlaceColour& colour)
{
  const int part = camera.GetPixels() / sheet.GetSide();
  for (const auto& [y, x] : Product(sheet.GetSide(), sheet.GetSide()))
  {
    glm::dvec3 ours(0.0);
    glm::dvec3 truth(0.0);
    glm::dvec3 difference(1.0);
    for (int k = 0; k < part * part; ++k)
    {
      const auto i =
        static_cast<std::size_t>((y * part + k / part) * camera.GetPixels() + x * part + k % part);
      ours += GetColour(drawn[i], colour) / static_cast<double>(part * part);
      truth += GetColour(traced[i], colour) / static_cast<double>(part * part);
      difference = glm::min(difference, GetDifference(drawn[i], traced, camera, i));
    }
    sheet.SetPixel(row, 0, x, y, ours);
    sheet.SetPixel(row, 1, x, y, truth);
    sheet.SetPixel(row, 2, x, y, difference);
  }
  const PlaceComparison compared = ComparePlaces(traced, drawn, camera);
  std::printf("%s: %d pixels, %d differ in coverage, %d in place\n", name.c_str(), compared.Covered,
    compared.Coverage, compared.Place);
  return compared;
}

}
