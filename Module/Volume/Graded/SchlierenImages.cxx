// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Graded/SchlierenImages.h"

#include "Refraction/Membrane/CrossProduct.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace meniscus
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/**
 * cos^2(pi x) for x in [0, 1], as the square of sin(pi (x - 1/2)), by its series: the first term
 * left out is (pi / 2)^23 / 23! = 1e-18. std::cos takes longer.
 */
double SquaredCosine(double x)
{
  const double angle = Pi * (x - 0.5);
  const double square = angle * angle;
  double sum = 1.0;
  for (int k = 20; k > 0; k -= 2)
  {
    sum = 1.0 - square / static_cast<double>(k * (k + 1)) * sum;
  }
  return angle * sum * (angle * sum);
}

/** Rows of the screen that are one piece of work. */
constexpr int RowsPerBand = 16;

/** A convex polygon: up to four corners, and one more for each of four half planes that cut it. */
struct Polygon
{
  std::array<glm::dvec2, 8> Corners;
  int Size = 0;

  /** Rounding bends the sides of polygons that are huge: corners beyond the most are left out. */
  void Append(const glm::dvec2& corner)
  {
    if (this->Size < static_cast<int>(this->Corners.size()))
    {
      this->Corners[this->Size++] = corner;
    }
  }
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
        result.Append(a);
      }
      if ((atA < 0.0 && atB > 0.0) || (atA > 0.0 && atB < 0.0))
      {
        glm::dvec2 place = a + atA / (atA - atB) * (b - a);
        place[axis] = limit;
        result.Append(place);
      }
    }
    return result;
  }
  double GetArea() const
  {
    const auto placeOf = [this](std::size_t i) { return this->Corners[i]; };
    return 0.5 * std::abs(GetTwiceArea(static_cast<std::size_t>(this->Size), placeOf));
  }
  /** Least and largest coordinate along an axis. */
  std::pair<double, double> GetRange(int axis) const
  {
    const auto range =
      std::minmax_element(this->Corners.begin(), this->Corners.begin() + this->Size,
        [axis](const glm::dvec2& a, const glm::dvec2& b) { return a[axis] < b[axis]; });
    return { (*range.first)[axis], (*range.second)[axis] };
  }
};

/** Corners of a quadrangle, one after the other around it. */
using Quadrangle = std::array<glm::dvec2, 4>;

/** Place of a pixel or a corner in a list of rows. */
std::size_t IndexOf(int column, int row, int width)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
    static_cast<std::size_t>(column);
}

/** Cross products of the sides at each corner: positive where they turn to the left. */
std::array<double, 4> TurnsOf(const Quadrangle& corners)
{
  std::array<double, 4> turns;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    turns[i] =
      Cross(corners[(i + 1) % 4] - corners[i], corners[(i + 2) % 4] - corners[(i + 1) % 4]);
  }
  return turns;
}

/** True if all corners turn to the same side. */
bool IsConvex(const std::array<double, 4>& turns)
{
  return std::min(std::min(turns[0], turns[1]), std::min(turns[2], turns[3])) > 0.0 ||
    std::max(std::max(turns[0], turns[1]), std::max(turns[2], turns[3])) < 0.0;
}

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
  const std::pair<double, double> range = polygon.GetRange(axis);
  const int begin = PixelAt(range.first, first, last);
  const int end = PixelAt(range.second, first, last);
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

/**
 * Density of one pixel's light in a quadrangle; 0 if it has to be spread by itself. The sums of a
 * Band are off by the rounding of the largest densities, over rows of pixels: with this bound by
 * less than 2^-30 of the undisturbed light.
 */
