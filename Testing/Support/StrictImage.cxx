// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StrictImage.h"

#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtksys/SystemTools.hxx>

namespace meniscus::test
{

//------------------------------------------------------------------------------
StrictDifference CompareStrictly(const ByteImage& a, const ByteImage& b, int threshold)
{
  constexpr int visible = 32;
  StrictDifference result;
  result.SameSize = a.Width == b.Width && a.Height == b.Height && a.Rgb.size() == b.Rgb.size();
  if (!result.SameSize)
  {
    result.Largest = 255;
    result.PixelsBeyond = std::max(a.Rgb.size(), b.Rgb.size()) / 3;
    return result;
  }
  result.Image = a;
  for (std::size_t i = 0; i < a.Rgb.size(); i += 3)
  {
    int pixel = 0;
    for (std::size_t c = i; c < i + 3; ++c)
    {
      const int difference = std::abs(int(a.Rgb[c]) - int(b.Rgb[c]));
      pixel = std::max(pixel, difference);
      result.Image.Rgb[c] = static_cast<unsigned char>(std::min(255, visible * difference));
    }
    result.Largest = std::max(result.Largest, pixel);
    result.PixelsBeyond += pixel > threshold;
  }
  return result;
}

//------------------------------------------------------------------------------
ByteImage ReadPng(const std::string& path)
{
  ByteImage image;
  if (!vtksys::SystemTools::FileExists(path))
  {
    return image;
  }
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  const int* size = data->GetDimensions();
  if (data->GetScalarType() != VTK_UNSIGNED_CHAR || data->GetNumberOfScalarComponents() != 3)
  {
    return image;
  }
  image.Width = size[0];
  image.Height = size[1];
  const auto* pixels = static_cast<const unsigned char*>(data->GetScalarPointer());
  image.Rgb.assign(pixels, pixels + 3 * static_cast<std::size_t>(size[0]) * size[1]);
  return image;
}

//------------------------------------------------------------------------------
void WritePng(const ByteImage& image, const std::string& path)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.Width, image.Height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::copy(
    image.Rgb.begin(), image.Rgb.end(), static_cast<unsigned char*>(data->GetScalarPointer()));
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->Write();
}

namespace
{

bool IsWithin(const StrictDifference& difference)
{
  return difference.SameSize && difference.PixelsBeyond == 0;
}

} // anonymous namespace

//------------------------------------------------------------------------------
BaselineResult CompareToBaseline(
  const ByteImage& image, const std::string& name, int threshold, const std::string& folder)
{
  const std::string baseline = (folder.empty() ? MENISCUS_BASELINE_DIR : folder) + "/" + name;
  const StrictDifference difference = CompareStrictly(image, ReadPng(baseline + ".png"), threshold);
  BaselineResult result;
  result.Passed = IsWithin(difference);
  for (int i = 1; !result.Passed; ++i)
  {
    const ByteImage alternate = ReadPng(baseline + "_" + std::to_string(i) + ".png");
    if (alternate.Rgb.empty())
    {
      break;
    }
    result.Passed = IsWithin(CompareStrictly(image, alternate, threshold));
  }
  if (result.Passed)
  {
    return result;
  }
  const std::string output = MENISCUS_TEMPORARY_DIR;
  vtksys::SystemTools::MakeDirectory(output);
  WritePng(image, output + "/" + name + ".png");
  std::ostringstream message;
  if (difference.SameSize)
  {
    WritePng(difference.Image, output + "/" + name + "-difference.png");
    message << difference.PixelsBeyond << " pixels of " << name << " differ by more than "
            << threshold << " of 255 (largest " << difference.Largest << ")";
  }
  else
  {
    message << "no baseline of the size " << image.Width << " x " << image.Height << " for "
            << name;
  }
  message << "; see " << output << "/" << name << "*.png";
  result.Message = message.str();
  return result;
}

} // namespace meniscus::test
