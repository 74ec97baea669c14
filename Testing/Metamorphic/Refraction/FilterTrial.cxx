// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterTrial.h"

#include "vtkRefractedGeometryFilter.h"

namespace meniscus::test
{

namespace
{

constexpr double Nowhere = std::numeric_limits<double>::infinity();
const double Pi = std::acos(-1.0);
constexpr int SamplesPerPicture = 40;

glm::dvec3 GetAxis(int i)
{
  glm::dvec3 axis(0.0);
  axis[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
  return axis;
}

double GetMagnitude(const FilterScene& scene, const Motion& motion)
{
  double most = glm::length(scene.Base.Eye);
  for (const double c : scene.Base.Mesh.Points)
  {
    most = std::max(most, std::fabs(c));
  }
  return most + glm::length(motion.Offset) / motion.Scale;
}

bool AreEqual(vtkDataArray* a, vtkDataArray* b)
{
  if (!a || !b || a->GetNumberOfTuples() != b->GetNumberOfTuples() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents())
  {
    return a == b;
  }
  for (const auto& [i, k] :
    Product(Below<vtkIdType>(a->GetNumberOfTuples()), a->GetNumberOfComponents()))
  {
    const double x = a->GetComponent(i, k);
    const double y = b->GetComponent(i, k);
    if (!(x == y || (std::isnan(x) && std::isnan(y))))
    {
      return false;
    }
  }
  return true;
}

bool HaveEqualArrays(vtkDataSetAttributes* a, vtkDataSetAttributes* b)
{
  bool same = a->GetNumberOfArrays() == b->GetNumberOfArrays();
  for (int i = 0; same && i < a->GetNumberOfArrays(); ++i)
  {
    same = AreEqual(a->GetArray(i), b->GetArray(a->GetArrayName(i)));
  }
  return same;
}

} // anonymous namespace

/** Triangles of an output as seen from the eye, with the places that their corners show. */
struct FilterTrial::Sheet
{
  struct Piece
  {
    std::array<glm::dvec3, 3> Seen; ///< relative to the eye
    std::array<glm::dvec3, 3> Place;
    glm::dvec3 Axis;
    double Cosine; ///< of the cone about the axis that holds the piece

    // Barycentric coordinates where a direction meets the piece's plane. The edge functions of two
    // pieces with a common side are opposite bit by bit, so no direction passes between them.
    glm::dvec3 GetWeights(const glm::dvec3& direction) const
    {
      return { glm::dot(direction, glm::cross(Seen[1], Seen[2])),
        glm::dot(direction, glm::cross(Seen[2], Seen[0])),
        glm::dot(direction, glm::cross(Seen[0], Seen[1])) };
    }
    glm::dvec3 GetPlace(const glm::dvec3& weights) const
    {
      const double sum = weights.x + weights.y + weights.z;
      return (weights.x * Place[0] + weights.y * Place[1] + weights.z * Place[2]) / sum;
    }
    bool Holds(const glm::dvec3& weights) const
    {
      return (weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0) ||
        (weights.x <= 0.0 && weights.y <= 0.0 && weights.z <= 0.0);
    }
    // Largest move of the shown place when the direction moves by an angle.
    double GetReach(const glm::dvec3& direction, double angle) const
    {
      const glm::dvec3 middle = this->GetPlace(this->GetWeights(direction));
      double reach = 0.0;
      VisitRing(direction, angle, 8,
        [this, &middle, &reach](const glm::dvec3& near)
        { reach = std::max(reach, glm::length(this->GetPlace(this->GetWeights(near)) - middle)); });
      return reach;
    }
    // True if the piece shows an area of the object, rather than closing a seam.
    bool HasArea() const
    {
      const glm::dvec3 u = this->Place[1] - this->Place[0];
      const glm::dvec3 v = this->Place[2] - this->Place[0];
      return glm::length(glm::cross(u, v)) > 1e-6 * (glm::dot(u, u) + glm::dot(v, v));
    }
  };

  std::vector<Piece> Pieces;

