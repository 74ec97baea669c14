// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pictures of refracted scenes against POV-Ray's pictures of the same scenes.
 */
#include "PictureComparison.h"
#include "PovrayProcess.h"
#include "RefractedScene.h"
#include "StrictImage.h"

#include <vtksys/SystemTools.hxx>

#include <chrono>

using namespace meniscus::test;

namespace
{

const char* const Usage =
  "usage: meniscus_compare_povray [options]\n"
  "\n"
  "  --output FOLDER     pictures, scenes and reports go there (default: povray)\n"
  "  --scene TEXT        only scenes whose names contain the text\n"
  "  --pixels N          width and height of the pictures (default 512)\n"
  "  --tolerance ANGLE   AngularTolerance of the filter in degrees (default 0.001)\n"
  "  --povray PROGRAM    POV-Ray 3.7 (default: povray)\n"
  "  --help              this text\n"
  "\n"
  "Per scene: NAME.pov, NAME.ini, NAME-povray.png (3 x 3 samples a pixel), NAME-reference.png "
  "(the\n"
  "middle ones), NAME-meniscus.png, NAME-difference.png (times 32); report.md and report.json. "
  "The\n"
  "exit status is 0 if no scene is beyond its limit. Needs a display.\n";

struct Options
{
  std::string Output = "povray";
  std::string Scene;
  std::string Povray = "povray";
  int Pixels = 512;
  double Tolerance = 0.001;
};

struct Row
{
  std::string Name;
  std::string Problem; ///< nothing was compared
  PictureComparison Comparison;
  int Unexplained = 0; ///< different pixels that no displaced edge explains
  double Offset = 0.0; ///< pixels that an edge may be off
  double Limit = 0.0;  ///< different pixels
  double Seconds = 0.0;
  double PovraySeconds = 0.0;

