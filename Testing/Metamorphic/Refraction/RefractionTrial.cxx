// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionTrial.h"

namespace meniscus::test
{

namespace
{

using reference::MembraneMesh;

const double Pi = std::acos(-1.0);
constexpr int PointsPerScene = 60;

// z = sign r^2 / 2 up to a steepness in degrees, y upwards.
MembraneMesh MakeParaboloid(int rings, double steepest, double sign)
{
  MembraneMesh mesh;
  const double rim = std::tan(steepest * Pi / 180.0);
  const int around = 4 * rings;
  mesh.AddPoint(glm::dvec3(0.0), { 0.0, 1.0, 0.0 });
  for (int ring = 1; ring <= rings; ++ring)
  {
    const double r = rim * ring / rings;
    for (int i = 0; i < around; ++i)
    {
      const double x = r * std::cos(2.0 * Pi * i / around);
      const double z = r * std::sin(2.0 * Pi * i / around);
      mesh.AddPoint(
        { x, sign * r * r / 2.0, z }, glm::normalize(glm::dvec3(-sign * x, 1.0, -sign * z)));
      const std::int64_t next = 1 + (ring - 1) * around + (i + 1) % around;
      const std::int64_t own = 1 + (ring - 1) * around + i;
      if (ring == 1)
      {
        mesh.AddTriangle(0, next, own);
      }
      else
      {
        mesh.AddTriangle(own - around, next - around, next);
        mesh.AddTriangle(own - around, next, own);
      }
    }
  }
  return mesh;
}

// A closed unit sphere, with outward or inward normals.
MembraneMesh MakeSphere(int resolution, double side)
{
  MembraneMesh mesh;
  mesh.AddPoint({ 0.0, 0.0, 1.0 }, { 0.0, 0.0, side });
  mesh.AddPoint({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, -side });
  const int rings = resolution / 2 - 1;
  for (int ring = 0; ring < rings; ++ring)
  {
    const double polar = Pi * (ring + 1) / (rings + 1);
    for (int i = 0; i < resolution; ++i)
    {
      const double azimuth = 2.0 * Pi * i / resolution;
      const glm::dvec3 p(
        std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      mesh.AddPoint(p, side * p);
      const std::int64_t own = 2 + ring * resolution + i;
      const std::int64_t next = 2 + ring * resolution + (i + 1) % resolution;
      if (ring == 0)
      {
        mesh.AddTriangle(0, own, next);
      }
      else
      {
        mesh.AddTriangle(own - resolution, own, next);
        mesh.AddTriangle(own - resolution, next, next - resolution);
      }
      if (ring + 1 == rings)
      {
        mesh.AddTriangle(1, next, own);
      }
    }
  }
  return mesh;
}

void SetMembrane(RefractionScene& scene, RandomNumbers& random)
{
  switch (random.Below(5))
  {
    case 0:
    {
      scene.Family = "waves";
      const int cells = 12 + random.Below(20);
      scene.Mesh =
        reference::MakeWaves(4.0, cells, random.Uniform(0.02, 0.15), random.Uniform(1.0, 2.5));
      scene.FacetSize = 4.0 / cells;
      break;
    }
    case 1:
    {
      scene.Family = "paraboloid";
      const double steepest = random.Uniform(20.0, 80.0);
      const int rings = 6 + random.Below(14);
      scene.Mesh = MakeParaboloid(rings, steepest, random.Below(2) ? 1.0 : -1.0);
      scene.FacetSize = std::tan(steepest * Pi / 180.0) / rings;
      break;
    }
    case 2:
    {
      scene.Family = "sphere";
      const int resolution = 12 + 2 * random.Below(12);
      scene.Mesh = MakeSphere(resolution, random.Below(3) ? 1.0 : -1.0);
      scene.FacetSize = 2.0 * Pi / resolution;
      scene.IsExact = true;
      break;
    }
    case 3:
    {
      scene.Family = "noise";
      const int cells = 4 + random.Below(6);
      scene.FacetSize = 4.0 / cells;
      scene.Mesh = reference::MakeRandom(4.0, cells, scene.FacetSize * random.Uniform(0.01, 0.4),
        random.Uniform(0.01, 0.8), static_cast<unsigned>(random.Bits()));
      break;
    }
    default:
    {
      scene.Family = "plane";
      const int cells = 2 + random.Below(8);
      scene.Mesh = reference::MakeSquare(4.0, cells, 0.0);
      scene.FacetSize = 4.0 / cells;
      scene.IsExact = true;
      break;
    }
  }
}

glm::dvec3 PointOf(const MembraneMesh& mesh, std::size_t i)
{
  return { mesh.Points[3 * i], mesh.Points[3 * i + 1], mesh.Points[3 * i + 2] };
}

glm::dvec3 NormalOf(const MembraneMesh& mesh, std::size_t i)
{
  return { mesh.Normals[3 * i], mesh.Normals[3 * i + 1], mesh.Normals[3 * i + 2] };
}

double MagnitudeOf(const RefractionScene& scene)
{
  double most = glm::length(scene.Eye);
  for (const double c : scene.Mesh.Points)
  {
    most = std::max(most, std::fabs(c));
  }
  for (const glm::dvec3& p : scene.Points)
  {
    most = std::max(most, glm::length(p));
  }
  return most;
}

const VirtualVertex* NearestTo(const std::vector<VirtualVertex>& images, const glm::dvec3& sight)
{
  const auto nearest = std::min_element(images.begin(), images.end(),
    [&sight](const VirtualVertex& a, const VirtualVertex& b)
    { return glm::length(a.SightPoint - sight) < glm::length(b.SightPoint - sight); });
  return nearest == images.end() ? nullptr : &*nearest;
}

// Directions along the axes and against them.
glm::dvec3 MoveOf(int i)
{
  glm::dvec3 move(0.0);
  move[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
  return move;
}

} // anonymous namespace

//------------------------------------------------------------------------------
RefractionScene RandomScene(RandomNumbers& random)
{
  RefractionScene scene;
  SetMembrane(scene, random);
  scene.Interior = random.Uniform(1.1, 1.9);
  if (random.Below(4) == 0)
  {
    std::swap(scene.Exterior, scene.Interior);
  }
  const bool isBubble = scene.Family == "sphere" && NormalOf(scene.Mesh, 0).z < 0.0;
  scene.Eye = isBubble
    ? 0.6 * random.Uniform() * random.GetDirection()
    : glm::dvec3(random.Uniform(-2.0, 2.0), random.Uniform(1.5, 8.0), random.Uniform(-2.0, 2.0));
  const std::size_t vertices = scene.Mesh.Points.size() / 3;
  for (int i = 0; i < PointsPerScene; ++i)
  {
    const auto at = static_cast<std::size_t>(random.Below(static_cast<int>(vertices)));
    const double depth = std::pow(10.0, random.Uniform(-2.0, 0.5));
    const double side = random.Below(3) == 0 ? 1.0 : -1.0;
    scene.Points.push_back(PointOf(scene.Mesh, at) + side * depth * NormalOf(scene.Mesh, at) +
      0.5 * scene.FacetSize * random.GetDirection());
  }
  return scene;
}

//------------------------------------------------------------------------------
std::unique_ptr<CurvedMembraneSolver> MakeGeometry(const RefractionScene& scene)
{
  auto geometry = std::make_unique<CurvedMembraneSolver>();
  if (geometry->SetMembrane(scene.Mesh.AsInput()) != MembraneStatus::Ready ||
    geometry->SetEye(scene.Eye, scene.Exterior, scene.Interior) != EyeStatus::Ready)
  {
    return nullptr;
  }
  geometry->PrepareSides();
  return geometry;
}

//------------------------------------------------------------------------------
RefractionScene Motion::Apply(const RefractionScene& scene) const
{
  RefractionScene moved = scene;
  moved.Mesh.Points.clear();
  moved.Mesh.Normals.clear();
  for (std::size_t i = 0; i < scene.Mesh.Points.size() / 3; ++i)
  {
    moved.Mesh.AddPoint(this->Apply(PointOf(scene.Mesh, i)), this->Turn * NormalOf(scene.Mesh, i));
  }
  moved.FacetSize *= this->Scale;
  moved.Eye = this->Apply(scene.Eye);
  for (glm::dvec3& point : moved.Points)
  {
    point = this->Apply(point);
  }
  return moved;
}

//------------------------------------------------------------------------------
RefractionTrial::RefractionTrial(const RefractionScene& scene)
  : Scene(scene)
  , Geometry(MakeGeometry(scene))
{
  this->Tally.Scenes = 1;
}

//------------------------------------------------------------------------------
void RefractionTrial::Fail(const std::string& words)
{
  this->Tally.Failures = 1;
  if (this->Tally.FirstFailure.empty())
  {
    this->Tally.FirstFailure = this->Scene.Family + ": " + words;
  }
}

//------------------------------------------------------------------------------
double RefractionTrial::ErrorOf(double magnitude, double depth, std::int32_t facet) const
{
  double bend = 0.0;
  if (facet != CurvedPatches::NoFacet)
  {
    for (const glm::dvec3& b : this->Geometry->GetPatches().GetPatch(facet).Bend)
    {
      bend = std::max(bend, glm::length(b));
    }
  }
  return 0x1p-24 * bend * (this->Scene.FacetSize + depth) + 1e-9 * this->Scene.FacetSize +
    64.0 * std::numeric_limits<double>::epsilon() * magnitude *
    (1.0 + depth / this->Scene.FacetSize);
}

//------------------------------------------------------------------------------
// True if the image of a point that is moved is near the previous one and has the same orientation.
bool RefractionTrial::IsSteady(
  const glm::dvec3& point, const VirtualVertex& image, double error, double& sensitivity) const
{
  const double move = 1000.0 * error;
  std::vector<VirtualVertex> images;
  for (int i = 0; i < 6; ++i)
  {
    this->Geometry->FindImages(point + move * MoveOf(i), images);
    const VirtualVertex* other = NearestTo(images, image.SightPoint);
    if (!other || glm::length(other->SightPoint - image.SightPoint) > 0.1 * this->Scene.FacetSize ||
      other->Orientation != image.Orientation)
    {
      return false;
    }
    sensitivity = std::max(sensitivity, glm::length(other->Position - image.Position) / move);
  }
  return true;
}

//------------------------------------------------------------------------------
bool RefractionTrial::IsSideSteady(const glm::dvec3& point, double error) const
{
  const glm::dvec3 local = point - this->Geometry->GetMembrane().GetOrigin();
  const bool front = this->Geometry->IsInFront(local);
  for (int i = 0; i < 6; ++i)
  {
    if (this->Geometry->IsInFront(local + 1000.0 * error * MoveOf(i)) != front)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void RefractionTrial::Compare(const RefractionScene& changed, const Motion& motion,
  const std::function<bool(const VirtualVertex&)>& shows)
{
  const auto geometry = MakeGeometry(changed);
  if (!geometry || !this->Geometry)
  {
    // An eye on the membrane must be rejected by both, or by none.
    if (!geometry != !this->Geometry)
    {
      this->Fail("one of the scenes is refused");
    }
    return;
  }
  this->Compare(*geometry, motion, MagnitudeOf(changed) / motion.Scale, shows);
}

//------------------------------------------------------------------------------
void RefractionTrial::Compare(const CurvedMembraneSolver& changed, const Motion& motion,
  double magnitude, const std::function<bool(const VirtualVertex&)>& shows)
{
  ++this->Tally.Comparisons;
  std::vector<VirtualVertex> images;
  std::vector<VirtualVertex> others;
  for (const glm::dvec3& point : this->Scene.Points)
  {
    const glm::dvec3 moved = motion.Apply(point);
    this->Geometry->FindImages(point, images);
    changed.FindImages(moved, others);
    for (const VirtualVertex& image : images)
    {
      if (shows && !shows(image))
      {
        continue;
      }
      const double error = this->ErrorOf(magnitude, image.Depth, image.Facet);
      double sensitivity = 1.0;
      if (!this->IsSteady(point, image, error, sensitivity))
      {
        ++this->Tally.Conditioned;
        continue;
      }
      const VirtualVertex* other = NearestTo(others, motion.Apply(image.SightPoint));
      const double deviation = other ? glm::length(motion.Undo(other->Position) - image.Position)
                                     : std::numeric_limits<double>::infinity();
      if (!this->Tally.Compare(deviation, sensitivity * error))
      {
        this->Fail("an image is off by " + std::to_string(deviation));
      }
    }
    if (shows)
    {
      continue; // sides are defined for the whole membrane only
    }
    const bool front = this->Geometry->IsInFront(point - this->Geometry->GetMembrane().GetOrigin());
    const bool same = front == changed.IsInFront(moved - changed.GetMembrane().GetOrigin());
    if (!same && !this->IsSideSteady(point, this->ErrorOf(magnitude, 0.0, CurvedPatches::NoFacet)))
    {
      ++this->Tally.Conditioned;
    }
    else if (!this->Tally.Compare(same ? 0.0 : 1.0, 0.5))
    {
      this->Fail("a point is on another side");
    }
  }
}

//------------------------------------------------------------------------------
void RefractionTrial::CompareFirst(const std::vector<std::size_t>& order)
{
  if (!this->Geometry)
  {
    return;
  }
  ++this->Tally.Comparisons;
  std::vector<glm::dvec3> points;
  for (const std::size_t i : order)
  {
    points.push_back(this->Scene.Points[i]);
  }
  std::vector<VirtualVertex> first(points.size());
  this->Geometry->Solve(&points[0].x, 0, points.size(), first.data());
  std::vector<VirtualVertex> images;
  const double magnitude = MagnitudeOf(this->Scene);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    this->Geometry->FindImages(points[i], images);
    const bool isFound = first[i].State == ImageState::Found;
    const VirtualVertex* same = isFound ? NearestTo(images, first[i].SightPoint) : nullptr;
    const VirtualVertex& judged = isFound || images.empty() ? first[i] : images[0];
    const double error = this->ErrorOf(magnitude, judged.Depth, judged.Facet);
    double sensitivity = 1.0;
    if ((isFound || !images.empty()) && !this->IsSteady(points[i], judged, error, sensitivity))
    {
      ++this->Tally.Conditioned;
      continue;
    }
    const double deviation = same ? glm::length(same->Position - first[i].Position)
                                  : (isFound || !images.empty() ? 1e30 : 0.0);
    if (!this->Tally.Compare(deviation, sensitivity * error))
    {
      this->Fail("the first image is none of all");
    }
  }
}

} // namespace meniscus::test
