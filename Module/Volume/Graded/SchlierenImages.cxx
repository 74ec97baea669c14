// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/SchlierenImages.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace meniscus
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/** Rows of the screen that are one piece of work. */
constexpr int RowsPerBand = 16;

/** A convex polygon: up to four corners, and one more for each of four half planes that cut it. */
struct Polygon
{
  std::array<glm::dvec2, 8> Corners;
  int Size = 0;

  /** Keeps the part in which sign * coordinate <= sign * limit. */
  Polygon Cut(int axis, double limit, double sign) const
  {
    Polygon result;
    for (int i = 0; i < this->Size; ++i)
    {
      const glm::dvec2& a = this->Corners[i];
      const glm::dvec2& b = this->Corners[(i + 1) % this->Size];
      const double atA = sign * (a[axis] - limit);
      const double atB = sign * (b[axis] - limit);
      if (atA <= 0.0)
      {
        result.Corners[result.Size++] = a;
      }
      if ((atA < 0.0 && atB > 0.0) || (atA > 0.0 && atB < 0.0))
      {
        glm::dvec2 place = a + atA / (atA - atB) * (b - a);
        place[axis] = limit;
        result.Corners[result.Size++] = place;
      }
    }
    return result;
  }
  double GetArea() const
  {
    double twice = 0.0;
    for (int i = 2; i < this->Size; ++i)
    {
      const glm::dvec2 a = this->Corners[i - 1] - this->Corners[0];
      const glm::dvec2 b = this->Corners[i] - this->Corners[0];
      twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(twice);
  }
  double GetLeast(int axis) const
  {
    double least = this->Corners[0][axis];
    for (int i = 1; i < this->Size; ++i)
    {
      least = std::min(least, this->Corners[i][axis]);
    }
    return least;
  }
  double GetMost(int axis) const
  {
    double most = this->Corners[0][axis];
    for (int i = 1; i < this->Size; ++i)
    {
      most = std::max(most, this->Corners[i][axis]);
    }
    return most;
  }
};

/** Corners of a quadrangle, one after the other around it. */
using Quadrangle = std::array<glm::dvec2, 4>;

/** Index of the pixel at a coordinate, in a range that one may be beyond on both sides. */
int PixelAt(double coordinate, int first, int last)
{
  return static_cast<int>(
    std::floor(std::min(std::max(coordinate + 0.5, first - 1.0), last + 1.0)));
}

/**
 * Cuts a polygon into slices one pixel wide across an axis, those in [first, last), and calls
 * body(slice, pixel) for each.
 */
template <typename Body>
void ForEachSlice(const Polygon& polygon, int axis, int first, int last, const Body& body)
{
  const int begin = PixelAt(polygon.GetLeast(axis), first, last);
  const int end = PixelAt(polygon.GetMost(axis), first, last);
  Polygon rest = begin < first ? polygon.Cut(axis, first - 0.5, -1.0) : polygon;
  for (int pixel = std::max(begin, first); pixel <= std::min(end, last - 1) && rest.Size > 2;
       ++pixel)
  {
    if (pixel == end)
    {
      body(rest, pixel);
      return;
    }
    const Polygon slice = rest.Cut(axis, pixel + 0.5, 1.0);
    if (slice.Size > 2)
    {
      body(slice, pixel);
    }
    rest = rest.Cut(axis, pixel + 0.5, -1.0);
  }
}

/** Band of rows of a screen, and the light that falls on it. */
class Band
{
public:
  Band(std::vector<double>& image, int width, int first, int last)
    : Image(image)
    , Width(width)
    , First(first)
    , Last(last)
  {
  }