  Sheet(vtkPolyData* data, const Motion& motion, const glm::dvec3& eye)
  {
    const auto seen = [data, &motion, &eye](vtkIdType id)
    {
      const glm::dvec3 p = PointOf(data, id);
      return motion.Undo(p) - eye;
    };
    vtkNew<vtkIdList> ids;
    vtkCellArray* polys = data->GetPolys();
    for (vtkIdType cell = 0; cell < polys->GetNumberOfCells(); ++cell)
    {
      polys->GetCellAtId(cell, ids);
      for (vtkIdType k = 2; k < ids->GetNumberOfIds(); ++k)
      {
        Piece piece;
        const vtkIdType corners[3] = { ids->GetId(0), ids->GetId(k - 1), ids->GetId(k) };
        piece.Axis = glm::dvec3(0.0);
        for (std::size_t i = 0; i < 3; ++i)
        {
          piece.Seen[i] = seen(corners[i]);
          piece.Place[i] = GetTuple(data, "Truth", corners[i]);
          piece.Axis += glm::normalize(piece.Seen[i]);
        }
        piece.Axis = glm::normalize(piece.Axis);
        piece.Cosine = 1.0;
        for (const glm::dvec3& corner : piece.Seen)
        {
          piece.Cosine = std::min(piece.Cosine, glm::dot(piece.Axis, glm::normalize(corner)));
        }
        this->Pieces.push_back(piece);
      }
    }
  }

