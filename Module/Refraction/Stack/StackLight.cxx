// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Stack/StackLight.h"

#include "Refraction/Membrane/CrossProduct.h"
#include "Refraction/Membrane/Optics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

// Largest distance of the middle ray of a beam's side from the interpolated one, where beams are
// not divided: in lengths of the side, and in sizes of a cell, the larger one. Each beam is then
// lit as four, between all traced rays, whose middle rays are four times nearer. With h the length
// of a side and e the distance, the density of the light changes by about 8 e / h along it, so that
// of a part differs from its mean by 4 (e / 4) / (h / 2) = 2 e / h at most, 1 %. At a focus, where
// h vanishes, light is off by 0.0025 of a cell.
constexpr double SideTolerance = 0.005;
constexpr double CellTolerance = 0.01;

// Divisions of a patch where rays are not linear, and where some of them end: the part that is lost
// at the end of the light, or at the edge of a surface, is 2^-7 of a patch wide.
constexpr int DeepestBend = 6;
constexpr int DeepestEnd = 7;

// Number of patches whose light is gathered before it is added.
constexpr std::size_t Block = 4096;

/** A convex polygon of image points, clipped by half-spaces. */
template <typename ImagePoint>
class ImagePolygon
{
public:
  void Add(const ImagePoint& point)
  {
    // More corners than fit are those of a sliver without area, whose signs are those of rounding.
    if (this->Count < this->Points.size())
    {
      this->Points[this->Count++] = point;
    }
  }

  /** Keeps the part where `distance(point)`, which is linear, is not negative. */
  template <typename Distance>
  void Clip(const Distance& distance)
  {
    ImagePolygon kept;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const ImagePoint& a = this->Points[i];
      const ImagePoint& b = this->Points[(i + 1) % this->Count];
      const double da = distance(a);
      const double db = distance(b);
      if (da >= 0.0)
      {
        kept.Add(a);
      }
      if ((da < 0.0) != (db < 0.0))
      {
        const double s = da / (da - db);
        kept.Add({ a.B + s * (b.B - a.B), a.Behind + s * (b.Behind - a.Behind),
          a.InFront + s * (b.InFront - a.InFront) });
      }
    }
    *this = kept;
  }

  /** Keeps the part in the beam, from the legs' origins to their ends; the last legs have none. */
  void ClipToBeam(bool isLast)
  {
    this->Clip([](const ImagePoint& p) { return p.Behind; });
    if (!isLast)
    {
      this->Clip([](const ImagePoint& p) { return p.InFront; });
    }
    this->Clip([](const ImagePoint& p) { return p.B.x; });
    this->Clip([](const ImagePoint& p) { return p.B.y; });
    this->Clip([](const ImagePoint& p) { return 1.0 - p.B.x - p.B.y; });
  }

  /** Mean distance behind the leg's origin, of the corners. @pre there is a corner */
  double GetBehind() const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      sum += this->Points[i].Behind;
    }
    return sum / static_cast<double>(this->Count);
  }

  double GetArea() const
  {
    return 0.5 *
      std::fabs(GetTwiceArea(this->Count, [this](std::size_t i) { return this->Points[i].B; }));
  }

private:
  // Each of five half-spaces adds one corner at most to those of a triangle.
  std::array<ImagePoint, 9> Points;
  std::size_t Count = 0;
};

}

//------------------------------------------------------------------------------
StackLight::StackLight(const RefractionStack& stack, const LitTriangles& lit)
  : Stack(stack)
  , Lit(lit)
{
  std::vector<AxisBox> boxes;
  boxes.reserve(lit.Triangles.size());
  double area = 0.0;
  for (const std::array<std::int64_t, 3>& triangle : lit.Triangles)
  {
    AxisBox box;
    glm::dvec3 corner[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      corner[i] = lit.Points[static_cast<std::size_t>(triangle[i])] - stack.GetOrigin();
      box.Add({ corner[i], corner[i] });
    }
    area += 0.5 * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    this->Bounds.Add(box);
    boxes.push_back(box);
  }
  this->Tree.Build(boxes);
  this->Tolerance =
    CellTolerance * std::sqrt(area / static_cast<double>(std::max<std::size_t>(boxes.size(), 1)));
}