double DensityOf(const Quadrangle& corners)
{
  constexpr double largest = 0x1p12;
  const std::array<double, 4> turns = TurnsOf(corners);
  // Two turns are twice the areas of the two triangles.
  const double density = 2.0 / (turns[0] + turns[2]);
  return IsConvex(turns) && std::abs(density) <= largest ? density : 0.0;
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
  if (pathDifference == 0.0 && this->Fringes == glm::dvec2(0.0))
  {
    return 1.0;
  }
  const double waves = pathDifference / this->Wavelength + glm::dot(this->Fringes, place);
  const double part = waves - std::floor(waves);
  return part == 0.0 ? 1.0 : SquaredCosine(part);
}

//------------------------------------------------------------------------------
/**
 * Band of rows of a screen, and the light that falls on it.
 *
 * Light that is even within polygons changes at their edges alone. Each pixel of Changes has how
 * much more light it has than its neighbour to the left, so that the edge between two quadrangles
 * is followed once, with the difference of their densities, and not at all if there is none.
 */
class Shadowgraph::Band
{
public:
  Band(std::vector<double>& image, int width, int first, int last)
    : Image(image)
    , Width(width)
    , First(first)
    , Last(last)
    , Changes(static_cast<std::size_t>(last - first) * static_cast<std::size_t>(width + 2), 0.0)
  {
  }

  /** Spreads light evenly over a quadrangle; if it is not convex, over its two triangles. */
  void Add(const Quadrangle& corners, double light)
  {
    if (IsConvex(TurnsOf(corners)))
    {
      this->AddPolygon({ { corners[0], corners[1], corners[2], corners[3] }, 4 }, light);
      return;
    }
    this->AddPolygon({ { corners[0], corners[1], corners[2] }, 3 }, 0.5 * light);
    this->AddPolygon({ { corners[0], corners[2], corners[3] }, 3 }, 0.5 * light);
  }

  /** Adds an edge with more light on its left side than on its right side by a density. */
  void AddEdge(const glm::dvec2& from, const glm::dvec2& to, double density)
  {
    // Pixels are between whole numbers.
    const glm::dvec2 begin = from + 0.5;
    const glm::dvec2 end = to + 0.5;
    const glm::dvec2 way = end - begin;
    const double low = std::max(std::min(begin.y, end.y), static_cast<double>(this->First));
    const double high = std::min(std::max(begin.y, end.y), static_cast<double>(this->Last));
    if (!(low < high))
    {
      return;
    }
    const double slope = way.x / way.y;
    // The light is on the right of an edge that goes down.
    const double change = way.y < 0.0 ? density : -density;
    double y = low;
    double x = begin.x + (y - begin.y) * slope;
    for (int row = static_cast<int>(low); y < high; ++row)
    {
      const double nextY = std::min(high, row + 1.0);
      const double nextX = begin.x + (nextY - begin.y) * slope;
      this->AddPiece(row, std::min(x, nextX), std::max(x, nextX), change * (nextY - y));
      y = nextY;
      x = nextX;
    }
  }

  /** Writes the sums of the changes to the image. */
  void Settle()
  {
    for (int row = this->First; row < this->Last; ++row)
    {
      const double* const changes = this->ChangesOf(row);
      double light = 0.0;
      for (int column = 0; column < this->Width; ++column)
      {
        light += changes[column];
        // Rounding may leave a little less than nothing.
        this->At(column, row) = std::max(light, 0.0);
      }
    }
  }

private:
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
  void AddPoint(const glm::dvec2& place, double light)
  {
    const int row = PixelAt(place.y, this->First, this->Last);
    const int column = PixelAt(place.x, 0, this->Width);
    if (row >= this->First && row < this->Last && column >= 0 && column < this->Width)
    {
      this->At(column, row) += light;
    }
  }
  /**
   * Adds a piece of an edge in one row.
   * @param left, right its ends.
   * @param change of the light across the whole piece.
   */
  void AddPiece(int row, double left, double right, double change)
  {
    double* const changes = this->ChangesOf(row);
    if (right <= 0.0)
    {
      changes[0] += change;
      return;
    }
    if (!(left < this->Width))
    {
      return;
    }
    const int first = static_cast<int>(std::max(left, 0.0));
    const int last = static_cast<int>(std::min(right, static_cast<double>(this->Width)));
    if (first == last && left >= 0.0)
    {
      const double beyond = change * (0.5 * (left + right) - first);
      changes[first] += change - beyond;
      changes[first + 1] += beyond;
      return;
    }
    const double perLength = change / (right - left);
    changes[0] += left < 0.0 ? -left * perLength : 0.0;
    double from = std::max(left, 0.0);
    for (int column = first; column <= last && column < this->Width; ++column)
    {
      const double to = std::min(right, column + 1.0);
      const double part = (to - from) * perLength;
      const double beyond = part * (0.5 * (from + to) - column);
      changes[column] += part - beyond;
      changes[column + 1] += beyond;
      from = to;
    }
  }
  double* ChangesOf(int row)
  {
    return this->Changes.data() + IndexOf(0, row - this->First, this->Width + 2);
  }
  double& At(int column, int row) { return this->Image[IndexOf(column, row, this->Width)]; }

