// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeStage.h"

#include <vtkCommand.h>
#include <vtkLogger.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlane.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTetrahedraRayCastMapper.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>

namespace meniscus
{
namespace test
{

/** Collects the error messages of a mapper. */
class VolumeStage::Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }
  void Execute(vtkObject*, unsigned long, void* data) override
  {
    const char* message = static_cast<const char*>(data);
    this->Text += message ? message : "error";
  }
  std::string Text;
};

//------------------------------------------------------------------------------
VolumeStage::VolumeStage()
  : Scene(8, 8)
  , Errors(vtkSmartPointer<Listener>::New())
{
  // Meshes with cells that cannot be drawn cause warnings of the mapper.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR);
}

//------------------------------------------------------------------------------
VolumeStage::~VolumeStage() = default;

//------------------------------------------------------------------------------
vtkTetrahedraRayCastMapper* VolumeStage::mapper() const
{
  return this->Mapper;
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* VolumeStage::grid() const
{
  return this->FirstGrid;
}

//------------------------------------------------------------------------------
void VolumeStage::setInput(vtkDataObject* input)
{
  this->Mapper->SetInputDataObject(input);
}

//------------------------------------------------------------------------------
void VolumeStage::place(const VolumeCase& test)
{
  if (this->Mapper)
  {
    this->Mapper->ReleaseGraphicsResources(this->Scene.window());
  }
  this->Mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  this->Mapper->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  this->Mapper->SetBackend(test.Backend);
  this->Mapper->SetBlendMode(test.Look.Blend);
  this->Mapper->SetGradients(test.Look.Gradients);
  this->Mapper->SetAutoAdjustSampleDistances(false);
  this->Mapper->SetExteriorIndexOfRefraction(test.Membrane.Surface.Exterior);
  this->Mapper->SetInteriorIndexOfRefraction(test.Membrane.Surface.Interior);
  this->Mapper->SetMembraneData(test.Membrane.Mesh);
  if (test.mesh().OnCells)
  {
    this->Mapper->SetScalarModeToUseCellData();
  }
  for (const auto& plane : test.Planes)
  {
    vtkNew<vtkPlane> clipping;
    clipping->SetOrigin(plane[0].x, plane[0].y, plane[0].z);
    clipping->SetNormal(plane[1].x, plane[1].y, plane[1].z);
    this->Mapper->AddClippingPlane(clipping);
  }
  this->FirstGrid = toGrid(test.mesh(), test.Storage);
  if (test.Blocks.size() == 1)
  {
    this->Mapper->SetInputDataObject(this->FirstGrid);
  }
  else
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (unsigned int i = 0; i < test.Blocks.size(); ++i)
    {
      blocks->SetBlock(i, i == 0 ? this->FirstGrid : toGrid(test.Blocks[i], test.Storage));
    }
    this->Mapper->SetInputDataObject(blocks);
  }
  this->Scene.setMapper(this->Mapper);
  this->Scene.setProperty(toProperty(test.Look));
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      matrix->SetElement(row, column, test.Matrix[column][row]);
    }
  }
  this->Scene.volume()->SetUserMatrix(matrix);
  this->Scene.window()->SetSize(test.Size, test.Size);
  test.View.applyTo(this->Scene.renderer());
}

//------------------------------------------------------------------------------
FloatImage VolumeStage::render()
{
  FloatImage image = this->Scene.renderFloat();
  this->Lost += this->Mapper->GetNumberOfLostRays();
  return image;
}

//------------------------------------------------------------------------------
FloatImage VolumeStage::draw(const VolumeCase& test)
{
  this->place(test);
  return this->render();
}

//------------------------------------------------------------------------------
std::string VolumeStage::complaints()
{
  std::string text = this->Errors->Text;
  if (this->Lost > 0)
  {
    text += " " + std::to_string(this->Lost) + " rays lost";
  }
  this->Errors->Text.clear();
  this->Lost = 0;
  return text;
}

} // namespace test
} // namespace meniscus
