// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Conditioning.h"

#include "ProjectionModes.h"
#include "ReferenceComponents.h"

#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

namespace
{

using reference::Ray;
using reference::RaySegment;
using Color = std::array<double, 4>;

constexpr int NumberOfCopies = 12;
/** With those of Extend(). */
constexpr int LargestNumberOfCopies = 200;
/** An image with more pixels that differ is wrong, whatever further copies say. */
constexpr int LargestNumberOfPixels = 64;

struct Rounding
{
  /** Rounding of points, in any direction. */
  double Point = 0.0;
  /** Rounding of points as a share of the longest edge of their cells. */
  double Edge = 0.0;
  /** Rounding of the places where a ray meets faces, along the ray. */
  double Depth = 0.0;
  /** Share of a component's range. */
  double Scalar = 0.0;
};

// Rounding of two images; see the class.
Rounding RoundingOf(const VolumeCase& test)
{
  double b[6];
  test.MakeMesh().GetBounds(b);
  const double radius = 0.5 * DiagonalOf(b);
  const double slope = test.View.Parallel ? 0.0 : std::sqrt(2.0) * test.View.HalfHeight;
  const bool native = test.Backend == vtkTetrahedraRayCastMapper::NATIVE;
  const double unit = test.Membrane.Mesh ? 0x1p-22 : native ? 0x1p-30 : 0x1p-24;
  const bool divides = test.Look.Blend == vtkVolumeMapper::AVERAGE_INTENSITY_BLEND;
  // A ray meets about 3 cells per layer of a cube of cells, and as many terms are added up.
  const double terms = divides ? 3.0 * std::cbrt(double(test.MakeMesh().Cells.size())) : 0.0;
  return { 2.0 * 1.5 * unit * radius * (1.0 + slope), native ? 2.0 * 0x1p-24 : 0.0,
    divides ? 2.0 * 3.0 * 0x1p-24 * radius : 0.0,
    2.0 * ((native ? 2.0 : 4.0) + 0.5 * terms) * 0x1p-24 };
}

// Length of the longest edge at each point.
std::vector<double> LongestEdges(const MeshArrays& mesh, const std::vector<MeshTetrahedron>& cells)
{
  std::vector<double> longest(mesh.Points.size(), 0.0);
  for (const MeshTetrahedron& cell : cells)
  {
    for (const std::int64_t a : cell.Ids)
    {
      for (const std::int64_t b : cell.Ids)
      {
        const auto p = static_cast<std::size_t>(a);
        const double length =
          glm::distance(mesh.Points[p], mesh.Points[static_cast<std::size_t>(b)]);
        longest[p] = std::max(longest[p], length);
      }
    }
  }
  return longest;
}

// One-sided limit of a piecewise linear function of control points: `next` is the first point at or
// above a scalar (limit from below), or the first above it (limit from above).
template <typename Point, typename Get>
double LimitAt(
  const std::vector<Point>& points, std::size_t next, double scalar, const Get& valueOf)
{
  if (next == 0 || next == points.size())
  {
    return valueOf(next == 0 ? points.front() : points.back());
  }
  const Point& low = points[next - 1];
  const Point& high = points[next];
  const double u = (scalar - low.Scalar) / (high.Scalar - low.Scalar);
  return valueOf(low) + u * (valueOf(high) - valueOf(low));
}

template <typename Point>
std::size_t NextOf(const std::vector<Point>& points, double scalar, bool above)
{
  const auto found = std::find_if(points.begin(), points.end(),
    [=](const Point& p) { return above ? p.Scalar > scalar : p.Scalar >= scalar; });
  return static_cast<std::size_t>(found - points.begin());
}

// Opacity and colour as one function. Two nodes at each control point, since it may be a jump.
reference::ReferenceTransferFunction Merged(const LookFunction& function, double factor)
{
  std::vector<double> scalars;
  for (const auto& point : function.Opacity)
  {
    scalars.push_back(point.Scalar);
  }
  for (const auto& point : function.Color)
  {
    scalars.push_back(point.Scalar);
  }
  std::sort(scalars.begin(), scalars.end());
  scalars.erase(std::unique(scalars.begin(), scalars.end()), scalars.end());
  std::vector<reference::TransferFunctionNode> nodes;
  for (const double scalar : scalars)
  {
    for (const bool above : { false, true })
    {
      reference::TransferFunctionNode node;
      node.Scalar = scalar;
      node.Value.Attenuation = factor *
        LimitAt(function.Opacity, NextOf(function.Opacity, scalar, above), scalar,
          [](const LookFunction::OpacityPoint& p) { return p.Opacity; });
      for (std::size_t c = 0; c < 3; ++c)
      {
        node.Value.Color[c] = LimitAt(function.Color, NextOf(function.Color, scalar, above), scalar,
          [c](const LookFunction::ColorPoint& p) { return p.Color[c]; });
      }
      nodes.push_back(node);
    }
  }
  return reference::ReferenceTransferFunction(nodes);
}

// Function of one component; opacity is taken unchanged where a mode does not measure lengths.
reference::ReferenceTransferFunction FunctionOf(const VolumeLook& look, std::size_t component)
{
  const LookFunction& function = look.Functions[std::min(component, look.Functions.size() - 1)];
  const ProjectionMode* projection = FindProjectionMode(look.Blend);
  const bool measures =
    projection ? projection->OpacityPerDistance : look.Blend == vtkVolumeMapper::COMPOSITE_BLEND;
  const double weight = look.Functions.size() > 1 ? function.Weight : 1.0;
  return Merged(function, weight / (measures ? look.Unit : 1.0));
}

reference::Material MaterialOf(const VolumeCase& test)
{
  reference::Material material;
  material.Ambient = test.Look.Ambient;
  material.Diffuse = test.Look.Diffuse;
  material.Specular = test.Look.Specular;
  material.Power = test.Look.SpecularPower;
  const glm::dvec3 toEye = test.View.Eye - test.View.Focus; // the renderer's headlight
  reference::Light light;
  light.Place = { toEye.x, toEye.y, toEye.z };
  material.Lights = { light };
  return material;
}

double GradientFactor(const VolumeLook& look, double size)
{
  const auto& points = look.GradientOpacity;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (size < points[i].Scalar)
    {
      if (i == 0)
      {
        break;
      }
      const double u = (size - points[i - 1].Scalar) / (points[i].Scalar - points[i - 1].Scalar);
      return points[i - 1].Opacity + u * (points[i].Opacity - points[i - 1].Opacity);
    }
  }
  return size < points.front().Scalar ? points.front().Opacity : points.back().Opacity;
}

} // anonymous namespace

