// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterRelations.h"

#include "FilterTrial.h"

#include "vtkRefractedGeometryFilter.h"
#include "vtkRefractedLightFilter.h"
#include "vtkRefractionErrorVolume.h"

namespace meniscus::test
{

namespace
{

const double Pi = std::acos(-1.0);

/** Light that reaches each row of quads, and the error by which it may differ between two runs. */
struct RowLight
{
  std::vector<double> Flux;
  std::vector<double> Error;
  vtkSmartPointer<vtkPolyData> Output;
};

vtkSmartPointer<vtkRefractedLightFilter> MakeLight(
  const FilterScene& scene, vtkPolyData* object, vtkPolyData* membrane)
{
  auto light = vtkSmartPointer<vtkRefractedLightFilter>::New();
  light->GlobalWarningDisplayOff();
  light->SetInputData(object);
  light->SetMembraneData(membrane);
  light->SetLightPosition(scene.Base.Eye.x, scene.Base.Eye.y, scene.Base.Eye.z);
  light->PositionalOn();
  light->SetExteriorIndexOfRefraction(scene.Base.Exterior);
  light->SetInteriorIndexOfRefraction(scene.Base.Interior);
  return light;
}

double GetArea(vtkPolyData* data, const std::vector<vtkIdType>& ids)
{
  glm::dvec3 sum(0.0);
  glm::dvec3 p[3];
  data->GetPoint(ids[0], &p[0].x);
  for (std::size_t i = 2; i < ids.size(); ++i)
  {
    data->GetPoint(ids[i - 1], &p[1].x);
    data->GetPoint(ids[i], &p[2].x);
    sum += 0.5 * glm::cross(p[1] - p[0], p[2] - p[0]);
  }
  return glm::length(sum);
}

// Irradiance times area, added up over the rows. A row is a strip, or its quads or triangles.
RowLight RunLight(const FilterScene& scene, CellForm form, const std::vector<glm::dvec3>& places,
  vtkPolyData* membrane)
{
  const auto object = MakeObject(scene, form, &places);
  const auto light = MakeLight(scene, object, membrane);
  light->Update();
  RowLight result;
  result.Output = light->GetOutput();
  const std::size_t rows = scene.Quads.size() / static_cast<std::size_t>(scene.QuadsPerRow);
  result.Flux.assign(rows, 0.0);
  result.Error.assign(rows, 0.0);
  vtkDataArray* irradiance = result.Output->GetCellData()->GetArray("RefractionIrradiance");
  const auto perRow = scene.QuadsPerRow * (form == CellForm::Triangles ? 2 : 1);
  for (vtkIdType cell = 0; cell < result.Output->GetNumberOfCells(); ++cell)
  {
    const auto row = static_cast<std::size_t>(form == CellForm::Strips ? cell : cell / perRow);
    vtkNew<vtkIdList> ids;
    if (form == CellForm::Strips)
    {
      // The filter divides by the length of the strip's vector of area.
      result.Output->GetStrips()->GetCellAtId(cell, ids);
      glm::dvec3 sum(0.0);
      for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
      {
        glm::dvec3 p[3];
        for (vtkIdType k = 0; k < 3; ++k)
        {
          result.Output->GetPoint(ids->GetId(i - 2 + k), &p[k].x);
        }
        sum += (i % 2 ? -0.5 : 0.5) * glm::cross(p[1] - p[0], p[2] - p[0]);
      }
      result.Flux[row] += irradiance->GetTuple1(cell) * glm::length(sum);
      continue;
    }
    result.Output->GetPolys()->GetCellAtId(cell, ids);
    const std::vector<vtkIdType> corners(
      ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
    result.Flux[row] += irradiance->GetTuple1(cell) * GetArea(result.Output, corners);
  }
  // Sides of pieces are straight within the view's tolerance t: each changes the area by at most
  // its length times t times its distance. The transmittance is averaged over a piece's corners.
  // Irradiances are rounded to single precision.
  vtkPolyData* view = light->GetView()->GetOutput();
  vtkDataArray* sources = view->GetCellData()->GetArray("SourceCellId");
  const double tolerance = light->GetView()->GetAngularTolerance() * Pi / 180.0;
  for (vtkIdType cell = 0; sources && cell < view->GetNumberOfPolys(); ++cell)
  {
    vtkNew<vtkIdList> ids;
    view->GetPolys()->GetCellAtId(cell, ids);
    double around = 0.0;
    double low = 1.0;
    double high = 0.0;
    double away = 0.0;
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      const vtkIdType id = ids->GetId(i);
      const glm::dvec3 sight = GetTuple(view, "SightPoint", id);
      around += glm::length(
        sight - GetTuple(view, "SightPoint", ids->GetId((i + 1) % ids->GetNumberOfIds())));
      away = std::max(away, glm::length(sight - scene.Base.Eye));
      const double reflectance = view->GetPointData()->GetArray("Reflectance")->GetTuple1(id);
      low = std::min(low, reflectance);
      high = std::max(high, reflectance);
    }
    const auto source = static_cast<vtkIdType>(sources->GetTuple1(cell));
    const auto row = static_cast<std::size_t>(form == CellForm::Strips ? source : source / perRow);
    result.Error[row] += around * (tolerance * away + 0.25 * around * (high - low));
  }
  for (std::size_t row = 0; row < rows; ++row)
  {
    result.Error[row] += 0x1p-23 * result.Flux[row];
  }
  return result;
}

class LightTrial
{
public:
  explicit LightTrial(const FilterScene& scene)
    : Trial(scene)
  {
  }

