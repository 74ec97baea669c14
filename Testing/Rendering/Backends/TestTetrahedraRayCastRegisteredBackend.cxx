// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A backend registered from outside the library, with installed headers only, against the analytic
// length of each ray within a box. Documentation/extending.md follows it.
#include "RayCastScene.h"
#include "ReferenceOptics.h"

#include <RayCastBackend.h>
#include <RayCastBackendRegistry.h>

using namespace meniscus::test;

namespace
{

constexpr double Range[2] = { -1.0, 1.0 };
constexpr int Width = 61;
constexpr int Height = 47;

using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector At(const meniscus::RayCastAffineMap& map, double i, double j)
{
  Vector result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = map.Base[axis] + i * map.PerColumn[axis] + j * map.PerRow[axis];
  }
  return result;
}

/** Range of depths of a ray that lies within a tetrahedron; empty if first > last. */
struct DepthRange
{
  double First;
  double Last;
};

DepthRange Clip(const std::array<Vector, 4>& corners, const Vector& origin, const Vector& direction,
  DepthRange range)
{
  for (int i = 0; i < 4; ++i)
  {
    const Vector& a = corners[(i + 1) % 4];
    const Vector outside = Cross(corners[(i + 2) % 4] - a, corners[(i + 3) % 4] - a);
    // The side of the face that corner i is on counts.
    const double sign = Dot(outside, corners[i] - a) < 0.0 ? -1.0 : 1.0;
    const double start = sign * Dot(outside, origin - a);
    const double slope = sign * Dot(outside, direction);
    if (slope == 0.0)
    {
      range.Last = start < 0.0 ? range.First - 1.0 : range.Last;
      continue;
    }
    (slope > 0.0 ? range.First : range.Last) =
      slope > 0.0 ? std::max(range.First, -start / slope) : std::min(range.Last, -start / slope);
  }
  return range;
}

/** Orders of the tests to a backend, and its reports to them. */
struct Talk
{
  std::string Reason;
  bool Automatic = true;
  int MeshCopies = 0;
  int ScalarCopies = 0;
  int StatisticsReads = 0;
};

/** Draws as grey how long each ray is within the mesh, in world units. */
class PathLengthBackend : public meniscus::RayCastBackend
{
public:
  explicit PathLengthBackend(Talk& talk)
    : Tester(talk)
  {
  }

  std::string CanDraw(const meniscus::RayCastRequest& request) override
  {
    return request.GetFeatures().Membrane ? "path lengths know no membrane" : this->Tester.Reason;
  }

  bool IsAutomatic(const meniscus::RayCastRequest&) override { return this->Tester.Automatic; }

  std::string Update(const meniscus::RayCastRequest& request) override
  {
    const meniscus::RayCastMesh mesh = request.GetMesh();
    if (mesh.MeshVersion != this->MeshVersion)
    {
      this->Cells.clear();
      for (std::int64_t c = 0; c < mesh.NumberOfCells; ++c)
      {
        this->Cells.emplace_back();
        for (int i = 0; i < 4; ++i)
        {
          const std::int32_t* position = mesh.Positions + 3 * mesh.Cells[8 * c + i];
          for (int axis = 0; axis < 3; ++axis)
          {
            this->Cells.back()[i][axis] = mesh.PositionUnit * position[axis];
          }
        }
      }
      this->MeshVersion = mesh.MeshVersion;
      ++this->Tester.MeshCopies;
    }
    this->Tester.ScalarCopies += mesh.ScalarVersion != this->ScalarVersion ? 1 : 0;
    this->ScalarVersion = mesh.ScalarVersion;
    return std::string();
  }

  std::string Cast(
    const meniscus::RayCastRequest& request, meniscus::RayCastTarget& target) override
  {
    const meniscus::RayCastRays rays = request.GetRays();
    const std::vector<float>& depths = target.ReadDepths();
    std::vector<float> image;
    this->Statistics = meniscus::RayCastStatistics();
    for (const auto& [row, column] : Product(rays.Height, rays.Width))
    {
      const double i = column + 0.5 - 0.5 * rays.Width;
      const double j = row + 0.5 - 0.5 * rays.Height;
      const double w = 2.0 * depths[image.size() / 4] - 1.0;
      const double end = (w * rays.DepthNumerator[0] + rays.DepthNumerator[1]) /
        (w * rays.DepthDenominator[0] + rays.DepthDenominator[1]);
      const auto length = static_cast<float>(
        this->LengthOf(At(rays.Origin, i, j), At(rays.Direction, i, j), { rays.NearDepth, end }) *
        GetWorldLength(rays, At(rays.Direction, i, j)));
      image.insert(image.end(), { length, length, length, length > 0.0f ? 1.0f : 0.0f });
    }
    return target.WriteImage(image);
  }