//------------------------------------------------------------------------------
/** The exact image of a case whose points and scalars are randomly moved by given amounts. */
class Conditioning::Truth
{
public:
  Truth(const VolumeCase& test, const Rounding& rounding, RandomNumbers& random)
    : Case(test)
    , Material(MaterialOf(test))
    , DepthRounding(rounding.Depth)
    , SeedOfDepths(random.Bits())
  {
    const MeshArrays& mesh = test.MakeMesh();
    const std::vector<MeshTetrahedron> cells = TetrahedraOf(mesh);
    const std::vector<double> longest = LongestEdges(mesh, cells);
    std::vector<double> points;
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      const double amount = rounding.Point + rounding.Edge * longest[i];
      for (int axis = 0; axis < 3; ++axis)
      {
        points.push_back(mesh.Points[i][axis] + Moved(amount, random));
      }
    }
    std::vector<std::int64_t> ids;
    for (const MeshTetrahedron& tetrahedron : cells)
    {
      ids.insert(ids.end(), tetrahedron.Ids.begin(), tetrahedron.Ids.end());
      this->Cells.push_back(tetrahedron.Cell);
    }
    for (int c = 0; c < mesh.Components; ++c)
    {
      const auto range = mesh.MakeRange(c);
      std::vector<double> values;
      for (std::size_t i = 0; i < mesh.Tuples(); ++i)
      {
        values.push_back(
          mesh.GetValue(i, c) + Moved(rounding.Scalar * (range[1] - range[0]), random));
      }
      this->CellValues = mesh.OnCells ? values : std::vector<double>();
      values.resize(mesh.Points.size());
      this->Integrators.push_back(
        std::make_unique<reference::ReferenceRayIntegrator>(points, ids, values));
      this->Functions.push_back(FunctionOf(test.Look, static_cast<std::size_t>(c)));
    }
    for (const double value : test.Look.IsoValues)
    {
      const reference::OpticalSample sample = this->Functions[0].GetValue(value);
      this->Surfaces.push_back({ value, sample.Attenuation, sample.Color });
    }
  }

  /**
   * @param exact the copy that is not moved: gradients are those of the input, not of its rounded
   *   copy.
   */
  Color Trace(int x, int y, const Truth& exact)
  {
    const Ray ray = this->Case.View.GetRay(x, y, this->Case.Size);
    if (!this->Case.Membrane.Mesh)
    {
      return this->TracePart(ray, this->Segments(ray), exact);
    }
    const auto refracted = reference::Refract(this->Case.Membrane.Surface, ray, 0.0, false);
    if (this->IsProjection())
    {
      std::vector<RaySegment> both = reference::FindSegments(*this->Integrators[0],
        { this->Clipped(refracted.Straight), this->Clipped(refracted.Bent) });
      this->TakeCellValues(both);
      return this->TracePart(refracted.Straight, both, exact);
    }
    return reference::Compose(refracted,
      [&](const Ray& part) { return this->TracePart(part, this->Segments(part), exact); });
  }

  const reference::ReferenceGradients& GetGradients() const
  {
    if (!this->Gradients)
    {
      this->Gradients = std::make_unique<reference::ReferenceGradients>(
        this->Integrators[0]->MakeMesh(), this->Case.Look.Gradients != 0);
    }
    return *this->Gradients;
  }