  void Compare(const RowLight& first, const RowLight& second, double scale)
  {
    RelationTally& tally = this->Trial.GetTally();
    ++tally.Comparisons;
    for (std::size_t row = 0; row < first.Flux.size(); ++row)
    {
      const double deviation = std::fabs(first.Flux[row] - second.Flux[row] / (scale * scale));
      const double error = first.Error[row] + second.Error[row] / (scale * scale) +
        1e-9 * this->Trial.GetScene().Base.FacetSize * this->Trial.GetScene().Base.FacetSize;
      if (!(deviation <= error) && !this->IsWellConditioned(row))
      {
        ++tally.Conditioned;
      }
      else if (!tally.Compare(deviation, error))
      {
        this->Trial.Fail("a row's light is off by " + std::to_string(deviation));
      }
    }
  }

  FilterTrial Trial;

private:
  // All places of the row have the same number of images: the row holds no border and no caustic.
  bool IsWellConditioned(std::size_t row) const
  {
    const FilterScene& scene = this->Trial.GetScene();
    const auto perRow = static_cast<std::size_t>(scene.QuadsPerRow);
    const std::size_t count = this->Trial.CountImages(scene.Points[scene.Quads[row * perRow][0]]);
    for (std::size_t i = row * perRow; i < (row + 1) * perRow; ++i)
    {
      const auto corner = [&scene, i](std::size_t k)
      { return scene.Points[static_cast<std::size_t>(scene.Quads[i][k])]; };
      for (int step = 0; step < 25; ++step)
      {
        const double u = 0.25 * (step % 5);
        const double v = 0.25 * (step / 5);
        const glm::dvec3 place =
          glm::mix(glm::mix(corner(0), corner(1), u), glm::mix(corner(3), corner(2), u), v);
        if (this->Trial.CountImages(place) != count)
        {
          return false;
        }
      }
    }
    return true;
  }
};

RelationTally LightCells(LightTrial& trial, RandomNumbers&)
{
  const FilterScene& scene = trial.Trial.GetScene();
  const auto membrane = MakeMembraneData(scene.Base.Mesh);
  const RowLight base = RunLight(scene, CellForm::Quads, scene.Points, membrane);
  trial.Compare(base, RunLight(scene, CellForm::Triangles, scene.Points, membrane), 1.0);
  trial.Compare(base,
    RunLight(
      scene, CellForm::Quads, scene.Points, MakeMembraneData(scene.Base.Mesh, CellForm::Strips)),
    1.0);
  const bool isPlane = glm::length(glm::cross(scene.Points[1] - scene.Points[0],
                         scene.Points.back() - scene.Points[0])) > 0.0 &&
    scene.Points.size() ==
      static_cast<std::size_t>((scene.QuadsPerRow + 1) * (scene.QuadsPerRow + 1));
  if (isPlane)
  {
    // A strip of a curved surface has another area: the length of its vector of area.
    trial.Compare(base, RunLight(scene, CellForm::Strips, scene.Points, membrane), 1.0);
  }
  return trial.Trial.GetTally();
}

RelationTally LightMoved(LightTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.Trial.GetScene();
  Motion motion;
  const glm::dvec3 x = random.GetDirection();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.GetDirection()));
  motion.Turn = glm::dmat3(x, y, glm::cross(x, y));
  motion.Scale = random.Uniform(0.1, 10.0);
  motion.Offset = 10.0 * random.GetDirection();
  FilterScene moved = scene;
  moved.Base = motion.Apply(moved.Base);
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& point : scene.Points)
  {
    places.push_back(motion.Apply(point));
  }
  trial.Compare(RunLight(scene, CellForm::Quads, scene.Points, MakeMembraneData(scene.Base.Mesh)),
    RunLight(moved, CellForm::Quads, places, MakeMembraneData(moved.Base.Mesh)), motion.Scale);
  return trial.Trial.GetTally();
}

