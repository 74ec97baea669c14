// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeStage.h"

#include <vtkLogger.h>
#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
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
vtkTetrahedraRayCastMapper* VolumeStage::GetMapper() const
{
  return this->Mapper;
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* VolumeStage::MakeGrid() const
{
  return this->FirstGrid;
}

//------------------------------------------------------------------------------
void VolumeStage::SetInput(vtkDataObject* input)
{
  this->Mapper->SetInputDataObject(input);
}

//------------------------------------------------------------------------------
void VolumeStage::GetPlace(const VolumeCase& test)
{
  if (this->Mapper)
  {
    this->Mapper->ReleaseGraphicsResources(this->Scene.GetWindow());
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
  if (test.MakeMesh().OnCells)
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
  this->FirstGrid = ToGrid(test.MakeMesh(), test.Storage);
  if (test.Blocks.size() == 1)
  {
    this->Mapper->SetInputDataObject(this->FirstGrid);
  }
  else
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (unsigned int i = 0; i < test.Blocks.size(); ++i)
    {
      blocks->SetBlock(i, i == 0 ? this->FirstGrid : ToGrid(test.Blocks[i], test.Storage));
    }
    this->Mapper->SetInputDataObject(blocks);
  }
  this->Scene.SetMapper(this->Mapper);
  this->Scene.SetProperty(ToProperty(test.Look));
  vtkNew<vtkMatrix4x4> matrix;
  for (const auto& [row, column] : Product(4, 4))
  {
    matrix->SetElement(row, column, test.Matrix[column][row]);
  }
  this->Scene.GetVolume()->SetUserMatrix(matrix);
  this->Scene.GetWindow()->SetSize(test.Size, test.Size);
  test.View.ApplyTo(this->Scene.GetRenderer());
}

//------------------------------------------------------------------------------
FloatImage VolumeStage::Render()
{
  FloatImage image = this->Scene.RenderFloat();
  this->Lost += this->Mapper->GetNumberOfLostRays();
  return image;
}

//------------------------------------------------------------------------------
FloatImage VolumeStage::Draw(const VolumeCase& test)
{
  this->GetPlace(test);
  return this->Render();
}

//------------------------------------------------------------------------------
std::string VolumeStage::Complaints()
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

} // namespace meniscus::test