  meniscus::RayCastStatistics GetStatistics() override
  {
    ++this->Tester.StatisticsReads;
    return this->Statistics;
  }

  meniscus::RayCastCounters GetCounters() override
  {
    meniscus::RayCastCounters counters;
    counters.HostBytes = static_cast<std::int64_t>(this->Cells.size() * sizeof(this->Cells[0]));
    return counters;
  }

private:
  static double GetWorldLength(const meniscus::RayCastRays& rays, const Vector& direction)
  {
    Vector world;
    for (int row = 0; row < 3; ++row)
    {
      const double* values = rays.ModelToWorld[row];
      world[row] = Dot({ values[0], values[1], values[2] }, direction);
    }
    return std::sqrt(Dot(world, world));
  }

  double LengthOf(const Vector& origin, const Vector& direction, const DepthRange& range)
  {
    double length = 0.0;
    std::int64_t crossed = 0;
    for (const std::array<Vector, 4>& corners : this->Cells)
    {
      const DepthRange inside = Clip(corners, origin, direction, range);
      crossed += inside.First < inside.Last ? 1 : 0;
      length += std::max(inside.Last - inside.First, 0.0);
    }
    this->Statistics.Steps += crossed;
    this->Statistics.Rays += crossed > 0 ? 1 : 0;
    return length;
  }

  Talk& Tester;
  std::vector<std::array<Vector, 4>> Cells;
  meniscus::TableVersion MeshVersion;
  meniscus::TableVersion ScalarVersion;
  meniscus::RayCastStatistics Statistics;
};

/** Length of a ray within the box [-1, 1]^3 of a volume's model coordinates, in world units. */
double LengthInBox(const meniscus::reference::Ray& ray, vtkMatrix4x4* modelToWorld)
{
  vtkNew<vtkMatrix4x4> inverse;
  vtkMatrix4x4::Invert(modelToWorld, inverse);
  const double origin[4] = { ray.Origin[0], ray.Origin[1], ray.Origin[2], 1.0 };
  const double direction[4] = { ray.Direction[0], ray.Direction[1], ray.Direction[2], 0.0 };
  double o[4];
  double d[4];
  inverse->MultiplyPoint(origin, o);
  inverse->MultiplyPoint(direction, d);
  const meniscus::reference::Ray inside =
    meniscus::reference::ClipToCube({ { o[0], o[1], o[2] }, { d[0], d[1], d[2] }, 0.0, 1e30 });
  return std::max(inside.End - inside.Begin, 0.0) * vtkMath::Norm(ray.Direction.data());
}

/** A box of 6 * 3^3 tetrahedra, and the backend registered as long as the test runs. */
class TetrahedraRayCastRegisteredBackend : public ::testing::Test
{
protected:
  TetrahedraRayCastRegisteredBackend()
    : Mesh(MakeBlock(3, WavyField(3.0)))
    , Scene(this->Mesh, MakeProperty(FunctionKind::Smooth, Range, 3.4), Width, Height)
    , Mapper(this->Scene.GetRayCaster())
    , Observer(vtkSmartPointer<ErrorObserver>::Take(ErrorObserver::New()))
  {
    this->Registered =
      meniscus::RegisterRayCastBackend({ "Path length", [this](meniscus::RayCastSharing&) {
                                          return std::make_unique<PathLengthBackend>(this->Words);
                                        } });
    this->Observer->Observe(this->Mapper);
    this->Scene.GetVolume()->SetOrientation(20.0, 10.0, 5.0);
    this->Scene.GetVolume()->SetScale(1.5, 1.2, 0.9);
    this->Scene.GetVolume()->SetPosition(0.3, -0.2, 0.1);
    LookAt(this->Scene.GetRenderer(), this->Scene.GetVolume()->GetBounds(), 30.0, 20.0, 1.5);
    this->Mapper->SetBackend(vtkTetrahedraRayCastMapper::AUTOMATIC);
  }
  ~TetrahedraRayCastRegisteredBackend() override
  {
    meniscus::UnregisterRayCastBackend("Path length");
  }