RelationTally LightEdited(LightTrial& trial, RandomNumbers& random)
{
  const FilterScene& scene = trial.Trial.GetScene();
  const auto object = Convert(MakeObject(scene), false, true);
  const auto membrane = Convert(MakeMembraneData(scene.Base.Mesh), false, true);
  const auto fresh = MakeLight(scene, object, membrane);
  fresh->Update();
  // Another scene first, then the same values in other types.
  const auto edited = Convert(object, true, false);
  const auto light = MakeLight(scene, edited, Convert(membrane, true, false));
  light->SetInteriorIndexOfRefraction(1.0 + random.Uniform());
  edited->GetPoints()->SetPoint(0, scene.Base.Eye.x, scene.Base.Eye.y, scene.Base.Eye.z);
  edited->GetPoints()->Modified();
  light->Update();
  light->SetInteriorIndexOfRefraction(scene.Base.Interior);
  double first[3];
  object->GetPoint(0, first);
  edited->GetPoints()->SetPoint(0, first);
  edited->Modified();
  light->Update();
  trial.Trial.CompareArrays(fresh->GetOutput()->GetCellData(), light->GetOutput()->GetCellData());
  trial.Trial.CompareArrays(fresh->GetOutput()->GetPointData(), light->GetOutput()->GetPointData());
  return trial.Trial.GetTally();
}

//------------------------------------------------------------------------------
constexpr int SamplesPerSide = 6;

struct ErrorBox
{
  glm::dvec3 Low;
  glm::dvec3 High;
};

ErrorBox FindBox(const FilterScene& scene)
{
  ErrorBox box{ scene.Points[0], scene.Points[0] };
  for (const glm::dvec3& point : scene.Points)
  {
    box.Low = glm::min(box.Low, point);
    box.High = glm::max(box.High, point);
  }
  return box;
}

// The error of flat facets against patches, or of patches against those of another membrane.
vtkSmartPointer<vtkRefractionErrorVolume> MakeErrors(
  const FilterScene& scene, const ErrorBox& box, vtkPolyData* membrane, vtkPolyData* reference)
{
  auto errors = vtkSmartPointer<vtkRefractionErrorVolume>::New();
  errors->GlobalWarningDisplayOff();
  errors->SetInputData(membrane);
  errors->SetMembraneModel(scene.Mode == FilterMode::FlatFacets
      ? vtkRefractionErrorVolume::FLAT_FACETS
      : vtkRefractionErrorVolume::CURVED);
  if (scene.Mode != FilterMode::FlatFacets)
  {
    errors->SetReferenceData(reference);
  }
  errors->SetEyePosition(scene.Base.Eye.x, scene.Base.Eye.y, scene.Base.Eye.z);
  errors->SetExteriorIndexOfRefraction(scene.Base.Exterior);
  errors->SetInteriorIndexOfRefraction(scene.Base.Interior);
  errors->SetModelBounds(box.Low.x, box.High.x, box.Low.y, box.High.y, box.Low.z, box.High.z);
  errors->SetSampleDimensions(SamplesPerSide, SamplesPerSide, SamplesPerSide);
  return errors;
}

// Another smooth surface near the membrane.
RefractionScene MakeReference(const RefractionScene& scene)
{
  Motion motion;
  motion.Scale = 1.01;
  RefractionScene reference = scene;
  reference.Mesh = motion.Apply(scene).Mesh;
  return reference;
}

vtkSmartPointer<vtkImageData> RunErrors(
  const FilterScene& scene, const ErrorBox& box, const RefractionScene& reference, CellForm form)
{
  const auto errors = MakeErrors(
    scene, box, MakeMembraneData(scene.Base.Mesh, form), MakeMembraneData(reference.Mesh, form));
  errors->Update();
  return errors->GetOutput();
}

