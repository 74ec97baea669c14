// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterRelations.h"

#include "FilterTrial.h"

#include "vtkRefractedGeometryFilter.h"

namespace meniscus::test
{

namespace
{

const double Pi = std::acos(-1.0);

using Change = void (*)(FilterTrial&, RandomNumbers&);

vtkSmartPointer<vtkPolyData> Run(
  const FilterScene& scene, vtkPolyData* object, vtkPolyData* membrane)
{
  return GetResult(MakeSceneFilter(scene, object, membrane));
}

//------------------------------------------------------------------------------
// The object as triangles and as triangle strips instead of quads.
void ChangeCells(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  const auto membrane = MakeMembraneData(scene.Base.Mesh);
  for (const CellForm form : { CellForm::Triangles, CellForm::Strips })
  {
    trial.Compare(Run(scene, MakeObject(scene, form), membrane), Motion(), random);
  }
}

void CheckArrays(FilterTrial& trial, RandomNumbers&)
{
  trial.CheckArrays();
}

// Coordinates that single precision represents, in both precisions and with both widths of ids.
void ChangeTypes(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  const CellForm form = random.Below(2) ? CellForm::Strips : CellForm::Quads;
  const auto object = Convert(MakeObject(scene, form), false, true);
  const auto membrane = Convert(MakeMembraneData(scene.Base.Mesh), false, true);
  const auto first = Run(scene, object, membrane);
  for (int i = 0; i < 4; ++i)
  {
    const auto second =
      Run(scene, Convert(object, i & 1, i & 2), Convert(membrane, !(i & 1), !(i & 2)));
    trial.CompareBits(first, second);
  }
}

// Points of the object in another order, its cells in another order and with other first corners.
void ReorderObject(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  const std::size_t count = scene.Points.size();
  std::vector<vtkIdType> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = count; i > 1; --i)
  {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.Below(static_cast<int>(i)))]);
  }
  const auto from = MakeObject(scene);
  vtkNew<vtkPolyData> object;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkPointData* arrays = object->GetPointData();
  arrays->CopyAllocate(from->GetPointData());
  std::vector<vtkIdType> placeOf(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    placeOf[static_cast<std::size_t>(order[i])] = static_cast<vtkIdType>(i);
    arrays->CopyData(
      from->GetPointData(), order[i], points->InsertNextPoint(from->GetPoint(order[i])));
  }
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = scene.Quads.size(); i > 0; --i)
  {
    const auto& quad = scene.Quads[i - 1];
    const auto first = static_cast<std::size_t>(random.Below(4));
    std::array<vtkIdType, 4> ids;
    for (std::size_t k = 0; k < 4; ++k)
    {
      ids[k] = placeOf[static_cast<std::size_t>(quad[(first + k) % 4])];
    }
    cells->InsertNextCell(4, ids.data());
  }
  object->SetPoints(points);
  object->SetPolys(cells);
  trial.Compare(Run(scene, object, MakeMembraneData(scene.Base.Mesh)), Motion(), random);
}

// A camera that shows a part of the scene, with culling.
void Cull(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  const glm::dvec3 target =
    scene.Points[static_cast<std::size_t>(random.Below(static_cast<int>(scene.Points.size())))];
  const glm::dvec3 eye = scene.Base.Eye;
  const double angle = random.Uniform(5.0, 60.0);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(target.x, target.y, target.z);
  const glm::dvec3 up = random.GetDirection();
  camera->SetViewUp(up.x, up.y, up.z);
  camera->SetViewAngle(angle);
  // Culling is for the pixels in view, whatever their depth.
  camera->SetClippingRange(1e-6, 1e6);
  const auto filter = MakeSceneFilter(scene, MakeObject(scene), MakeMembraneData(scene.Base.Mesh));
  filter->SetCamera(camera);
  filter->SetViewAspectRatio(1.0);
  const auto culled = GetResult(filter);
  if (scene.Mode != FilterMode::AllImages)
  {
    return; // pictures are compared in the view; points have no extent there
  }
  // A cone within the view's square, less the 4 t by which pictures may differ.
  const glm::dvec3 forward = glm::normalize(target - eye);
  const double cosine = std::cos((0.5 * angle - 8.0 * scene.Tolerance) * Pi / 180.0);
  trial.Compare(culled, Motion(), random,
    [forward, cosine](const glm::dvec3& direction)
    { return glm::dot(forward, direction) > cosine; });
}

// Membrane, object and eye moved together.
void MoveAll(FilterTrial& trial, RandomNumbers& random)
{
  Motion motion;
  const glm::dvec3 x = random.GetDirection();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.GetDirection()));
  motion.Turn = glm::dmat3(x, y, glm::cross(x, y));
  motion.Scale = std::pow(10.0, random.Uniform(-3.0, 3.0));
  motion.Offset = motion.Scale * 100.0 * random.Uniform() * random.GetDirection();
  FilterScene moved = trial.GetScene();
  moved.Base = motion.Apply(moved.Base);
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& point : trial.GetScene().Points)
  {
    places.push_back(motion.Apply(point));
  }
  trial.Compare(
    Run(moved, MakeObject(moved, CellForm::Quads, &places), MakeMembraneData(moved.Base.Mesh)),
    motion, random);
}