  bool IsGood() const
  {
    return this->Problem.empty() && this->Unexplained == 0 &&
      this->Comparison.Different.size() <= this->Limit;
  }
};

//------------------------------------------------------------------------------
bool ReadOption(const std::string& key, const std::string& value, Options& options)
{
  if (key == "--pixels")
  {
    options.Pixels = std::atoi(value.c_str());
    return options.Pixels >= 16 && options.Pixels <= 8192;
  }
  if (key == "--tolerance")
  {
    options.Tolerance = std::atof(value.c_str());
    return options.Tolerance >= 1e-8 && options.Tolerance <= 10.0; // the filter's range
  }
  std::string* const text = key == "--output" ? &options.Output
    : key == "--scene"                        ? &options.Scene
    : key == "--povray"                       ? &options.Povray
                                              : nullptr;
  if (text)
  {
    *text = value;
  }
  return text && !value.empty();
}

//------------------------------------------------------------------------------
/** Runs the work and returns its seconds by the clock. */
template <typename Work>
double SecondsOf(Work&& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

//------------------------------------------------------------------------------
/**
 * How far an edge may be off, in pixels. Meniscus: the filter's angle, at the middle of the
 * picture, where a pixel is largest; positions on the screen, which OpenGL may round to 1/16 of a
 * pixel and Mesa rounds to 1/256 in x and y, half of that each. POV-Ray keeps the vertices of a
 * mesh in single precision: 6e-8 of a coordinate, nothing to be seen here.
 */
double LargestOffset(const ComparisonScene& scene, const Options& options)
{
  const double width = 2.0 * std::tan(scene.Camera.ViewAngle * std::acos(-1.0) / 360.0);
  const double pixel = width / options.Pixels;
  const double angle = scene.Surface.Membrane ? options.Tolerance * std::acos(-1.0) / 180.0 : 0.0;
  return angle / pixel + std::sqrt(2.0) * 0.5 / 256.0;
}

//------------------------------------------------------------------------------
/**
 * Different pixels that no displaced edge explains, after POV-Ray's close-ups of the pixels'
 * middles. An edge is off by much less than the quarter of a pixel that they reach, a fold, where
 * two images meet, by the root of a number of that size. A picture with more than `mostCloseUps`
 * different pixels is wrong as it is.
 */
int CountUnexplained(const ComparisonScene& scene, const ByteImage& drawn,
  const std::vector<PixelPlace>& places, const PovrayProcess& povray)
{
  constexpr std::size_t mostCloseUps = 200;
  constexpr double width = 0.5; // pixels
  constexpr int samples = 64;
  if (places.size() > mostCloseUps)
  {
    return static_cast<int>(places.size());
  }
  int result = 0;
  for (const PixelPlace& place : places)
  {
    const PictureWindow window{ (place.X + 0.5) / drawn.Width - 0.5,
      (place.Y + 0.5) / drawn.Height - 0.5, width / drawn.Width };
    const ByteImage closeUp = povray.Draw(scene, "close-up", samples, window);
    const unsigned char* const color = drawn.GetPixel(place.X, place.Y);
    if (!IsExplained(color, closeUp, FindObjectColors(scene, color)))
    {
      ++result;
      std::cout << scene.Name << ": nothing explains pixel " << place.X << ' ' << place.Y << '\n';
    }
  }
  return result;
}

//------------------------------------------------------------------------------
/** Pixels that the wrong outline of the membrane may change. */
double OutlinePixels(const ComparisonScene& scene, const Options& options)
{
  const double width = 2.0 * std::tan(scene.Camera.ViewAngle * std::acos(-1.0) / 360.0);
  const double pixel = glm::length(scene.Camera.Target - scene.Camera.Eye) * width / options.Pixels;
  return scene.Surface.OutlineArea / (pixel * pixel);
}

//------------------------------------------------------------------------------
Row CompareScene(const ComparisonScene& scene, const Options& options)
{
  Row row;
  row.Name = scene.Name;
  const PovrayProcess povray{ options.Povray, options.Output };
  ByteImage drawn;
  ByteImage reference;
  row.Seconds =
    SecondsOf([&]() { drawn = DrawRefractedScene(scene, options.Pixels, options.Tolerance); });
  row.PovraySeconds =
    SecondsOf([&]() { reference = povray.Draw(scene, scene.Name, options.Pixels); });
  const std::string path = options.Output + "/" + scene.Name;
  WritePng(drawn, path + "-meniscus.png");
  const StrictDifference difference =
    CompareStrictly(drawn, reference, PictureComparison::Threshold);
  if (!difference.SameSize)
  {
    row.Problem = options.Povray + " drew nothing, see " + path + ".log";
    return row;
  }
  WritePng(difference.Image, path + "-difference.png");
  row.Comparison = ComparePictures(drawn, reference);
  row.Unexplained = CountUnexplained(scene, drawn, row.Comparison.Different, povray);
  row.Offset = LargestOffset(scene, options);
  row.Limit = LargestDifference(row.Comparison, row.Offset, OutlinePixels(scene, options));
  return row;
}

std::string Percent(double part, double whole)
{
  std::ostringstream out;
  out << std::fixed << std::setprecision(4) << 100.0 * part / whole << " %";
  return out.str();
}

//------------------------------------------------------------------------------
std::string MakeTable(const std::vector<Row>& rows)
{
  std::ostringstream out;
  out << "| scene | pixels off | of all | limit | off edges | unexplained | edge pixels | "
         "Meniscus, s | POV-Ray, s "
         "| |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows)
  {
    const PictureComparison& c = row.Comparison;
    out << "| " << row.Name << " | ";
    if (!row.Problem.empty())
    {
      out << row.Problem << " | | | | | | | | FAILED |\n";
      continue;
    }
    out << c.Different.size() << " | " << Percent(c.Different.size(), c.Pixels) << " | "
        << Percent(row.Limit, c.Pixels) << " | " << c.DifferentOffEdges << " | " << row.Unexplained
        << " | " << Percent(c.EdgePixels, c.Pixels) << " | " << std::setprecision(3) << row.Seconds
        << " | " << row.PovraySeconds << " | " << (row.IsGood() ? "good" : "FAILED") << " |\n";
  }
  return out.str();
}

//------------------------------------------------------------------------------
std::string MakeJson(const std::vector<Row>& rows, const Options& options)
{
  std::ostringstream out;
  out << std::setprecision(8)
      << "{\n  \"program\": \"meniscus_compare_povray\",\n  \"pixels\": " << options.Pixels
      << ",\n  \"tolerance\": " << options.Tolerance
      << ",\n  \"threshold\": " << PictureComparison::Threshold << ",\n  \"scenes\": [";
  const char* separator = "\n";
  for (const Row& row : rows)
  {
    const PictureComparison& c = row.Comparison;
    out << separator << "    { \"name\": \"" << row.Name
        << "\", \"compared\": " << (row.Problem.empty() ? "true" : "false")
        << ", \"good\": " << (row.IsGood() ? "true" : "false")
        << ", \"different\": " << c.Different.size() << ", \"fraction\": " << c.GetFraction()
        << ", \"differentOffEdges\": " << c.DifferentOffEdges
        << ", \"fractionOffEdges\": " << c.FractionOffEdges()
        << ", \"unexplained\": " << row.Unexplained << ", \"edgePixels\": " << c.EdgePixels
        << ", \"edgeLength\": " << c.EdgeLength << ", \"largestOffset\": " << row.Offset
        << ", \"limit\": " << row.Limit << ", \"seconds\": " << row.Seconds
        << ", \"povraySeconds\": " << row.PovraySeconds << " }";
    separator = ",\n";
  }
  out << "\n  ]\n}\n";
  return out.str();
}

bool WriteReport(const std::string& path, const std::string& text)
{
  std::ofstream file(path);
  if (!(file << text).flush())
  {
    std::cerr << "cannot write " << path << '\n';
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
int CompareScenes(const Options& options)
{
  const DisplayHold hold;
  std::vector<Row> rows;
  bool isGood = true;
  for (const ComparisonScene& scene : MakeComparisonScenes())
  {
    if (scene.Name.find(options.Scene) != std::string::npos)
    {
      rows.push_back(CompareScene(scene, options));
      isGood = isGood && rows.back().IsGood();
    }
  }
  if (rows.empty())
  {
    std::cerr << "no scene of that name\n";
    return EXIT_FAILURE;
  }
  const std::string table = MakeTable(rows);
  std::cout << table;
  const bool isWritten = WriteReport(options.Output + "/report.md", table) &&
    WriteReport(options.Output + "/report.json", MakeJson(rows, options));
  return isGood && isWritten ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc; i += 2)
  {
    const std::string key = argv[i];
    if (key == "--help" || key == "-h")
    {
      std::cout << Usage;
      return EXIT_SUCCESS;
    }
    if (i + 1 >= argc || !ReadOption(key, argv[i + 1], options))
    {
      std::cerr << "unknown option, or bad or missing value: " << key << '\n' << Usage;
      return EXIT_FAILURE;
    }
  }
  if (!HasDisplay())
  {
    std::cerr << "no display: run under xvfb-run\n";
    return EXIT_FAILURE;
  }
  if (!vtksys::SystemTools::MakeDirectory(options.Output))
  {
    std::cerr << "cannot make the folder " << options.Output << '\n';
    return EXIT_FAILURE;
  }
  return CompareScenes(options);
}