  /** Spreads light evenly over a quadrangle; if it is not convex, over its two triangles. */
  void Add(const Quadrangle& corners, double light)
  {
    if (this->AddWhole(corners, light))
    {
      return;
    }
    if (IsConvex(corners))
    {
      this->AddPolygon({ { corners[0], corners[1], corners[2], corners[3] }, 4 }, light);
      return;
    }
    this->AddPolygon({ { corners[0], corners[1], corners[2] }, 3 }, 0.5 * light);
    this->AddPolygon({ { corners[0], corners[2], corners[3] }, 3 }, 0.5 * light);
  }

private:
  /** True if all corners turn to the same side. */
  static bool IsConvex(const Quadrangle& corners)
  {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const glm::dvec2 a = corners[(i + 1) % 4] - corners[i];
      const glm::dvec2 b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
      const double turn = a.x * b.y - a.y * b.x;
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    return least > 0.0 || most < 0.0;
  }
  void AddPolygon(const Polygon& polygon, double light)
  {
    const double area = polygon.GetArea();
    if (!(area > 0.0))
    {
      this->AddPoint((polygon.Corners[0] + polygon.Corners[1] + polygon.Corners[2]) / 3.0, light);
      return;
    }
    const double density = light / area;
    ForEachSlice(polygon, 1, this->First, this->Last,
      [this, density](const Polygon& strip, int row)
      {
        ForEachSlice(strip, 0, 0, this->Width,
          [this, density, row](const Polygon& part, int column)
          { this->At(column, row) += density * part.GetArea(); });
      });
  }
  /** Adds the light of a quadrangle in one pixel, with or without its border. */
  bool AddWhole(const Quadrangle& corners, double light)
  {
    const glm::dvec2 middle = glm::floor(0.5 * (corners[0] + corners[2]) + 0.5);
    for (const glm::dvec2& corner : corners)
    {
      if (!(std::max(std::abs(corner.x - middle.x), std::abs(corner.y - middle.y)) <= 0.5))
      {
        return false;
      }
    }
    if (middle.x >= 0.0 && middle.x < this->Width && middle.y >= this->First &&
      middle.y < this->Last)
    {
      this->At(static_cast<int>(middle.x), static_cast<int>(middle.y)) += light;
    }
    return true;
  }
  void AddPoint(const glm::dvec2& place, double light)
  {
    const int row = PixelAt(place.y, this->First, this->Last);
    const int column = PixelAt(place.x, 0, this->Width);
    if (row >= this->First && row < this->Last && column >= 0 && column < this->Width)
    {
      this->At(column, row) += light;
    }
  }
  double& At(int column, int row)
  {
    return this->Image[static_cast<std::size_t>(row) * static_cast<std::size_t>(this->Width) +
      static_cast<std::size_t>(column)];
  }

  std::vector<double>& Image;
  int Width;
  int First;
  int Last;
};

/** Landing points of the corners between pixels: (width + 1) * (height + 1). */
std::vector<glm::dvec2> FindCorners(const std::vector<glm::dvec2>& landings, int width, int height)
{
  std::vector<glm::dvec2> corners;
  corners.reserve(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1));
  for (int row = 0; row <= height; ++row)
  {
    for (int column = 0; column <= width; ++column)
    {
      glm::dvec2 sum(0.0);
      int count = 0;
      for (int k = 0; k < 4; ++k)
      {
        const int i = column - (k & 1);
        const int j = row - (k >> 1);
        if (i < 0 || j < 0 || i >= width || j >= height)
        {
          continue;
        }
        const glm::dvec2 landing =
          landings[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(i)];
        if (!std::isnan(landing.x))
        {
          sum += landing - glm::dvec2(i, j);
          ++count;
        }
      }
      corners.push_back(
        glm::dvec2(column - 0.5, row - 0.5) + sum / static_cast<double>(std::max(count, 1)));
    }
  }
  return corners;
}

/** Least and largest row on the screen that the light of each row of pixels reaches. */
std::vector<glm::dvec2> FindReaches(const std::vector<glm::dvec2>& corners, int width, int height)
{
  std::vector<glm::dvec2> reaches;
  const auto across = static_cast<std::size_t>(width + 1);
  for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row)
  {
    glm::dvec2 reach(corners[row * across].y);
    for (std::size_t i = row * across; i < (row + 2) * across; ++i)
    {
      reach.x = std::min(reach.x, corners[i].y);
      reach.y = std::max(reach.y, corners[i].y);
    }
    reaches.push_back(reach);
  }
  return reaches;
}

}