private:
  static double Moved(double amount, RandomNumbers& random)
  {
    return random.Below(2) ? amount : -amount;
  }

  bool IsProjection() const { return FindProjectionMode(this->Case.Look.Blend) != nullptr; }

  Ray Clipped(const Ray& ray) const
  {
    std::vector<reference::HalfSpace> halves;
    for (const auto& plane : this->Case.Planes)
    {
      halves.push_back(
        { { plane[1].x, plane[1].y, plane[1].z }, { plane[0].x, plane[0].y, plane[0].z } });
    }
    return reference::ClipRay(ray, halves);
  }

  std::vector<RaySegment> Segments(const Ray& ray) const
  {
    std::vector<RaySegment> segments;
    this->FindSegments(0, this->Clipped(ray), segments);
    this->TakeCellValues(segments);
    return segments;
  }

  // Segments of one component. Where cells overlap, invisible ones hide nothing.
  void FindSegments(std::size_t component, const Ray& ray, std::vector<RaySegment>& segments) const
  {
    this->Integrators[component]->FindVisibleSegments(
      ray, [this](std::int64_t cell) { return this->CanBeSeen(cell); }, segments);
  }

  bool CanBeSeen(std::int64_t cell) const
  {
    if (this->IsProjection())
    {
      return true;
    }
    if (this->Case.Look.Blend == vtkVolumeMapper::ISOSURFACE_BLEND)
    {
      return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
        [&](const reference::Surface& surface) { return this->Holds(cell, surface.Scalar); });
    }
    if (!this->CellValues.empty())
    {
      const double value = this->CellValues[this->Cells[static_cast<std::size_t>(cell)]];
      return this->Functions[0].GetValue(value).Attenuation > 0.0;
    }
    // The opacity of components that are mixed is that of the last.
    const std::size_t first = this->Case.Look.Independent ? 0 : this->Integrators.size() - 1;
    for (std::size_t c = first; c < this->Integrators.size(); ++c)
    {
      if (this->Integrators[c]->CanBeSeen(cell, this->Functions[c]))
      {
        return true;
      }
    }
    return false;
  }

  bool Holds(std::int64_t cell, double scalar) const
  {
    const reference::ReferenceMesh& mesh = this->Integrators[0]->MakeMesh();
    const std::int64_t* const ids = mesh.GetCell(static_cast<std::size_t>(cell));
    const auto range = std::minmax({ mesh.GetScalar(ids[0]), mesh.GetScalar(ids[1]),
      mesh.GetScalar(ids[2]), mesh.GetScalar(ids[3]) });
    return range.first <= scalar && scalar <= range.second;
  }

  void TakeCellValues(std::vector<RaySegment>& segments) const
  {
    for (RaySegment& segment : segments)
    {
      if (!this->CellValues.empty())
      {
        segment.ScalarBegin = segment.ScalarEnd =
          this->CellValues[this->Cells[static_cast<std::size_t>(segment.Cell)]];
      }
    }
  }

  // Moves each place where the ray meets a face.
  std::vector<RaySegment> WithMovedEnds(const Ray& ray, std::vector<RaySegment> segments) const
  {
    RandomNumbers random(this->SeedOfDepths);
    const double amount =
      this->DepthRounding / std::hypot(ray.Direction[0], ray.Direction[1], ray.Direction[2]);
    double met = std::numeric_limits<double>::quiet_NaN();
    double moved = 0.0;
    for (RaySegment& segment : segments)
    {
      const double begin = segment.Begin == met ? moved : segment.Begin + Moved(amount, random);
      met = segment.End;
      moved = std::max(begin, segment.End + Moved(amount, random));
      segment.Begin = begin;
      segment.End = moved;
    }
    return segments;
  }

  Color Project(const Ray& ray, const std::vector<RaySegment>& given) const
  {
    const std::vector<RaySegment> segments =
      this->DepthRounding > 0.0 ? this->WithMovedEnds(ray, given) : given;
    const auto range = this->Case.MakeMesh().MakeRange(0);
    const ProjectionMode* projection = FindProjectionMode(this->Case.Look.Blend);
    return reference::Project(ray, segments, projection->Truth, this->Functions[0], range.data());
  }

  Color Mix(const Ray& ray) const
  {
    std::vector<std::vector<RaySegment>> segments(this->Integrators.size());
    for (std::size_t c = 0; c < segments.size(); ++c)
    {
      this->FindSegments(c, this->Clipped(ray), segments[c]);
    }
    const auto mixture = this->Case.Look.Independent ? reference::Mixture::Independent
      : segments.size() == 2                         ? reference::Mixture::ColorAndOpacity
                                                     : reference::Mixture::RedGreenBlueOpacity;
    return reference::IntegrateComponents(ray, segments, mixture, this->Functions);
  }

  Color TracePart(const Ray& ray, const std::vector<RaySegment>& segments, const Truth& exact) const
  {
    const VolumeLook& look = this->Case.Look;
    if (this->IsProjection())
    {
      return this->Project(ray, segments);
    }
    if (this->Integrators.size() > 1)
    {
      return this->Mix(ray);
    }
    const reference::Material* const material = look.Shade ? &this->Material : nullptr;
    if (look.Blend == vtkVolumeMapper::ISOSURFACE_BLEND)
    {
      return reference::BlendSurfaces(
        ray, segments, this->Surfaces, material ? &exact.GetGradients() : nullptr, this->Material);
    }
    if (!this->Case.HasGradients())
    {
      return reference::ReferenceRayIntegrator::Integrate(ray, segments, this->Functions[0]);
    }
    const auto factor = [&look](double size) { return GradientFactor(look, size); };
    return reference::IntegrateShaded(ray, segments, this->Functions[0], exact.GetGradients(),
      material, look.GradientOpacity.empty() ? std::function<double(double)>() : factor, 8);
  }

  const VolumeCase& Case;
  reference::Material Material;
  double DepthRounding;
  std::uint64_t SeedOfDepths;
  std::vector<std::size_t> Cells;
  std::vector<double> CellValues;
  std::vector<std::unique_ptr<reference::ReferenceRayIntegrator>> Integrators;
  std::vector<reference::ReferenceTransferFunction> Functions;
  std::vector<reference::Surface> Surfaces;
  mutable std::unique_ptr<reference::ReferenceGradients> Gradients;
};

