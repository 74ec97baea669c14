// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ResampledMapper.h"

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkResampleToImage.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

namespace meniscus::benchmark
{

namespace
{

/** Nodes of the converted opacities. */
constexpr int Nodes = 2048;

/** Samples outside of the mesh are that much below the range of the values, relative to it. */
constexpr double Below = 0.01;

class ResampledMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static ResampledMapper* New();
  vtkTypeMacro(ResampledMapper, vtkUnstructuredGridVolumeMapper);

  void SetSize(int size) { this->Size = size; }

  void Render(vtkRenderer* renderer, vtkVolume* volume) override
  {
    vtkUnstructuredGridBase* grid = this->GetInput();
    if (grid != this->Source || grid->GetMTime() > this->ImageTime)
    {
      this->Resample(grid);
    }
    if (volume->GetProperty() != this->Look || volume->GetProperty()->GetMTime() > this->LookTime)
    {
      this->Convert(volume->GetProperty());
    }
    this->Caster->Render(renderer, this->Drawn);
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Caster->ReleaseGraphicsResources(window);
  }

protected:
  ResampledMapper()
  {
    this->Drawn->SetMapper(this->Caster);
    this->Caster->SetImageSampleDistance(1.0f);
    this->Caster->AutoAdjustSampleDistancesOff();
  }

private:
  void Resample(vtkUnstructuredGridBase* grid)
  {
    double bounds[6];
    grid->GetBounds(bounds);
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      longest = std::max(longest, bounds[2 * i + 1] - bounds[2 * i]);
    }
    const double spacing = longest / (this->Size - 1);
    int count[3];
    for (int i = 0; i < 3; ++i)
    {
      count[i] = std::max(2, 1 + static_cast<int>((bounds[2 * i + 1] - bounds[2 * i]) / spacing));
    }
    vtkNew<vtkResampleToImage> resample;
    resample->SetInputDataObject(grid);
    resample->SetSamplingDimensions(count);
    resample->Update();
    vtkNew<vtkImageData> image;
    image->ShallowCopy(resample->GetOutput());
    vtkDataArray* values =
      image->GetPointData()->GetArray(grid->GetPointData()->GetScalars()->GetName());
    auto* valid = vtkUnsignedCharArray::SafeDownCast(
      image->GetPointData()->GetArray(resample->GetMaskArrayName()));
    double range[2];
    grid->GetPointData()->GetScalars()->GetRange(range);
    for (vtkIdType i = 0; valid && i < values->GetNumberOfTuples(); ++i)
    {
      if (!valid->GetValue(i))
      {
        values->SetComponent(i, 0, range[0] - Below * (range[1] - range[0]));
      }
    }
    vtkNew<vtkImageData> drawn;
    drawn->CopyStructure(image);
    drawn->GetPointData()->SetScalars(values);
    this->Caster->SetInputData(drawn);
    this->Caster->SetSampleDistance(static_cast<float>(0.5 * spacing));
    this->Source = grid;
    this->ImageTime.Modified();
  }

  // 1 - (1 - o)^(L / unit) is 1 - exp(-a L / unit) for o = 1 - exp(-a).
  void Convert(vtkVolumeProperty* look)
  {
    double range[2];
    look->GetScalarOpacity()->GetRange(range);
    vtkNew<vtkPiecewiseFunction> opacity;
    for (int i = 0; i <= Nodes; ++i)
    {
      const double value = range[0] + (range[1] - range[0]) * i / Nodes;
      opacity->AddPoint(value, 1.0 - std::exp(-look->GetScalarOpacity()->GetValue(value)));
    }
    opacity->AddPoint(range[0] - 0.5 * Below * (range[1] - range[0]), 0.0);
    this->Converted->DeepCopy(look);
    this->Converted->SetScalarOpacity(opacity);
    this->Drawn->SetProperty(this->Converted);
    this->Look = look;
    this->LookTime.Modified();
  }

  int Size = 64;
  vtkNew<vtkFixedPointVolumeRayCastMapper> Caster;
  vtkNew<vtkVolume> Drawn;
  vtkNew<vtkVolumeProperty> Converted;
  vtkUnstructuredGridBase* Source = nullptr;
  vtkVolumeProperty* Look = nullptr;
  vtkTimeStamp ImageTime;
  vtkTimeStamp LookTime;
};

vtkStandardNewMacro(ResampledMapper);

} // anonymous namespace

//------------------------------------------------------------------------------
MapperPointer MakeResampledMapper(int size)
{
  auto mapper = vtkSmartPointer<ResampledMapper>::New();
  mapper->SetSize(size);
  return mapper;
}

} // namespace meniscus::benchmark