  template <typename Visit>
  static void VisitRing(const glm::dvec3& direction, double angle, int count, const Visit& visit)
  {
    const glm::dvec3 across =
      std::fabs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(direction, across));
    const glm::dvec3 up = glm::cross(right, direction);
    for (int k = 0; k < count; ++k)
    {
      const double turn = 2.0 * Pi * k / count;
      visit(glm::normalize(direction + angle * (std::cos(turn) * right + std::sin(turn) * up)));
    }
  }
};

//------------------------------------------------------------------------------
FilterTrial::FilterTrial(const FilterScene& scene)
  : Scene(scene)
  , Solver(MakeGeometry(scene.Base))
  , Errors(scene.Base)
{
  this->Tally.Scenes = 1;
  if (this->Solver)
  {
    // The largest deviation of normals stands for those of all facets.
    const auto count = static_cast<std::int32_t>(this->Solver->GetMembrane().GetFacets().size());
    for (std::int32_t facet = 0; facet < count; ++facet)
    {
      this->Worst = this->GetError(1.0, 1.0, facet) > this->GetError(1.0, 1.0, this->Worst)
        ? facet
        : this->Worst;
    }
  }
}

//------------------------------------------------------------------------------
double FilterTrial::GetError(double magnitude, double depth, std::int32_t facet) const
{
  return this->Errors.ErrorOf(magnitude, depth, facet);
}

//------------------------------------------------------------------------------
void FilterTrial::Fail(const std::string& words)
{
  this->Tally.Failures = 1;
  if (this->Tally.FirstFailure.empty())
  {
    const char* const modes[] = { "flat facets", "first image", "all images" };
    this->Tally.FirstFailure =
      this->Scene.Base.Family + ", " + modes[static_cast<int>(this->Scene.Mode)] + ": " + words;
  }
}

//------------------------------------------------------------------------------
vtkPolyData* FilterTrial::GetBase()
{
  if (!this->Base)
  {
    const auto object = MakeObject(this->Scene);
    const auto membrane = MakeMembraneData(this->Scene.Base.Mesh);
    this->Base = GetResult(MakeSceneFilter(this->Scene, object, membrane));
  }
  return this->Base;
}

//------------------------------------------------------------------------------
void FilterTrial::Compare(vtkPolyData* changed, const Motion& motion, RandomNumbers& random,
  const std::function<bool(const glm::dvec3& direction)>& isInView)
{
  ++this->Tally.Comparisons;
  if (this->Scene.Mode != FilterMode::AllImages)
  {
    this->ComparePoints(changed, motion);
    return;
  }
  const Sheet first(this->GetBase(), Motion(), this->Scene.Base.Eye);
  const Sheet second(changed, motion, this->Scene.Base.Eye);
  this->ComparePictures(first, second, random, isInView);
  this->ComparePictures(second, first, random, isInView);
}

//------------------------------------------------------------------------------
void FilterTrial::CompareBits(vtkPolyData* first, vtkPolyData* second)
{
  ++this->Tally.Comparisons;
  const auto cells = [](vtkCellArray* a, vtkCellArray* b)
  {
    return AreEqual(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
      AreEqual(a->GetConnectivityArray(), b->GetConnectivityArray());
  };
  const bool same = AreEqual(first->GetPoints()->GetData(), second->GetPoints()->GetData()) &&
    cells(first->GetPolys(), second->GetPolys()) &&
    cells(first->GetStrips(), second->GetStrips()) &&
    HaveEqualArrays(first->GetPointData(), second->GetPointData()) &&
    HaveEqualArrays(first->GetCellData(), second->GetCellData());
  if (!this->Tally.Compare(same ? 0.0 : 1.0, 0.5))
  {
    this->Fail("the outputs differ");
  }
}

//------------------------------------------------------------------------------
void FilterTrial::CompareArrays(vtkDataSetAttributes* first, vtkDataSetAttributes* second)
{
  ++this->Tally.Comparisons;
  if (!this->Tally.Compare(HaveEqualArrays(first, second) ? 0.0 : 1.0, 0.5))
  {
    this->Fail("the arrays differ");
  }
}

//------------------------------------------------------------------------------
double FilterTrial::GetLargestError() const
{
  double farthest = 0.0;
  for (const glm::dvec3& point : this->Scene.Points)
  {
    farthest = std::max(farthest, glm::length(point - this->Scene.Base.Eye));
  }
  return this->GetError(GetMagnitude(this->Scene, Motion()), farthest, this->Worst);
}

//------------------------------------------------------------------------------
std::size_t FilterTrial::CountImages(const glm::dvec3& place) const
{
  const glm::dvec3 local = place - this->Solver->GetMembrane().GetOrigin();
  if (this->Solver->IsInReach(local) && !this->Solver->IsBehindAll(local) &&
    this->Solver->IsInFront(local))
  {
    return std::numeric_limits<std::size_t>::max(); // passes unchanged
  }
  std::vector<VirtualVertex> images;
  this->Solver->FindImages(place, images);
  return images.size();
}

//------------------------------------------------------------------------------
bool FilterTrial::IsWellConditioned(const glm::dvec3& place, double error) const
{
  const std::size_t count = this->CountImages(place);
  for (int i = 0; i < 6; ++i)
  {
    if (this->CountImages(place + error * GetAxis(i)) != count)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Distance from the place of a hit to the nearest place that the other output shows within 4 t.
double FilterTrial::FindNearest(
  const Sheet& other, const glm::dvec3& direction, const Hit& hit) const
{
  const double tolerance = this->Scene.Tolerance * Pi / 180.0;
  const double margin = 8.0 * tolerance;
  std::vector<const Sheet::Piece*> near;
  for (const Sheet::Piece& piece : other.Pieces)
  {
    const double away = std::acos(std::min(1.0, glm::dot(piece.Axis, direction)));
    if (away <= std::acos(std::min(1.0, piece.Cosine)) + margin)
    {
      near.push_back(&piece);
    }
  }
  double nearest = Nowhere;
  const auto look = [&near, &hit, &nearest](const glm::dvec3& at)
  {
    for (const Sheet::Piece* piece : near)
    {
      const glm::dvec3 weights = piece->GetWeights(at);
      if (piece->Holds(weights))
      {
        nearest = std::min(nearest, glm::length(piece->GetPlace(weights) - hit.Place));
      }
    }
  };
  look(direction);
  for (const double angle : { 2.0 * tolerance, 4.0 * tolerance })
  {
    if (nearest > hit.Reach)
    {
      Sheet::VisitRing(direction, angle, 16, look);
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
void FilterTrial::ComparePictures(const Sheet& shown, const Sheet& other, RandomNumbers& random,
  const std::function<bool(const glm::dvec3& direction)>& isInView)
{
  const double angle = 4.0 * this->Scene.Tolerance * Pi / 180.0;
  for (int i = 0; i < SamplesPerPicture && !shown.Pieces.empty(); ++i)
  {
    const Sheet::Piece& piece =
      shown.Pieces[static_cast<std::size_t>(random.Below(static_cast<int>(shown.Pieces.size())))];
    const double u = std::sqrt(random.Uniform());
    const double v = random.Uniform();
    const glm::dvec3 seen =
      (1.0 - u) * piece.Seen[0] + u * (1.0 - v) * piece.Seen[1] + u * v * piece.Seen[2];
    const glm::dvec3 direction = glm::normalize(seen);
    if (!piece.HasArea() || (isInView && !isInView(direction)))
    {
      continue;
    }
    Hit hit;
    hit.Place =
      (1.0 - u) * piece.Place[0] + u * (1.0 - v) * piece.Place[1] + u * v * piece.Place[2];
    hit.Reach = piece.GetReach(direction, angle) + 1e-9 * this->Scene.Base.FacetSize;
    const double nearest = this->FindNearest(other, direction, hit);
    if (!(nearest <= hit.Reach) && !this->IsWellConditioned(hit.Place, 2.0 * hit.Reach))
    {
      ++this->Tally.Conditioned;
    }
    else if (!this->Tally.Compare(nearest, hit.Reach))
    {
      this->Fail(
        "a place is shown by one output only, the nearest is " + std::to_string(nearest) + " away");
    }
  }
}

//------------------------------------------------------------------------------
// Virtual point of each point of the scene; infinite where the output has none.
std::vector<glm::dvec3> FilterTrial::FindFirst(vtkPolyData* output, const Motion& motion) const
{
  std::vector<glm::dvec3> result(this->Scene.Points.size(), glm::dvec3(Nowhere));
  vtkDataArray* index = output->GetPointData()->GetArray("Index");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 p = PointOf(output, i);
    result[static_cast<std::size_t>(index->GetTuple1(i))] = motion.Undo(p);
  }
  return result;
}

//------------------------------------------------------------------------------
// Largest ratio of the move of an image to that of its point, infinite if the image vanishes.
std::vector<double> FilterTrial::MeasureSensitivity(const std::vector<double>& moves) const
{
  const auto membrane = MakeMembraneData(this->Scene.Base.Mesh);
  const std::vector<glm::dvec3> base =
    this->FindFirst(const_cast<FilterTrial*>(this)->GetBase(), Motion());
  std::vector<double> result(base.size(), 1.0);
  for (int k = 0; k < 6; ++k)
  {
    std::vector<glm::dvec3> places = this->Scene.Points;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      places[i] += moves[i] * GetAxis(k);
    }
    const auto object = MakeObject(this->Scene, CellForm::Quads, &places);
    const auto output = GetResult(MakeSceneFilter(this->Scene, object, membrane));
    const std::vector<glm::dvec3> moved = this->FindFirst(output, Motion());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const bool isSame = std::isinf(base[i].x) == std::isinf(moved[i].x);
      const double away = std::isinf(base[i].x) ? 0.0 : glm::length(moved[i] - base[i]);
      result[i] = isSame && away < 0.1 * this->Scene.Base.FacetSize
        ? std::max(result[i], away / moves[i])
        : Nowhere;
    }
  }
  return result;
}

//------------------------------------------------------------------------------
void FilterTrial::ComparePoints(vtkPolyData* changed, const Motion& motion)
{
  const std::vector<glm::dvec3> first = this->FindFirst(this->GetBase(), Motion());
  const std::vector<glm::dvec3> second = this->FindFirst(changed, motion);
  const double magnitude = GetMagnitude(this->Scene, motion);
  std::vector<double> errors;
  for (const glm::dvec3& point : this->Scene.Points)
  {
    errors.push_back(
      this->GetError(magnitude, glm::length(point - this->Scene.Base.Eye), this->Worst));
  }
  std::vector<double> moves = errors;
  std::for_each(moves.begin(), moves.end(), [](double& move) { move *= 1000.0; });
  const std::vector<double> sensitivity = this->MeasureSensitivity(moves);
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    const bool isFirst = this->Scene.Mode == FilterMode::FirstImage;
    // Which of several images is the first depends on the points before.
    if (std::isinf(sensitivity[i]) ||
      (isFirst &&
        (this->CountImages(this->Scene.Points[i]) > 1 ||
          !this->IsWellConditioned(this->Scene.Points[i], moves[i]))))
    {
      ++this->Tally.Conditioned;
      continue;
    }
    const bool areBoth = !std::isinf(first[i].x) && !std::isinf(second[i].x);
    const double deviation = areBoth
      ? glm::length(first[i] - second[i])
      : (std::isinf(first[i].x) == std::isinf(second[i].x) ? 0.0 : Nowhere);
    if (!this->Tally.Compare(deviation, sensitivity[i] * errors[i]))
    {
      this->Fail("a point is off by " + std::to_string(deviation));
    }
  }
}

//------------------------------------------------------------------------------
// Interpolated positions are true positions: their distance from the sight point is the depth, and
// one of their images is the virtual point.
void FilterTrial::CheckArrays()
{
  ++this->Tally.Comparisons;
  vtkPolyData* output = this->GetBase();
  vtkPointData* arrays = output->GetPointData();
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double magnitude = GetMagnitude(this->Scene, Motion());
  const double tolerance =
    this->Scene.Mode == FilterMode::AllImages ? this->Scene.Tolerance * Pi / 180.0 : 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    // Three products and their sum.
    if (!this->Tally.Compare(
          std::fabs(arrays->GetArray("Ones")->GetTuple1(i) - 1.0), 4.0 * epsilon))
    {
      this->Fail("an array of ones does not stay one");
    }
    const glm::dvec3 place = GetTuple(output, "Truth", i);
    const glm::dvec3 sight = GetTuple(output, "SightPoint", i);
    const double depth = arrays->GetArray("RefractionDepth")->GetTuple1(i);
    const double error = this->GetError(magnitude, depth, this->Worst);
    const glm::dvec3 drawn = PointOf(output, i);
    if (arrays->GetArray("SightFacet")->GetTuple1(i) < 0.0)
    {
      // A corner next to the membrane may be drawn where its image is.
      const double away = glm::length(drawn - this->Scene.Base.Eye);
      if (!this->Tally.Compare(this->GetAngle(drawn, place), 4.0 * tolerance + error / away))
      {
        this->Fail("a place in front of the membrane is drawn elsewhere");
      }
      continue;
    }
    if (!this->Tally.Compare(std::fabs(glm::length(place - sight) - depth), error))
    {
      this->Fail("a position is not the end of its path");
    }
    // The search takes a while, and flat facets show other images.
    if (this->Scene.Mode != FilterMode::FlatFacets && i % 8 == 0)
    {
      this->CheckImage(place, sight, drawn, tolerance, error);
    }
  }
}

//------------------------------------------------------------------------------
// A place is drawn where one of its images is, within 2 t where a side was moved onto its
// neighbour's. At a caustic or a border pieces end within 4 t of it.
void FilterTrial::CheckImage(const glm::dvec3& place, const glm::dvec3& sight,
  const glm::dvec3& drawn, double tolerance, double error)
{
  std::vector<VirtualVertex> images;
  this->Solver->FindImages(place, images);
  const auto nearest = std::min_element(images.begin(), images.end(),
    [&sight](const VirtualVertex& a, const VirtualVertex& b)
    { return glm::length(a.SightPoint - sight) < glm::length(b.SightPoint - sight); });
  const double away = glm::length(drawn - this->Scene.Base.Eye);
  double sensitivity = 1.0;
  const bool isSteady = nearest != images.end() &&
    this->Errors.IsSteady(place, *nearest, error, sensitivity) &&
    this->IsWellConditioned(place, 1000.0 * error + 4.0 * tolerance * away);
  if (!isSteady)
  {
    ++this->Tally.Conditioned;
  }
  else if (!this->Tally.Compare(this->GetAngle(nearest->Position, drawn),
             2.0 * tolerance + sensitivity * error / away))
  {
    this->Fail("a position's image is elsewhere");
  }
}

//------------------------------------------------------------------------------
double FilterTrial::GetAngle(const glm::dvec3& a, const glm::dvec3& b) const
{
  const glm::dvec3 first = glm::normalize(a - this->Scene.Base.Eye);
  return glm::length(glm::cross(first, glm::normalize(b - this->Scene.Base.Eye)));
}

} // namespace meniscus::test
