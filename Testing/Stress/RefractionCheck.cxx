// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionCheck.h"

#include "ExactStack.h"
#include "PatchSearch.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ObjectImages.h"
#include "RefractionTriangles.h"
#include "StackCheck.h"

namespace meniscus::test
{

namespace
{

using reference::MakeReflectance;
using reference::OracleAnswer;
using reference::OracleImage;
using reference::SightOracle;
using reference::SmoothSurface;
using reference::SurfaceError;

// Largest error of Newton's method, in facets: 1e-10 away from caustics.
constexpr double Rest = 1e-8;

//------------------------------------------------------------------------------
class Checker
{
public:
  explicit Checker(const RefractionCase& test)
    : Test(test)
  {
  }

  RefractionTally Run()
  {
    const reference::MembraneMesh mesh =
      PlaceMesh(this->Test.Mesh, this->Test.Scale, this->Test.Offset);
    if (this->Geometry.SetMembrane(mesh.AsInput()) != MembraneStatus::Ready ||
      this->Geometry.SetEye(this->ToWorld(this->Test.Eye), this->Test.Exterior,
        this->Test.Interior) != EyeStatus::Ready)
    {
      ++this->Tally.Failed;
      this->Note("membrane or eye refused");
      return this->Tally;
    }
    double reach = glm::length(this->Test.Offset) / this->Test.Scale + glm::length(this->Test.Eye);
    for (const glm::dvec3& point : this->Test.Points)
    {
      reach = std::max(reach, glm::length(point));
    }
    this->Rounding = 4.0 * std::numeric_limits<double>::epsilon() * (reach + 200.0);
    if (this->Test.Truth == RefractionTruth::Smooth)
    {
      this->MeasureSurface();
      this->CheckBySurface();
    }
    else
    {
      this->CheckByPatches();
    }
    return this->Tally;
  }

private:
  glm::dvec3 ToWorld(const glm::dvec3& p) const { return this->Test.Scale * p + this->Test.Offset; }
  glm::dvec3 FromWorld(const glm::dvec3& p) const
  {
    return (p - this->Test.Offset) / this->Test.Scale;
  }

  void Note(const std::string& what)
  {
    if (this->Tally.First.empty())
    {
      this->Tally.First = what;
    }
  }

  void GetCount(
    std::int64_t RefractionTally::*fault, std::size_t point, const char* what, double x, double z)
  {
    ++(this->Tally.*fault);
    std::ostringstream text;
    text.precision(10);
    text << "point " << point << ": " << what << " at x " << x << ", z " << z;
    this->Note(text.str());
  }

  // Distance of the patches from the smooth surface, and of their normals; measured at places
  // inside a facet and on its edges, and enlarged by half for the places between these.
  void MeasureSurface()
  {
    const CurvedPatches& patches = this->Geometry.GetPatches();
    const auto facets = static_cast<std::int32_t>(this->Geometry.GetMembrane().GetFacets().size());
    const glm::dvec2 places[] = { { 1.0 / 3.0, 1.0 / 3.0 }, { 0.5, 0.0 }, { 0.0, 0.5 },
      { 0.5, 0.5 }, { 0.2, 0.2 }, { 0.6, 0.2 }, { 0.2, 0.6 }, { 0.25, 0.0 }, { 0.75, 0.0 },
      { 0.0, 0.25 }, { 0.0, 0.75 }, { 0.25, 0.75 }, { 0.75, 0.25 } };
    for (std::int32_t f = 0; f < facets; ++f)
    {
      const CurvedPatch patch = patches.GetPatch(f);
      for (const glm::dvec2& b : places)
      {
        const PatchPoint at = patch.Evaluate(b);
        const glm::dvec3 p =
          this->FromWorld(at.Position + this->Geometry.GetMembrane().GetOrigin());
        const glm::dvec3 normal = this->Test.Surface.GetNormal(p.x, p.z);
        this->Error.Position =
          std::max(this->Error.Position, std::fabs(p.y - this->Test.Surface.At(p.x, p.z).F));
        this->Error.Normal =
          std::max(this->Error.Normal, glm::length(glm::normalize(at.Normal) - normal));
      }
    }
    this->Error.Position = 1.5 * this->Error.Position + this->Rounding;
    this->Error.Normal = 1.5 * this->Error.Normal + this->Rounding / this->Test.FacetSize;
  }

