// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StressBentLight.h"

#include "Volume/Caster/PacketTables.h"
#include "Volume/Graded/OpaqueTriangles.h"

namespace meniscus::test
{
namespace
{

/**
 * Numbers of pieces of equal time of an arc. The sag of a piece is that of the arc over the square
 * of the number; the second number is taken where the first does not do, as in slivers, in which
 * scalars change a lot across the arc.
 */
constexpr int PiecesOfArc[] = { 256, 16384 };

/** Largest error of a channel of the ray caster's pictures. */
constexpr double PictureError = 2.0e-5;

/** Cuts the path of a ray into pieces along which the scalar is taken as linear. */
class PathVisitor : public GradedRayVisitor
{
public:
  PathVisitor(const TetrahedralMesh& mesh, const std::vector<float>& scalars, int pieces)
    : Mesh(mesh)
    , Scalars(scalars)
    , Pieces(pieces)
  {
  }

  bool VisitLeg(const GradedLeg&) override { return true; }
  bool VisitArc(GradedArc& arc) override
  {
    const double passed = this->Reached - arc.BeginPath;
    this->Reached = std::max(this->Reached, std::max(arc.BeginPath, arc.EndPath));
    if (!(arc.EndPath > arc.BeginPath + std::max(passed, 0.0)))
    {
      return true;
    }
    const double first = std::max(passed, 0.0) / (arc.EndPath - arc.BeginPath);
    const auto& vertices = this->Mesh.GetCells()[static_cast<std::size_t>(arc.Cell)].Vertices;
    const auto scalarAt = [&](const std::array<double, 4>& weights)
    {
      double sum = 0.0;
      for (std::size_t i = 0; i < weights.size(); ++i)
      {
        sum += weights[i] * this->Scalars[static_cast<std::size_t>(vertices[i])];
      }
      return sum;
    };
    glm::dvec3 place = arc.At(first);
    double scalar = scalarAt(arc.WeightsAt(first));
    for (int i = 1; i <= this->Pieces; ++i)
    {
      const double share = first + (1.0 - first) * i / this->Pieces;
      const glm::dvec3 next = arc.At(share);
      const double scalarThere = scalarAt(arc.WeightsAt(share));
      const double end = this->Length + this->Mesh.GetRadius() * glm::distance(place, next);
      this->Segments.push_back({ this->Length, end, scalar, scalarThere, arc.Cell });
      this->Length = end;
      place = next;
      scalar = scalarThere;
    }
    return true;
  }

  std::vector<reference::RaySegment> Segments;

private:
  const TetrahedralMesh& Mesh;
  const std::vector<float>& Scalars;
  int Pieces;
  double Length = 0.0;
  /** Largest optical path reached: the part before it is not passed again. */
  double Reached = 0.0;
};

}

//------------------------------------------------------------------------------
StressBentLight::StressBentLight(const TetrahedralMesh& mesh, RandomNumbers& random)
  : Mesh(mesh)
{
  for (std::int64_t v = 0; v < mesh.GetNumberOfVertices(); ++v)
  {
    this->Scalars.push_back(static_cast<float>(random.Uniform(-1.0, 1.0)));
  }
  this->Flags.assign(mesh.GetCells().size(), HasLight);
  std::vector<TransferFunctionPoint> points;
  std::vector<reference::TransferFunctionNode> nodes;
  for (const double scalar : { -0.9, random.Uniform(-0.8, 0.0), random.Uniform(0.0, 0.8), 0.9 })
  {
    const double attenuation = random.Uniform() / mesh.GetRadius();
    const glm::dvec3 color{ random.Uniform(), random.Uniform(), random.Uniform() };
    points.push_back({ scalar, attenuation, color });
    nodes.push_back({ scalar, { attenuation, { color.r, color.g, color.b } } });
  }
  this->Function = reference::ReferenceTransferFunction(nodes);
  this->Intervals = PackIntervals(BuildIntervals(points, ScalarNormalization()));
  this->Light.Mesh = &mesh;
  this->Light.Scalars = &this->Scalars;
  this->Light.Intervals = &this->Intervals;
}

//------------------------------------------------------------------------------
std::string StressBentLight::Judge(const GradedMedium& medium, const GradedRay& ray) const
{
  const GradedRayWalk walk(medium);
  GradedRayStatistics statistics;
  OpaqueSight sight;
  SeeTriangles(
    walk, OpaqueTriangles(), &this->Flags, { ray }, statistics, &sight, nullptr, &this->Light);
  std::string fault;
  for (const int pieces : PiecesOfArc)
  {
    PathVisitor path(this->Mesh, this->Scalars, pieces);
    walk.Follow(ray, statistics, path);
    fault = this->Compare(sight.Light, path.Segments);
    if (fault.empty())
    {
      break;
    }
  }
  return fault;
}

//------------------------------------------------------------------------------
/** Compares light with that of the pieces of a path; returns an empty text if it is right. */
std::string StressBentLight::Compare(
  const KeptLight& light, const std::vector<reference::RaySegment>& segments) const
{
  const reference::Ray along{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  const std::array<double, 4> truth =
    reference::ReferenceRayIntegrator::Integrate(along, segments, this->Function);
  for (std::size_t k = 0; k < 4; ++k)
  {
    const double found = k < 3 ? light.Values[k] : 1.0 - light.Values[3];
    if (!(std::abs(found - truth[k]) <= PictureError))
    {
      std::ostringstream text;
      text << "light " << found << " instead of " << truth[k];
      return text.str();
    }
  }
  return "";
}

} // namespace meniscus::test