//------------------------------------------------------------------------------
std::vector<CellLight> StackLight::Gather(std::size_t cells, const RangeLoop& loop) const
{
  std::vector<CellLight> light(cells);
  if (this->Lit.Triangles.empty())
  {
    return light;
  }
  const std::size_t facets =
    this->Stack.GetLinks().front().Surface->GetMembrane().GetFacets().size();
  std::vector<std::vector<Share>> shares(std::min(facets, Block));
  for (std::size_t first = 0; first < facets; first += Block)
  {
    const std::size_t count = std::min(Block, facets - first);
    loop(count,
      [this, first, &shares](std::size_t begin, std::size_t end)
      {
        StackPath path;
        for (std::size_t i = begin; i < end; ++i)
        {
          shares[i].clear();
          path.Forget(this->Stack.GetLinks().size());
          const auto facet = static_cast<std::int32_t>(first + i);
          const Corners corners{ this->Trace(facet, { 0.0, 0.0 }, path),
            this->Trace(facet, { 1.0, 0.0 }, path), this->Trace(facet, { 0.0, 1.0 }, path) };
          this->Divide(facet, corners, 0, path, shares[i]);
        }
      });
    for (std::size_t i = 0; i < count; ++i)
    {
      for (const Share& share : shares[i])
      {
        light[static_cast<std::size_t>(share.Cell)].Add(
          share.Light, share.ToLight, share.Cosine, share.Path);
      }
    }
  }
  return light;
}

//------------------------------------------------------------------------------
StackLight::Corner StackLight::Trace(std::int32_t facet, const glm::dvec2& b, StackPath& path) const
{
  const std::vector<RefractionStack::Link>& links = this->Stack.GetLinks();
  const PathEnd end = this->Stack.Trace({ facet, b }, links.size(), false, path);
  Corner corner{ b, {} };
  PlateTransmittance transmittance;
  double before = 0.0;
  for (std::size_t k = 0; k < path.Count; ++k)
  {
    const PathPoint& point = path.Points[k];
    const InterfacePassage& passage = links[k].Passage;
    transmittance.Add(point.Cosine, passage.Before, passage.Behind);
    Leg leg{ point.Ray.Origin, point.Ray.Direction, 0.0, transmittance.Get(), before };
    SurfaceCrossing crossing;
    if (k + 1 == links.size())
    {
      leg.Length = this->GetReach(leg.Origin, leg.Direction);
    }
    else if (k + 1 < path.Count)
    {
      leg.Length = glm::length(path.Points[k + 1].Ray.Origin - leg.Origin);
    }
    else if (end == PathEnd::Reflected &&
      this->Stack.FindNext(k + 1, leg.Origin, leg.Direction, crossing))
    {
      leg.Length = crossing.Distance;
    }
    else
    {
      break;
    }
    before += leg.Length;
    corner.Legs.push_back(leg);
  }
  return corner;
}

//------------------------------------------------------------------------------
// Distance along a ray up to which there are lit points.
double StackLight::GetReach(const glm::dvec3& origin, const glm::dvec3& direction) const
{
  double reach = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double end = direction[axis] < 0.0 ? this->Bounds.Low[axis] : this->Bounds.High[axis];
    reach += (end - origin[axis]) * direction[axis];
  }
  return std::max(reach, 0.0);
}

//------------------------------------------------------------------------------
// True if the ray in the middle is the mean of the other two on all legs that they have.
bool StackLight::IsLinear(const Corner& a, const Corner& b, const Corner& middle) const
{
  for (std::size_t k = 0; k < middle.Legs.size(); ++k)
  {
    if (k >= a.Legs.size() || k >= b.Legs.size())
    {
      return true; // decided by the number of legs
    }
    const Leg& own = middle.Legs[k];
    const glm::dvec3 shift = own.Origin - 0.5 * (a.Legs[k].Origin + b.Legs[k].Origin);
    const glm::dvec3 turn = own.Direction - 0.5 * (a.Legs[k].Direction + b.Legs[k].Direction);
    const auto across = [&own](const glm::dvec3& v)
    { return glm::length(v - glm::dot(v, own.Direction) * own.Direction); };
    const glm::dvec3 side = a.Legs[k].Origin - b.Legs[k].Origin;
    const glm::dvec3 endSide = side + own.Length * (a.Legs[k].Direction - b.Legs[k].Direction);
    const auto isNear = [&](const glm::dvec3& error, const glm::dvec3& along)
    { return across(error) <= std::max(this->Tolerance, SideTolerance * across(along)); };
    // Written so that a NaN fails.
    if (!(isNear(shift, side) && isNear(shift + own.Length * turn, endSide)))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void StackLight::Divide(std::int32_t facet, const Corners& corners, int depth, StackPath& path,
  std::vector<Share>& shares) const
{
  Corners middles;
  bool isLinear = true;
  std::size_t least = corners[0].Legs.size();
  std::size_t most = least;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Corner& a = corners[(i + 1) % 3];
    const Corner& b = corners[(i + 2) % 3];
    middles[i] = this->Trace(facet, 0.5 * (a.B + b.B), path);
    isLinear = isLinear && this->IsLinear(a, b, middles[i]);
    least = std::min({ least, middles[i].Legs.size(), corners[i].Legs.size() });
    most = std::max({ most, middles[i].Legs.size(), corners[i].Legs.size() });
  }
  if (most == 0 && depth > 0)
  {
    return;
  }
  const bool isDivided = (!isLinear && depth < DeepestBend) || (least < most && depth < DeepestEnd);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Corners part =
      i < 3 ? Corners{ corners[i], middles[(i + 2) % 3], middles[(i + 1) % 3] } : middles;
    if (isDivided)
    {
      this->Divide(facet, part, depth + 1, path, shares);
    }
    for (std::size_t leg = 0; leg < least && !isDivided; ++leg)
    {
      this->Deposit(part, leg, shares);
    }
  }
}

