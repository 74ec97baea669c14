// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Light and shadows in true space far from the origin of the world: the picture of the same scene
// at the origin.
#include "FlatPoolLamps.h"
#include "StrictImage.h"
#include "VTKTestBasics.h"

#include <vtkCompositeDataGeometryFilter.h>
#include <vtkMultiBlockDataSet.h>

using namespace meniscus::test;
using namespace meniscus::test::flatpool;

namespace
{

/** Data in double precision, moved. */
vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* data, const glm::dvec3& offset)
{
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->DeepCopy(data);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 place;
    data->GetPoint(i, &place.x);
    place += offset;
    points->InsertNextPoint(&place.x);
  }
  moved->SetPoints(points);
  return moved;
}

/** Water with waves of a height, of 6 by 6. */
vtkSmartPointer<vtkPolyData> MakeWaves(double height)
{
  const auto plane = MakePlane(3.0, 0.0, 60);
  plane->Update();
  auto waves = Moved(plane->GetOutput(), glm::dvec3(0.0));
  vtkNew<vtkDoubleArray> normals;
  normals->SetNumberOfComponents(3);
  constexpr double rate = 4.0;
  for (vtkIdType i = 0; i < waves->GetNumberOfPoints(); ++i)
  {
    double place[3];
    waves->GetPoint(i, place);
    const double slope = height * rate * std::cos(rate * place[0]);
    place[2] = height * std::sin(rate * place[0]);
    waves->GetPoints()->SetPoint(i, place);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope, 0.0, 1.0));
    normals->InsertNextTuple(&normal.x);
  }
  waves->GetPointData()->SetNormals(normals);
  return waves;
}

/** A pool with a ball, somewhere. */
class PoolAt : public LitPool
{
public:
  PoolAt(const glm::dvec3& offset, double waves)
    : Offset(offset)
    , Water(Moved(MakeWaves(waves), offset))
  {
    this->Bottom->Update();
    this->Filter->SetInputData(Moved(this->Bottom->GetOutput(), offset));
    this->Filter->SetMembraneData(this->Water);
    vtkPolyDataMapper::SafeDownCast(this->Membrane->GetMapper())->SetInputData(this->Water);
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(0.1, -0.05, -0.8);
    ball->SetRadius(0.35);
    ball->SetThetaResolution(64);
    ball->SetPhiResolution(33);
    ball->Update();
    this->BallFilter->SetInputData(Moved(ball->GetOutput(), offset));
    this->BallFilter->SetMembraneData(this->Water);
    this->BallFilter->SetInteriorIndexOfRefraction(flatpool::Water);
    this->BallFilter->SetCamera(this->GetCamera());
    this->BallFilter->TrueGeometryOn();
    this->Ball = MakeActor(this->BallFilter->GetOutputPort());
    this->Ball->GetProperty()->DeepCopy(this->Floor->GetProperty());
    this->Pass->AddRefraction(this->Membrane, this->Ball, this->BallFilter);
    this->Pass->ShadowsOn();
    const glm::dvec3 eye = offset + glm::dvec3(1.5, -0.8, EyeHeight);
    this->GetCamera()->SetPosition(eye.x, eye.y, eye.z);
    this->GetCamera()->SetFocalPoint(offset.x, offset.y, offset.z);
  }

  ByteImage RenderWith(Lamp lamp)
  {
    lamp.Place += lamp.IsDistant ? glm::dvec3(0.0) : this->Offset;
    this->SetLamps({ lamp });
    return this->Render();
  }

  glm::dvec3 Offset;
  vtkSmartPointer<vtkPolyData> Water;
  vtkNew<vtkRefractedGeometryFilter> BallFilter;
  vtkSmartPointer<vtkActor> Ball;
};

/** Pixels with a channel that differs by more than the rounding of colours. */
std::size_t CountDifferent(const ByteImage& a, const ByteImage& b)
{
  return CompareStrictly(a, b, 1).PixelsBeyond;
}

/** The ball as one of several blocks that a filter joins. */
void JoinBlocks(PoolAt& pool)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, pool.BallFilter->GetInputDataObject(0, 0));
  blocks->SetBlock(1, vtkNew<vtkPolyData>());
  vtkNew<vtkCompositeDataGeometryFilter> joined;
  joined->SetInputData(blocks);
  pool.BallFilter->SetInputConnection(joined->GetOutputPort());
}

const glm::dvec3 FarAway(5.0e5, -4.0e5, 3.0e5);

/**
 * Pixels that may differ: those at edges of shadows and of the ball, of which there are less than
 * 500. Places are known to 2^-19 of the scene's 6, a 4000th of a pixel, so 2 is certainly more than
 * those whose edge moves over the middle of the pixel.
 */
constexpr std::size_t MostDifferent = 2;

void ExpectSamePictures(double waves, const std::vector<Lamp>& lamps, bool joined = false)
{
  PoolAt near(glm::dvec3(0.0), waves);
  PoolAt far(FarAway, waves);
  if (joined)
  {
    JoinBlocks(far);
  }
  for (std::size_t i = 0; i < lamps.size(); ++i)
  {
    SCOPED_TRACE(i);
    near.Pass->ShadowsOn();
    const ByteImage right = near.RenderWith(lamps[i]);
    near.Pass->ShadowsOff();
    EXPECT_GT(CountDifferent(near.RenderWith(lamps[i]), right), 60u) << "a shadow";
    EXPECT_LE(CountDifferent(far.RenderWith(lamps[i]), right), MostDifferent);
  }
  EXPECT_EQ(far.Pass->GetNumberOfSkippedLights(), 0);
}

} // anonymous namespace

TEST(RefractionPassFar, FlatWater)
{
  ExpectSamePictures(0.0,
    { Distant(0.5, 0.3, 0.8), Near(0.7, -0.4, 0.8), Near(0.4, 0.3, -0.2), Near(0.3, 0.2, 0.02) });
}

/** Waves of a height that the floats of far places do not know. */
TEST(RefractionPassFar, LowWaves)
{
  ExpectSamePictures(0.02, { Distant(0.5, 0.3, 0.8), Near(0.7, -0.4, 0.8) });
}

TEST(RefractionPassFar, BlocksThatAreJoined)
{
  ExpectSamePictures(0.0, { Distant(0.5, 0.3, 0.8) }, true);
}