//------------------------------------------------------------------------------
Conditioning::Conditioning(const VolumeCase& test)
  : Case(test)
{
}

//------------------------------------------------------------------------------
Conditioning::~Conditioning() = default;

//------------------------------------------------------------------------------
void Conditioning::MakeCopies()
{
  if (!this->Copies.empty())
  {
    return;
  }
  RandomNumbers random(1);
  this->Copies.push_back(std::make_unique<Truth>(this->Case, Rounding(), random));
  for (int i = 0; i < NumberOfCopies; ++i)
  {
    this->Copies.push_back(std::make_unique<Truth>(this->Case, RoundingOf(this->Case), random));
  }
}

//------------------------------------------------------------------------------
std::array<double, 4> Conditioning::GetExact(int x, int y)
{
  this->MakeCopies();
  return this->Copies.front()->Trace(x, y, *this->Copies.front());
}

//------------------------------------------------------------------------------
void Conditioning::PixelRange::Include(const Color& color)
{
  for (std::size_t c = 0; c < color.size(); ++c)
  {
    this->Low[c] = std::min(this->Low[c], color[c]);
    this->High[c] = std::max(this->High[c], color[c]);
  }
}

//------------------------------------------------------------------------------
double Conditioning::PixelRange::GetSpread() const
{
  double largest = 0.0;
  for (std::size_t c = 0; c < this->Low.size(); ++c)
  {
    largest = std::max(largest, this->High[c] - this->Low[c]);
  }
  return largest;
}

//------------------------------------------------------------------------------
Conditioning::PixelRange Conditioning::FindRange(int x, int y, double needed)
{
  const Color exact = this->GetExact(x, y);
  PixelRange range{ x, y, exact, exact, needed };
  for (const auto& copy : this->Copies)
  {
    range.Include(copy->Trace(x, y, *this->Copies.front()));
  }
  return range;
}

//------------------------------------------------------------------------------
void Conditioning::Extend(std::vector<PixelRange>& pixels)
{
  this->MakeCopies();
  RandomNumbers random(2);
  const auto lacks = [](const PixelRange& pixel) { return !(pixel.GetSpread() >= pixel.Needed); };
  for (int i = NumberOfCopies; i < LargestNumberOfCopies; ++i)
  {
    const auto lacking = std::count_if(pixels.begin(), pixels.end(), lacks);
    if (lacking == 0 || lacking > LargestNumberOfPixels)
    {
      return;
    }
    Truth copy(this->Case, RoundingOf(this->Case), random);
    for (PixelRange& pixel : pixels)
    {
      pixel.Include(copy.Trace(pixel.X, pixel.Y, *this->Copies.front()));
    }
  }
}

//------------------------------------------------------------------------------
double PlainTolerance(int backend)
{
  return backend == vtkTetrahedraRayCastMapper::NATIVE ? 2e-5 : 1e-4;
}

} // namespace meniscus::test