// Pairs of the membrane's triangles as strips; as quads, whose diagonals may change, in a plane.
void ChangeMembraneCells(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  const auto object = MakeObject(scene);
  const reference::MembraneMesh& mesh = scene.Base.Mesh;
  trial.Compare(Run(scene, object, MakeMembraneData(mesh, CellForm::Strips)), Motion(), random);
  if (scene.Base.Family == "plane" && scene.Mode != FilterMode::FlatFacets)
  {
    trial.Compare(Run(scene, object, MakeMembraneData(mesh, CellForm::Quads)), Motion(), random);
  }
}

// An object in a body, seen through the body and through the part of it that faces the eye.
void KeepFacingPart(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  const reference::MembraneMesh& mesh = scene.Base.Mesh;
  FilterScene changed = scene;
  changed.Base.Mesh.Triangles.clear();
  const auto isFacing = [&mesh, &scene](std::int64_t id)
  {
    const double* p = mesh.Points.data() + 3 * id;
    const double* n = mesh.Normals.data() + 3 * id;
    return glm::dot(scene.Base.Eye - glm::dvec3(p[0], p[1], p[2]), glm::dvec3(n[0], n[1], n[2])) >
      0.0;
  };
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    const std::int64_t* ids = mesh.Triangles.data() + i;
    if (isFacing(ids[0]) || isFacing(ids[1]) || isFacing(ids[2]))
    {
      changed.Base.Mesh.AddTriangle(ids[0], ids[1], ids[2]);
    }
  }
  trial.Compare(
    Run(changed, MakeObject(scene), MakeMembraneData(changed.Base.Mesh)), Motion(), random);
}

// Everything edited in place, in a filter that has shown another scene before.
void EditInPlace(FilterTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.GetScene();
  FilterScene before = scene;
  Motion motion;
  motion.Turn = glm::dmat3(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
  motion.Scale = random.Uniform(0.5, 2.0);
  before.Base = motion.Apply(before.Base);
  before.Base.Interior = 1.0 + random.Uniform();
  std::vector<glm::dvec3> places = scene.Points;
  std::reverse(places.begin(), places.end());
  const auto object = MakeObject(before, CellForm::Quads, &places);
  const auto membrane = MakeMembraneData(before.Base.Mesh);
  const auto filter = MakeSceneFilter(before, object, membrane);
  filter->Update();
  for (std::size_t i = 0; i < scene.Points.size(); ++i)
  {
    object->GetPoints()->SetPoint(static_cast<vtkIdType>(i), &scene.Points[i].x);
  }
  const reference::MembraneMesh& mesh = scene.Base.Mesh;
  for (std::size_t i = 0; i < mesh.Points.size() / 3; ++i)
  {
    membrane->GetPoints()->SetPoint(static_cast<vtkIdType>(i), mesh.Points.data() + 3 * i);
    membrane->GetPointData()->GetNormals()->SetTuple(
      static_cast<vtkIdType>(i), mesh.Normals.data() + 3 * i);
  }
  object->Modified();
  membrane->Modified();
  filter->SetEyePosition(scene.Base.Eye.x, scene.Base.Eye.y, scene.Base.Eye.z);
  filter->SetInteriorIndexOfRefraction(scene.Base.Interior);
  trial.CompareBits(trial.GetBase(), GetResult(filter));
}

// An object inside a body that the eye sees from outside. Flat facets show extrapolated images
// through facets that face away.
FilterScene MakeSceneInBody(RandomNumbers& random)
{
  for (;;)
  {
    FilterScene scene = MakeFilterScene(random);
    if (scene.Base.Family != "sphere" || scene.Base.Mesh.Normals[2] < 0.0 ||
      scene.Mode == FilterMode::FlatFacets)
    {
      continue;
    }
    double farthest = 0.0;
    for (const glm::dvec3& point : scene.Points)
    {
      farthest = std::max(farthest, glm::length(point));
    }
    for (glm::dvec3& point : scene.Points)
    {
      point *= 0.9 / std::max(0.9, farthest);
    }
    return scene;
  }
}

struct NamedChange
{
  const char* Name;
  int Cases;
  Change Run;
};

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<FilterRelation> GetFilterRelations()
{
  const NamedChange changes[] = { { "object's cells", 30, ChangeCells },
    { "arrays at new points", 30, CheckArrays }, { "types of values", 20, ChangeTypes },
    { "object reordered", 30, ReorderObject }, { "view culling", 30, Cull },
    { "moved together", 30, MoveAll }, { "membrane's cells", 30, ChangeMembraneCells },
    { "facing part of a body", 30, KeepFacingPart }, { "edits in place", 20, EditInPlace } };
  std::vector<FilterRelation> result;
  for (const NamedChange& change : changes)
  {
    const auto run = [change = change.Run](RandomNumbers& random)
    {
      FilterTrial trial(
        change == &KeepFacingPart ? MakeSceneInBody(random) : MakeFilterScene(random));
      if (trial.IsReady()) // otherwise the eye is on the membrane
      {
        change(trial, random);
      }
      return trial.GetTally();
    };
    result.push_back({ change.Name, change.Cases, run });
  }
  const std::vector<FilterRelation> more = GetLightRelations();
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

} // namespace meniscus::test