  // +1: in a hole; -1: not; 0: within `band` of a border.
  int IsInHole(const glm::dvec3& sight, double band) const
  {
    int result = -1;
    for (const auto& hole : this->Test.Holes)
    {
      double least = std::numeric_limits<double>::max();
      for (std::size_t k = 0; k < 3; ++k)
      {
        const glm::dvec2 side = hole[(k + 1) % 3] - hole[k];
        const glm::dvec2 to = glm::dvec2(sight.x, sight.z) - hole[k];
        // Clockwise in x and z, which is counter-clockwise as seen from above.
        least = std::min(least, (side.y * to.x - side.x * to.y) / glm::length(side));
      }
      if (least > band)
      {
        return 1;
      }
      result = least > -band ? 0 : result;
    }
    return result;
  }

  //----------------------------------------------------------------------------
  void CheckBySurface()
  {
    const SightOracle oracle(
      this->Test.Surface, this->Test.Eye, this->Test.Exterior, this->Test.Interior, this->Error);
    std::vector<double> points;
    for (const glm::dvec3& p : this->Test.Points)
    {
      const glm::dvec3 world = this->ToWorld(p);
      points.insert(points.end(), { world.x, world.y, world.z });
    }
    std::vector<VirtualVertex> first(this->Test.Points.size());
    this->Geometry.Solve(points.data(), 0, first.size(), first.data());
    const ObjectImages object = this->SolveObject(points);
    std::vector<VirtualVertex> images;
    for (std::size_t i = 0; i < this->Test.Points.size(); ++i)
    {
      ++this->Tally.Points;
      const glm::dvec3 world(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      if (this->Geometry.FindImages(world, images) == ImageState::NotFinite)
      {
        this->GetCount(&RefractionTally::Failed, i, "no answer", 0.0, 0.0);
        continue;
      }
      OracleAnswer answer = oracle.Find(this->Test.Points[i]);
      if (!answer.Complete)
      {
        ++this->Tally.GivenUp;
        continue;
      }
      this->CutHoles(answer);
      this->Tally.Uncertain += !answer.Uncertain.empty();
      this->Compare(i, answer, images);
      if (answer.Uncertain.empty())
      {
        this->CheckObject(i, object, images);
      }
      this->CheckFirst(i, answer, first[i]);
    }
    if (!this->Test.Triangles.empty())
    {
      this->Tally.Add(CheckTriangles(this->Test, this->Geometry, oracle, this->Error));
    }
  }

  // All points as one object, with the regions in which images are unique.
  ObjectImages SolveObject(const std::vector<double>& points)
  {
    this->Geometry.PrepareField();
    ObjectImages object(this->Geometry);
    object.SetPoints(points.data(), points.size() / 3, false);
    object.PrepareUnique(std::numeric_limits<std::uint32_t>::max(), 0, SerialLoop);
    object.SolvePoints(0, points.size() / 3);
    object.FinishPoints();
    return object;
  }

  // Expects the same images as those found one by one.
  void CheckObject(
    std::size_t i, const ObjectImages& object, const std::vector<VirtualVertex>& images)
  {
    std::size_t first = 0;
    for (std::size_t k = 0; k < i; ++k)
    {
      first += object.GetNumberOfImages(k);
    }
    bool same = object.GetNumberOfImages(i) == images.size();
    for (std::size_t k = 0; k < object.GetNumberOfImages(i); ++k)
    {
      const glm::dvec3 sight = object.GetPointImages()[first + k].Vertex.SightPoint;
      same = same &&
        std::any_of(images.begin(), images.end(),
          [&](const VirtualVertex& vertex)
          {
            return glm::length(vertex.SightPoint - sight) <=
              Rest * this->Test.FacetSize * this->Test.Scale + this->Rounding * this->Test.Scale;
          });
    }
    if (!same)
    {
      this->GetCount(&RefractionTally::Wrong, i, "other images as part of an object",
        this->Test.Points[i].x, this->Test.Points[i].z);
    }
  }

  void CutHoles(OracleAnswer& answer) const
  {
    std::vector<OracleImage> kept;
    for (const OracleImage& image : answer.Images)
    {
      const double band = 2.0 * image.Radius + 4.0 * this->Error.Position + 1e-7;
      const int hole = this->IsInHole(image.Sight, band);
      if (hole == 0)
      {
        answer.Uncertain.push_back({ image.Sight.x, image.Sight.z, band });
      }
      else if (hole < 0)
      {
        kept.push_back(image);
      }
    }
    answer.Images = kept;
  }

  double SlackOf(const OracleImage& image) const
  {
    return 2.0 * image.Radius + 2.0 * this->Error.Position + Rest * this->Test.FacetSize;
  }

  void Compare(std::size_t i, const OracleAnswer& answer, const std::vector<VirtualVertex>& images)
  {
    std::vector<int> matches(answer.Images.size(), 0);
    for (const VirtualVertex& vertex : images)
    {
      const glm::dvec3 sight = this->FromWorld(vertex.SightPoint);
      bool known = false;
      for (std::size_t k = 0; k < answer.Images.size(); ++k)
      {
        const OracleImage& image = answer.Images[k];
        const double distance = glm::length(image.Sight - sight);
        if (distance > this->SlackOf(image))
        {
          continue;
        }
        known = true;
        this->Tally.Largest = std::max(this->Tally.Largest, distance / this->Test.FacetSize);
        if (++matches[k] > this->Test.Layers)
        {
          this->GetCount(&RefractionTally::False, i, "an image too often", sight.x, sight.z);
        }
        if (vertex.Orientation != image.Orientation)
        {
          this->GetCount(&RefractionTally::Wrong, i, "orientation", sight.x, sight.z);
        }
      }
      this->CheckVertex(i, vertex);
      if (!known && !answer.IsUncertain(sight.x, sight.z, Rest * this->Test.FacetSize))
      {
        this->GetCount(&RefractionTally::False, i, "false image", sight.x, sight.z);
      }
    }
    for (std::size_t k = 0; k < answer.Images.size(); ++k)
    {
      ++this->Tally.Images;
      if (matches[k] == 0)
      {
        this->GetCount(&RefractionTally::Missed, i, "missed image", answer.Images[k].Sight.x,
          answer.Images[k].Sight.z);
      }
    }
  }

  void CheckFirst(std::size_t i, const OracleAnswer& answer, const VirtualVertex& vertex)
  {
    const glm::dvec3 sight = this->FromWorld(vertex.SightPoint);
    const bool found = vertex.State == ImageState::Found;
    const bool known = found &&
      std::any_of(answer.Images.begin(), answer.Images.end(),
        [&](const OracleImage& image)
        { return glm::length(image.Sight - sight) <= this->SlackOf(image); });
    const bool excused = found && answer.IsUncertain(sight.x, sight.z, Rest * this->Test.FacetSize);
    if (found && !known && !excused)
    {
      this->GetCount(&RefractionTally::False, i, "first image is none", sight.x, sight.z);
    }
    if (!found && !answer.Images.empty())
    {
      this->GetCount(&RefractionTally::Missed, i, "no first image", answer.Images[0].Sight.x,
        answer.Images[0].Sight.z);
    }
  }

  // Eq. 2.4, depth and reflectance from the sight point and the patch's normal there.
  void CheckVertex(std::size_t i, const VirtualVertex& vertex)
  {
    const glm::dvec3 point = this->Test.Points[i];
    const glm::dvec3 sight = this->FromWorld(vertex.SightPoint);
    const double depth = glm::length(point - sight);
    const glm::dvec3 way = sight - this->Test.Eye;
    const glm::dvec3 expected = this->Test.Exterior == this->Test.Interior
      ? point
      : sight + way / glm::length(way) * (depth * this->Test.Exterior / this->Test.Interior);
    const glm::dvec3 position = this->FromWorld(vertex.Position);
    // The rounding of a direction is that of its ends over its length, the distance of the eye.
    const double rounding =
      8.0 * this->Rounding * (1.0 + depth / std::min(glm::length(way), 1.0 + depth)) +
      1e-13 * (depth + glm::length(way));
    const bool right = std::fabs(vertex.Depth / this->Test.Scale - depth) <= rounding &&
      glm::length(position - expected) <= 4.0 * rounding * (1.0 + depth / glm::length(way)) &&
      vertex.Reflectance >= 0.0 && vertex.Reflectance <= 1.0;
    if (!right)
    {
      this->GetCount(&RefractionTally::Wrong, i, "virtual vertex", sight.x, sight.z);
    }
    if (this->Test.Truth == RefractionTruth::Smooth)
    {
      const glm::dvec3 normal = this->Test.Surface.GetNormal(sight.x, sight.z);
      const double cosine = -glm::dot(way, normal) / glm::length(way);
      const double turn = 2.0 * this->Error.Normal +
        2.0 * (this->Error.Position + this->Rounding) / glm::length(way) + 1e-9;
      const double ends[2] = { MakeReflectance(
                                 cosine - turn, this->Test.Exterior, this->Test.Interior),
        MakeReflectance(cosine + turn, this->Test.Exterior, this->Test.Interior) };
      // Towards normal incidence reflectance may have a shallow minimum below both ends.
      if (vertex.Reflectance > std::max(ends[0], ends[1]) + 1e-6 ||
        vertex.Reflectance < std::min(ends[0], ends[1]) - 1e-3)
      {
        this->GetCount(&RefractionTally::Wrong, i, "reflectance", sight.x, sight.z);
      }
    }
  }

  //----------------------------------------------------------------------------
  void CheckByPatches()
  {
    const glm::dvec3 origin = this->Geometry.GetMembrane().GetOrigin();
    const std::size_t facets = this->Geometry.GetMembrane().GetFacets().size();
    const PatchSearch search(this->Geometry.GetPatches(), facets, this->Test.Eye - origin,
      this->Test.Exterior, this->Test.Interior);
    std::vector<VirtualVertex> images;
    for (std::size_t i = 0; i < this->Test.Points.size(); ++i)
    {
      ++this->Tally.Points;
      const glm::dvec3 local = this->Test.Points[i] - origin;
      if (this->Geometry.FindImages(this->Test.Points[i], images) == ImageState::NotFinite)
      {
        this->GetCount(&RefractionTally::Failed, i, "no answer", 0.0, 0.0);
        continue;
      }
      for (const VirtualVertex& vertex : images)
      {
        const glm::dvec3 place = vertex.SightPoint - origin;
        this->CheckVertex(i, vertex);
        const double residual = search.Residual(local, place, vertex.Facet);
        this->Tally.Largest = std::max(this->Tally.Largest, residual);
        if (!(residual < 1e-6))
        {
          this->GetCount(&RefractionTally::False, i, "false image", place.x, place.z);
        }
      }
      this->ComparePatches(i, search.Find(local), images, origin);
    }
  }

  void ComparePatches(std::size_t i, const std::vector<PatchSearch::Sight>& sights,
    const std::vector<VirtualVertex>& images, const glm::dvec3& origin)
  {
    bool uncertain = false;
    for (const PatchSearch::Sight& sight : sights)
    {
      // Rounding decides on a caustic or a border.
      if (sight.Condition < 1e-4 || sight.Inside < 1e-9 || sight.Facing < 1e-9)
      {
        uncertain = true;
        continue;
      }
      ++this->Tally.Images;
      const bool found = std::any_of(images.begin(), images.end(),
        [&](const VirtualVertex& vertex) {
          return glm::length(vertex.SightPoint - origin - sight.Place) <
            1e-4 * this->Test.FacetSize;
        });
      if (!found)
      {
        this->GetCount(&RefractionTally::Missed, i, "missed image", sight.Place.x, sight.Place.z);
      }
    }
    this->Tally.Uncertain += uncertain;
  }

  const RefractionCase& Test;
  CurvedMembraneSolver Geometry;
  RefractionTally Tally;
  SurfaceError Error;
  double Rounding = 0.0;
};

} // anonymous namespace

//------------------------------------------------------------------------------
void RefractionTally::Add(const RefractionTally& other)
{
  this->Points += other.Points;
  this->Images += other.Images;
  this->Uncertain += other.Uncertain;
  this->GivenUp += other.GivenUp;
  this->Missed += other.Missed;
  this->False += other.False;
  this->Wrong += other.Wrong;
  this->Failed += other.Failed;
  this->Largest = std::max(this->Largest, other.Largest);
  this->RaysMissed += other.RaysMissed;
  this->RaysReflected += other.RaysReflected;
  this->Undecided += other.Undecided;
  this->RoundTrips += other.RoundTrips;
  this->LargestRoundTrip = std::max(this->LargestRoundTrip, other.LargestRoundTrip);
  if (this->First.empty())
  {
    this->First = other.First;
  }
}

//------------------------------------------------------------------------------
RefractionTally CheckCase(const RefractionCase& test)
{
  return Checker(test).Run();
}

} // namespace meniscus::test