//------------------------------------------------------------------------------
void KnifeEdge::SetAngle(double degrees)
{
  const double angle = degrees * Pi / 180.0;
  this->Open = { std::cos(angle), std::sin(angle) };
}

//------------------------------------------------------------------------------
double KnifeEdge::Along(const glm::dvec2& deflection) const
{
  return glm::dot(deflection, this->Open);
}

//------------------------------------------------------------------------------
double KnifeEdge::Transmit(const glm::dvec2& deflection) const
{
  return std::min(1.0, std::max(0.0, 1.0 - this->CutOff + this->Along(deflection) / this->Range));
}

//------------------------------------------------------------------------------
double Interferometer::Interfere(double pathDifference, const glm::dvec2& place) const
{
  const double waves = pathDifference / this->Wavelength + glm::dot(this->Fringes, place);
  const double part = waves - std::floor(waves);
  return part == 0.0 ? 1.0 : 0.5 * (1.0 + std::cos(2.0 * Pi * part));
}

//------------------------------------------------------------------------------
std::vector<double> ComputeShadowgraph(const std::vector<glm::dvec2>& landings, int width,
  int height, const RangeLoop& loop, double& offScreen)
{
  const std::vector<glm::dvec2> corners = FindCorners(landings, width, height);
  const auto cornerAt = [&](int column, int row)
  {
    return corners[static_cast<std::size_t>(row) * static_cast<std::size_t>(width + 1) +
      static_cast<std::size_t>(column)];
  };
  std::vector<double> image(landings.size(), 0.0);
  const std::vector<glm::dvec2> reaches = FindReaches(corners, width, height);
  const auto fillRow = [&](int row, Band& band)
  {
    for (int column = 0; column < width; ++column)
    {
      const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
        static_cast<std::size_t>(column);
      if (!std::isnan(landings[pixel].x))
      {
        band.Add({ cornerAt(column, row), cornerAt(column + 1, row), cornerAt(column + 1, row + 1),
                   cornerAt(column, row + 1) },
          1.0);
      }
    }
  };
  // Each band looks at all rows of quadrangles, in order: the result does not depend on the
  // threads.
  const int bands = (height + RowsPerBand - 1) / RowsPerBand;
  const auto fillBand = [&](int number)
  {
    const int first = number * RowsPerBand;
    const int last = std::min(height, first + RowsPerBand);
    Band band(image, width, first, last);
    for (int row = 0; row < height; ++row)
    {
      const glm::dvec2& reach = reaches[static_cast<std::size_t>(row)];
      if (reach.y >= first - 0.5 && reach.x <= last - 0.5)
      {
        fillRow(row, band);
      }
    }
  };
  loop(static_cast<std::size_t>(bands),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t number = begin; number < end; ++number)
      {
        fillBand(static_cast<int>(number));
      }
    });
  double landed = 0.0;
  offScreen = 0.0;
  for (std::size_t pixel = 0; pixel < landings.size(); ++pixel)
  {
    landed += image[pixel];
    offScreen += std::isnan(landings[pixel].x) ? 0.0 : 1.0;
  }
  offScreen -= landed;
  return image;
}

//------------------------------------------------------------------------------
double SamplePicture(
  const std::vector<float>& picture, int width, int height, const glm::dvec2& place)
{
  const double x = std::min(std::max(place.x, 0.0), width - 1.0);
  const double y = std::min(std::max(place.y, 0.0), height - 1.0);
  const int column = std::min(static_cast<int>(x), std::max(width - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(height - 2, 0));
  const auto at = [&](int i, int j)
  {
    return static_cast<double>(
      picture[static_cast<std::size_t>(std::min(j, height - 1)) * static_cast<std::size_t>(width) +
        static_cast<std::size_t>(std::min(i, width - 1))]);
  };
  const double u = x - column;
  const double v = y - row;
  return (1.0 - v) * ((1.0 - u) * at(column, row) + u * at(column + 1, row)) +
    v * ((1.0 - u) * at(column, row + 1) + u * at(column + 1, row + 1));
}

}