//------------------------------------------------------------------------------
// Image of a point by the cut of the rays with the plane through it with this normal.
StackLight::ImagePoint StackLight::Locate(
  const BeamRays& rays, const glm::dvec3& point, const glm::dvec3& normal)
{
  glm::dvec3 cut[3];
  double distance[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    distance[i] = glm::dot(point - rays[i]->Origin, normal) / glm::dot(rays[i]->Direction, normal);
    cut[i] = rays[i]->Origin + distance[i] * rays[i]->Direction;
  }
  const glm::dvec3 u = cut[1] - cut[0];
  const glm::dvec3 v = cut[2] - cut[0];
  const double whole = glm::dot(normal, glm::cross(u, v));
  const glm::dvec2 b(glm::dot(normal, glm::cross(point - cut[0], v)) / whole,
    glm::dot(normal, glm::cross(u, point - cut[0])) / whole);
  const auto mix = [&b](double a0, double a1, double a2)
  { return (1.0 - b.x - b.y) * a0 + b.x * a1 + b.y * a2; };
  const double behind = mix(distance[0], distance[1], distance[2]);
  return { b, behind, mix(rays[0]->Length, rays[1]->Length, rays[2]->Length) - behind };
}

//------------------------------------------------------------------------------
double StackLight::GetFacing(const Corners& corners) const
{
  const glm::dvec3 places[3] = { corners[0].Legs[0].Origin, corners[1].Legs[0].Origin,
    corners[2].Legs[0].Origin };
  const glm::dvec3 sight =
    glm::normalize((places[0] + places[1] + places[2]) / 3.0 - this->Stack.GetEye());
  return 0.5 * std::fabs(glm::dot(glm::cross(places[1] - places[0], places[2] - places[0]), sight));
}

//------------------------------------------------------------------------------
void StackLight::Deposit(const Corners& corners, std::size_t leg, std::vector<Share>& shares) const
{
  const bool isLast = leg + 1 == this->Stack.GetLinks().size();
  BeamRays rays;
  glm::dvec3 sum(0.0);
  TubeBounds tube;
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    rays[i] = &corners[i].Legs[leg];
    sum += rays[i]->Direction;
    tube.Add(rays[i]->Origin, rays[i]->Direction);
    // The distance of a ray's origin from a point is convex, so no ray between the three has more.
    const glm::dvec3& from = rays[i]->Origin;
    const double farthest =
      glm::length(glm::max(glm::abs(this->Bounds.Low - from), glm::abs(this->Bounds.High - from)));
    most = std::max(most, isLast ? farthest : rays[i]->Length);
  }
  // Cells at the border of the tube, or at the end of the rays, are met within rounding.
  const double slack =
    this->Stack.GetLinks().front().Surface->GetSlack(glm::length(rays[0]->Origin) + most);
  tube.StartLow -= slack;
  tube.StartHigh += slack;
  most += slack;
  const glm::dvec3 along = glm::normalize(sum);
  const double light = this->GetFacing(corners) *
    (rays[0]->Transmittance + rays[1]->Transmittance + rays[2]->Transmittance) / 3.0;
  const double before = (rays[0]->Before + rays[1]->Before + rays[2]->Before) / 3.0;
  this->Tree.Visit(tube, most,
    [&](std::int32_t item, const TubeRange&)
    {
      const auto number = static_cast<std::size_t>(item);
      const std::array<std::int64_t, 3>& triangle = this->Lit.Triangles[number];
      glm::dvec3 at[3];
      for (std::size_t i = 0; i < 3; ++i)
      {
        at[i] = this->Lit.Points[static_cast<std::size_t>(triangle[i])] - this->Stack.GetOrigin();
      }
      const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
      const double facing = glm::dot(normal, along);
      if (this->OneSided && !(facing < 0.0))
      {
        return most;
      }
      // Rays that pass a plane in both directions have no cut with it.
      const bool isCut = std::all_of(std::begin(rays), std::end(rays),
        [&](const Leg* ray) { return glm::dot(normal, ray->Direction) * facing > 0.0; });
      ImagePolygon<ImagePoint> image;
      for (const glm::dvec3& point : at)
      {
        image.Add(Locate(rays, point, isCut ? normal : along));
      }
      image.ClipToBeam(isLast);
      const double share = 2.0 * image.GetArea();
      if (share > 0.0) // not for a NaN either, at a focus
      {
        shares.push_back({ this->Lit.Cells[number], share * light, -along,
          facing / glm::length(normal), before + image.GetBehind() });
      }
      return most;
    });
}

}