  std::vector<double>& Image;
  int Width;
  int First;
  int Last;
  std::vector<double> Changes;
};

//------------------------------------------------------------------------------
/** Corner between pixels, as the mean of the landing points of the pixels around it. */
glm::dvec2 Shadowgraph::FindCorner(int column, int row) const
{
  glm::dvec2 sum(0.0);
  int count = 0;
  for (int k = 0; k < 4; ++k)
  {
    const int i = column - (k & 1);
    const int j = row - (k >> 1);
    if (i < 0 || j < 0 || i >= this->Width || j >= this->Height)
    {
      continue;
    }
    const glm::dvec2 landing = this->Landings[IndexOf(i, j, this->Width)];
    if (!std::isnan(landing.x))
    {
      sum += landing - glm::dvec2(i, j);
      ++count;
    }
  }
  return glm::dvec2(column - 0.5, row - 0.5) + sum / static_cast<double>(std::max(count, 1));
}

//------------------------------------------------------------------------------
void Shadowgraph::FindCorners(int row)
{
  glm::dvec2* const corners = &this->Corners[IndexOf(0, row, this->Width + 1)];
  for (int column = 0; column <= this->Width; ++column)
  {
    if (row > 0 && row < this->Height && column > 0 && column < this->Width)
    {
      // The mean of the pixels themselves is the corner.
      const glm::dvec2* const above = &this->Landings[IndexOf(column, row, this->Width)];
      const glm::dvec2* const below = above - this->Width;
      corners[column] = 0.25 * ((below[-1] + below[0]) + (above[-1] + above[0]));
      if (!std::isnan(corners[column].x))
      {
        continue;
      }
    }
    corners[column] = this->FindCorner(column, row);
  }
}

//------------------------------------------------------------------------------
void Shadowgraph::FindDensities(int row)
{
  std::vector<int>& alone = this->Alone[static_cast<std::size_t>(row)];
  alone.clear();
  for (int column = 0; column < this->Width; ++column)
  {
    const std::size_t pixel = IndexOf(column, row, this->Width);
    const bool isLit = !std::isnan(this->Landings[pixel].x);
    const double density = isLit ? DensityOf(this->GetQuadrangle(column, row)) : 0.0;
    this->Densities[pixel] = density;
    if (isLit && density == 0.0)
    {
      alone.push_back(column);
    }
  }
}

//------------------------------------------------------------------------------
void Shadowgraph::FindReach(int row)
{
  glm::dvec2 reach(this->CornerAt(0, row).y);
  for (int column = 0; column <= this->Width; ++column)
  {
    const double here = this->CornerAt(column, row).y;
    const double above = this->CornerAt(column, row + 1).y;
    reach.x = std::min(reach.x, std::min(here, above));
    reach.y = std::max(reach.y, std::max(here, above));
  }
  this->Reaches[static_cast<std::size_t>(row)] = reach;
}

