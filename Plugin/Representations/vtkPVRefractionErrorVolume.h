// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVRefractionErrorVolume
 * @brief   vtkRefractionErrorVolume as ParaView runs it on several ranks
 *
 * Every rank measures its part of the box behind the whole membrane, which is gathered from all
 * ranks and blocks, as is the finer one. The statistics of a rank are of its own samples.
 */
#ifndef vtkPVRefractionErrorVolume_h
#define vtkPVRefractionErrorVolume_h

#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkRefractionErrorVolume.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVRefractionErrorVolume : public vtkRefractionErrorVolume
{
public:
  static vtkPVRefractionErrorVolume* New();
  vtkTypeMacro(vtkPVRefractionErrorVolume, vtkRefractionErrorVolume);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPVRefractionErrorVolume();
  ~vtkPVRefractionErrorVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPVRefractionErrorVolume(const vtkPVRefractionErrorVolume&) = delete;
  void operator=(const vtkPVRefractionErrorVolume&) = delete;
};

#endif