  std::string DrawnBy()
  {
    this->Scene.GetWindow()->Render();
    return this->Mapper->GetActiveBackendName();
  }

  /** Name of the backend that AUTOMATIC chooses if none is registered. */
  std::string OwnBackend()
  {
    const bool software = DeviceName(this->Scene.GetWindow()).find("llvmpipe") != std::string::npos;
    return software ? "Native" : "Compute";
  }

  Talk Words;
  bool Registered = false;
  Grid Mesh;
  RayCastScene Scene;
  vtkTetrahedraRayCastMapper* Mapper;
  vtkSmartPointer<ErrorObserver> Observer;
};

} // anonymous namespace

TEST_F(TetrahedraRayCastRegisteredBackend, DrawsTheLengthsOfRaysInABox)
{
  // Lengths are below 8: rounded to float they are off by at most 2^-22. Positions are rounded to
  // 2^-31 of the radius, 2.6, at both ends of a ray that meets no side flatter than 1 : 20: 5e-8.
  constexpr double tolerance = 1.0 / (1 << 22) + 5e-8;
  ASSERT_TRUE(this->Registered);
  this->Mapper->SetBackendName("Path length");
  this->Scene.GetWindow()->Render();
  const FloatImage image = this->Scene.RenderFloat();
  EXPECT_EQ(this->Mapper->GetActiveBackend(), int(vtkTetrahedraRayCastMapper::REGISTERED));
  EXPECT_STREQ(this->Mapper->GetActiveBackendName(), "Path length");
  const PixelRays rays(this->Scene.GetRenderer());
  ASSERT_EQ(image.Width, rays.GetWidth());
  ASSERT_EQ(image.Height, rays.GetHeight());
  double longest = 0.0;
  std::int64_t hits = 0;
  for (const auto& [y, x] : Product(image.Height, image.Width))
  {
    const double expected = LengthInBox(rays.GetRay(x, y), this->Scene.GetVolume()->GetMatrix());
    ASSERT_NEAR(image.GetPixel(x, y)[0], expected, tolerance) << x << ", " << y;
    longest = std::max(longest, expected);
    hits += expected > tolerance ? 1 : 0;
  }
  // A ray through the middle crosses at least the thinnest extent.
  EXPECT_GT(longest, 2.0 * 0.9);
  EXPECT_GT(hits, Width * Height / 4);
  EXPECT_NEAR(static_cast<double>(this->Mapper->GetNumberOfRays()), static_cast<double>(hits), 2.0);
  EXPECT_TRUE(this->Observer->Warnings.empty()) << this->Observer->Warnings[0];
  EXPECT_TRUE(this->Observer->Errors.empty()) << this->Observer->GetText();
}

TEST_F(TetrahedraRayCastRegisteredBackend, AutomaticAsksItFirstAndReportsItsReason)
{
  EXPECT_EQ(this->DrawnBy(), "Path length");
  this->Words.Automatic = false;
  EXPECT_EQ(this->DrawnBy(), this->OwnBackend());
  EXPECT_TRUE(this->Observer->Warnings.empty()) << "not asked";
  this->Words.Automatic = true;
  this->Words.Reason = "it is out of ink";
  EXPECT_EQ(this->DrawnBy(), this->OwnBackend());
  ASSERT_EQ(this->Observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(this->Observer->Warnings[0], "it is out of ink"));
  EXPECT_TRUE(HasText(this->Observer->Warnings[0], this->OwnBackend()));
  const FloatImage other = this->Scene.RenderFloat();
  EXPECT_EQ(this->Observer->Warnings.size(), 1u) << "said once";
  this->Words.Reason.clear();
  EXPECT_EQ(this->DrawnBy(), "Path length");
  // The picture of the fallback is that of the library's own backend.
  meniscus::UnregisterRayCastBackend("Path length");
  EXPECT_EQ(this->DrawnBy(), this->OwnBackend());
  EXPECT_EQ(this->Scene.RenderFloat().Rgba, other.Rgba);
  EXPECT_TRUE(this->Observer->Errors.empty()) << this->Observer->GetText();
}

