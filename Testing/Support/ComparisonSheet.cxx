// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ComparisonSheet.h"

#include "vtkPNGWriter.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"

namespace meniscus::test
{
namespace
{

// Levels of colours; files are a third smaller with fewer of them.
constexpr int Step = 5;
constexpr int FrameLevel = 200;
constexpr int TextSize = 17;
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
ComparisonSheet::ComparisonSheet(
  const std::vector<std::string>& rows, const std::vector<std::string>& columns, int side)
  : Rows(static_cast<int>(rows.size()))
  , Side(side)
  , Image(vtkSmartPointer<vtkImageData>::New())
{
  const int width = this->GetLeft(static_cast<int>(columns.size()));
  const int height = this->GetBottom(-1) - Gap + Margin;
  this->Image->SetDimensions(width, height, 1);
  this->Image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memset(this->Image->GetScalarPointer(), 255, 3 * static_cast<std::size_t>(width * height));
  for (int row = 0; row < this->Rows; ++row)
  {
    this->DrawText(
      rows[static_cast<std::size_t>(row)], Margin / 2, this->GetBottom(row) + side / 2, true);
    for (int column = 0; column < static_cast<int>(columns.size()); ++column)
    {
      this->DrawFrame(row, column);
    }
  }
  for (std::size_t column = 0; column < columns.size(); ++column)
  {
    this->SetColumnTitle(static_cast<int>(column), columns[column]);
  }
}

//------------------------------------------------------------------------------
unsigned char* ComparisonSheet::GetPixel(int x, int y)
{
  return static_cast<unsigned char*>(this->Image->GetScalarPointer(x, y, 0));
}

//------------------------------------------------------------------------------
void ComparisonSheet::DrawFrame(int row, int column)
{
  const int left = this->GetLeft(column) - 1;
  const int bottom = this->GetBottom(row) - 1;
  for (int i = 0; i < this->Side + 2; ++i)
  {
    std::memset(this->GetPixel(left + i, bottom), FrameLevel, 3);
    std::memset(this->GetPixel(left + i, bottom + this->Side + 1), FrameLevel, 3);
    std::memset(this->GetPixel(left, bottom + i), FrameLevel, 3);
    std::memset(this->GetPixel(left + this->Side + 1, bottom + i), FrameLevel, 3);
  }
}

//------------------------------------------------------------------------------
void ComparisonSheet::SetColumnTitle(int column, const std::string& title)
{
  const int top = this->GetBottom(-1) - Gap;
  this->DrawText(title, this->GetLeft(column) + this->Side / 2, top + Margin / 2, false);
}

//------------------------------------------------------------------------------
void ComparisonSheet::DrawText(const std::string& text, int x, int y, bool upwards)
{
  if (text.empty())
  {
    return;
  }
  vtkNew<vtkTextProperty> letters;
  letters->SetFontSize(TextSize);
  letters->SetColor(0.0, 0.0, 0.0);
  letters->SetOrientation(upwards ? 90.0 : 0.0);
  vtkNew<vtkImageData> ink;
  int size[2];
  constexpr int dotsPerInch = 72;
  if (!vtkTextRenderer::GetInstance()->RenderString(letters, text, ink, size, dotsPerInch))
  {
    return;
  }
  for (const auto& [v, u] : Product(size[1], size[0]))
  {
    // The extent may start below zero.
    const auto* level = static_cast<const unsigned char*>(
      ink->GetScalarPointer(ink->GetExtent()[0] + u, ink->GetExtent()[2] + v, 0));
    const int place[2] = { x - size[0] / 2 + u, y - size[1] / 2 + v };
    const int* sheet = this->Image->GetDimensions();
    if (place[0] >= 0 && place[0] < sheet[0] && place[1] >= 0 && place[1] < sheet[1])
    {
      std::memset(this->GetPixel(place[0], place[1]), (255 - level[3]) / Step * Step, 3);
    }
  }
}

//------------------------------------------------------------------------------
void ComparisonSheet::SetPixel(int row, int column, int x, int y, const glm::dvec3& colour)
{
  auto* pixel = this->GetPixel(this->GetLeft(column) + x, this->GetBottom(row) + y);
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
ComparisonSheet MakeSceneSheet(std::size_t scenes, int side)
{
  return ComparisonSheet(
    { "virtual geometry", "traced rays", "difference" }, std::vector<std::string>(scenes), side);
}

//------------------------------------------------------------------------------
PlaceComparison AddComparison(ComparisonSheet& sheet, int column, const std::string& name,
  const PixelCamera& camera, const PlacePicture& drawn, const PlacePicture& traced,
  const PlaceColour& colour)
{
  sheet.SetColumnTitle(column, name);
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
    sheet.SetPixel(0, column, x, y, ours);
    sheet.SetPixel(1, column, x, y, truth);
    sheet.SetPixel(2, column, x, y, difference);
  }
  const PlaceComparison compared = ComparePlaces(traced, drawn, camera);
  std::printf("%s: %d pixels, %d differ in coverage, %d in place\n", name.c_str(), compared.Covered,
    compared.Coverage, compared.Place);
  return compared;
}

}