//------------------------------------------------------------------------------
std::array<glm::dvec2, 4> Shadowgraph::GetQuadrangle(int column, int row) const
{
  return { this->CornerAt(column, row), this->CornerAt(column + 1, row),
    this->CornerAt(column + 1, row + 1), this->CornerAt(column, row + 1) };
}

//------------------------------------------------------------------------------
const glm::dvec2& Shadowgraph::CornerAt(int column, int row) const
{
  return this->Corners[IndexOf(column, row, this->Width + 1)];
}

//------------------------------------------------------------------------------
const double* Shadowgraph::DensitiesOf(int row) const
{
  return &this->Densities[IndexOf(0, row, this->Width)];
}

//------------------------------------------------------------------------------
/** Adds the light of a row of pixels, without the edges at its end, which the next one adds. */
void Shadowgraph::AddRow(int row, Band& band) const
{
  const double* const ofRow = row < this->Height ? this->DensitiesOf(row) : nullptr;
  const double* const ofRowBelow = row > 0 ? this->DensitiesOf(row - 1) : nullptr;
  double here = 0.0;
  for (int column = 0; column <= this->Width; ++column)
  {
    const double left = here;
    here = ofRow && column < this->Width ? ofRow[column] : 0.0;
    const double below = ofRowBelow && column < this->Width ? ofRowBelow[column] : 0.0;
    if (here != below)
    {
      band.AddEdge(this->CornerAt(column, row), this->CornerAt(column + 1, row), here - below);
    }
    if (left != here)
    {
      band.AddEdge(this->CornerAt(column, row), this->CornerAt(column, row + 1), left - here);
    }
  }
}

//------------------------------------------------------------------------------
/** Looks at all rows of quadrangles, in order: the result does not depend on the threads. */
void Shadowgraph::FillBand(int number)
{
  const int first = number * RowsPerBand;
  const int last = std::min(this->Height, first + RowsPerBand);
  Band band(this->Irradiance, this->Width, first, last);
  const auto reachesBand = [this, first, last](int row)
  {
    return row >= 0 && row < this->Height &&
      this->Reaches[static_cast<std::size_t>(row)].y >= first - 0.5 &&
      this->Reaches[static_cast<std::size_t>(row)].x <= last - 0.5;
  };
  for (int row = 0; row <= this->Height; ++row)
  {
    if (reachesBand(row) || reachesBand(row - 1))
    {
      this->AddRow(row, band);
    }
  }
  band.Settle();
  for (int row = 0; row < this->Height; ++row)
  {
    for (const int column : this->Alone[static_cast<std::size_t>(row)])
    {
      if (reachesBand(row))
      {
        band.Add(this->GetQuadrangle(column, row), 1.0);
      }
    }
  }
}

//------------------------------------------------------------------------------
void Shadowgraph::Compute(int width, int height, const RangeLoop& loop)
{
  this->Width = width;
  this->Height = height;
  this->Corners.resize(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1));
  this->Densities.resize(this->Landings.size());
  this->Irradiance.resize(this->Landings.size());
  this->Alone.resize(static_cast<std::size_t>(height));
  this->Reaches.resize(static_cast<std::size_t>(height));
  const auto rows = static_cast<std::size_t>(height);
  ForEachItem(
    rows + 1, loop, [this](std::size_t row) { this->FindCorners(static_cast<int>(row)); });
  ForEachItem(rows, loop,
    [this](std::size_t row)
    {
      this->FindDensities(static_cast<int>(row));
      this->FindReach(static_cast<int>(row));
    });
  ForEachItem((rows + RowsPerBand - 1) / RowsPerBand, loop,
    [this](std::size_t band) { this->FillBand(static_cast<int>(band)); });
  this->LightOffScreen = 0.0;
  for (std::size_t pixel = 0; pixel < this->Landings.size(); ++pixel)
  {
    this->LightOffScreen +=
      (std::isnan(this->Landings[pixel].x) ? 0.0 : 1.0) - this->Irradiance[pixel];
  }
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