TEST_F(TetrahedraRayCastRegisteredBackend, NamesTakePrecedenceAndFallBack)
{
  this->Mapper->SetBackend(vtkTetrahedraRayCastMapper::NATIVE);
  EXPECT_EQ(this->DrawnBy(), "Native") << "asked for by number";
  this->Mapper->SetBackendName("OpenGL");
  EXPECT_EQ(this->DrawnBy(), "OpenGL");
  EXPECT_EQ(this->Mapper->GetActiveBackend(), int(vtkTetrahedraRayCastMapper::OPENGL));
  this->Mapper->SetBackendName("");
  EXPECT_EQ(this->DrawnBy(), "Native");
  EXPECT_TRUE(this->Observer->Warnings.empty());
  this->Words.Automatic = false;
  this->Mapper->SetBackendName("No such");
  EXPECT_EQ(this->DrawnBy(), this->OwnBackend());
  ASSERT_EQ(this->Observer->Warnings.size(), 1u);
  EXPECT_TRUE(HasText(this->Observer->Warnings[0], "No such"));
  this->Words.Reason = "it is out of ink";
  this->Mapper->SetBackendName("Path length");
  EXPECT_EQ(this->DrawnBy(), this->OwnBackend());
  ASSERT_EQ(this->Observer->Warnings.size(), 2u);
  EXPECT_TRUE(HasText(this->Observer->Warnings[1], "it is out of ink"));
  EXPECT_TRUE(this->Observer->Errors.empty()) << this->Observer->GetText();
}

TEST_F(TetrahedraRayCastRegisteredBackend, TablesAreTakenOncePerVersion)
{
  this->Mapper->SetBackendName("Path length");
  const double before = this->Mapper->GetStatistic("HostBytes");
  this->Scene.GetWindow()->Render();
  this->Scene.GetRenderer()->GetActiveCamera()->Azimuth(10.0);
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Words.MeshCopies, 1);
  EXPECT_EQ(this->Words.ScalarCopies, 1);
  EXPECT_GE(this->Mapper->GetStatistic("HostBytes") - before, 96 * this->Mesh->GetNumberOfCells());
  vtkDataArray* scalars = this->Mesh->GetPointData()->GetScalars();
  scalars->SetComponent(0, 0, 0.5 * scalars->GetComponent(0, 0) + 0.1);
  scalars->Modified();
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Words.MeshCopies, 1);
  EXPECT_EQ(this->Words.ScalarCopies, 2);
  this->Mesh->GetPoints()->SetPoint(0, -1.1, -1.1, -1.1);
  this->Mesh->GetPoints()->Modified();
  this->Scene.GetWindow()->Render();
  EXPECT_EQ(this->Words.MeshCopies, 2);
}

// A device reads back as many numbers for them as for an image.
TEST_F(TetrahedraRayCastRegisteredBackend, StatisticsAreReadOnDemand)
{
  EXPECT_EQ(this->DrawnBy(), "Path length");
  EXPECT_EQ(this->Words.StatisticsReads, 0);
  EXPECT_GT(this->Mapper->GetNumberOfRays(), 0);
  EXPECT_EQ(this->Words.StatisticsReads, 1);
}

TEST_F(TetrahedraRayCastRegisteredBackend, NamesAreTakenOnce)
{
  const auto make = [this](meniscus::RayCastSharing&)
  { return std::make_unique<PathLengthBackend>(this->Words); };
  EXPECT_FALSE(meniscus::RegisterRayCastBackend({ "Path length", make }));
  EXPECT_FALSE(meniscus::RegisterRayCastBackend({ "Native", make }));
  EXPECT_FALSE(meniscus::RegisterRayCastBackend({ "", make }));
  EXPECT_FALSE(meniscus::RegisterRayCastBackend({ "Nothing", nullptr }));
  EXPECT_FALSE(meniscus::UnregisterRayCastBackend("Native"));
  EXPECT_FALSE(meniscus::UnregisterRayCastBackend("No such"));
  std::vector<std::string> names;
  for (const auto& entry : meniscus::ListRayCastBackends())
  {
    names.push_back(entry->Name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{ "Path length", "Compute", "OpenGL", "Native" }));
}