// Errors and states of two boxes; `moved` are those of the first one moved by `move` along the
// axes.
void CompareErrors(FilterTrial& trial, vtkImageData* first, vtkImageData* second, double scale,
  const std::vector<vtkSmartPointer<vtkImageData>>& moved, double move, double error)
{
  RelationTally& tally = trial.GetTally();
  ++tally.Comparisons;
  const auto at = [](vtkImageData* image, vtkIdType i)
  { return image->GetPointData()->GetArray("RefractionError")->GetTuple1(i); };
  const auto stateAt = [](vtkImageData* image, vtkIdType i)
  { return image->GetPointData()->GetArray("SampleState")->GetTuple1(i); };
  for (vtkIdType i = 0; i < first->GetNumberOfPoints(); ++i)
  {
    const double value = at(first, i);
    const double state = stateAt(first, i);
    double sensitivity = 1.0;
    bool isSteady = true;
    for (const auto& image : moved)
    {
      isSteady = isSteady && stateAt(image, i) == state;
      const double change = state == 0.0 && isSteady ? std::fabs(at(image, i) - value) : 0.0;
      // A sample that jumps to another image or facet is at a border.
      isSteady = isSteady && change < 0.01 * trial.GetScene().Base.FacetSize;
      sensitivity = std::max(sensitivity, change / move);
    }
    const bool isSame = stateAt(second, i) == state;
    const double deviation = !isSame
      ? std::numeric_limits<double>::infinity()
      : (state == 0.0 ? std::fabs(at(second, i) / scale - value) : 0.0);
    if (!isSteady)
    {
      ++tally.Conditioned;
    }
    else if (!tally.Compare(deviation, sensitivity * error))
    {
      trial.Fail("an error is off by " + std::to_string(deviation) + ", states " +
        std::to_string(static_cast<int>(state)) + " and " +
        std::to_string(static_cast<int>(stateAt(second, i))));
    }
  }
}

RelationTally ErrorsMoved(LightTrial& light, RandomNumbers& random)
{
  FilterTrial& trial = light.Trial;
  const FilterScene& scene = trial.GetScene();
  const ErrorBox box = FindBox(scene);
  const RefractionScene reference = MakeReference(scene.Base);
  const auto base = RunErrors(scene, box, reference, CellForm::Triangles);
  const double error = trial.GetLargestError();
  const double move = 1000.0 * error;
  std::vector<vtkSmartPointer<vtkImageData>> neighbours;
  for (int i = 0; i < 6; ++i)
  {
    glm::dvec3 way(0.0);
    way[i / 2] = i % 2 ? move : -move;
    neighbours.push_back(
      RunErrors(scene, { box.Low + way, box.High + way }, reference, CellForm::Triangles));
  }
  Motion motion;
  motion.Scale = std::pow(2.0, random.Below(9) - 4);
  motion.Offset = random.GetDirection();
  FilterScene moved = scene;
  moved.Base = motion.Apply(scene.Base);
  const auto second = RunErrors(moved, { motion.Apply(box.Low), motion.Apply(box.High) },
    motion.Apply(reference), CellForm::Triangles);
  CompareErrors(trial, base, second, motion.Scale, neighbours, move, error);
  CompareErrors(
    trial, base, RunErrors(scene, box, reference, CellForm::Strips), 1.0, neighbours, move, error);
  return trial.GetTally();
}

RelationTally ErrorsEdited(LightTrial& light, RandomNumbers& random)
{
  FilterTrial& trial = light.Trial;
  const FilterScene& scene = trial.GetScene();
  const ErrorBox box = FindBox(scene);
  const auto membrane = Convert(MakeMembraneData(scene.Base.Mesh), false, true);
  const auto reference = Convert(MakeMembraneData(MakeReference(scene.Base).Mesh), false, true);
  const auto fresh = MakeErrors(scene, box, membrane, reference);
  fresh->Update();
  const auto edited = Convert(membrane, true, false);
  const auto errors = MakeErrors(scene, box, edited, Convert(reference, true, false));
  errors->SetInteriorIndexOfRefraction(1.0 + random.Uniform());
  double first[3];
  membrane->GetPoint(0, first);
  edited->GetPoints()->SetPoint(0, first[0] + 0.1 * scene.Base.FacetSize, first[1], first[2]);
  edited->GetPoints()->Modified();
  errors->Update();
  errors->SetInteriorIndexOfRefraction(scene.Base.Interior);
  edited->GetPoints()->SetPoint(0, first);
  edited->Modified();
  errors->Update();
  trial.CompareArrays(fresh->GetOutput()->GetPointData(), errors->GetOutput()->GetPointData());
  return trial.GetTally();
}

struct NamedWork
{
  const char* Name;
  int Cases;
  RelationTally (*Run)(LightTrial&, RandomNumbers&);
};

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<FilterRelation> GetLightRelations()
{
  const NamedWork works[] = { { "light: cells", 20, LightCells },
    { "light: moved together", 20, LightMoved }, { "light: edits and types", 20, LightEdited },
    { "errors: moved, cells", 20, ErrorsMoved }, { "errors: edits and types", 20, ErrorsEdited } };
  std::vector<FilterRelation> result;
  for (const NamedWork& work : works)
  {
    const auto run = [run = work.Run](RandomNumbers& random)
    {
      LightTrial trial(MakeFilterScene(random));
      return trial.Trial.IsReady() ? run(trial, random) : trial.Trial.GetTally();
    };
    result.push_back({ work.Name, work.Cases, run });
  }
  return result;
}

} // namespace meniscus::test
