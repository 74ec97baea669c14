// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVRefractionErrorVolume
 * @brief   vtkRefractionErrorVolume for ParaView on several ranks
 *
 * Every rank measures its part of the box behind the whole membrane, which is gathered from all
 * ranks and blocks, as is the finer one. The statistics are over the samples of all ranks, each
 * counted once, and are the same on all of them. The number and the largest error equal the results
 * of one rank to the last bit, mean and deviation up to the rounding of their sums.
 */
#ifndef vtkPVRefractionErrorVolume_h
#define vtkPVRefractionErrorVolume_h

#include "InterfaceTable.h"                   // For the table of interfaces
#include "vtkMeniscusRepresentationsModule.h" // For export macro
#include "vtkRefractionErrorVolume.h"

class VTKMENISCUSREPRESENTATIONS_EXPORT vtkPVRefractionErrorVolume : public vtkRefractionErrorVolume
{
public:
  static vtkPVRefractionErrorVolume* New();
  vtkTypeMacro(vtkPVRefractionErrorVolume, vtkRefractionErrorVolume);

  /** @{ */
  /**
   * Set the rows of the table of interfaces and their number, and the two indices that are used
   * without rows. See InterfaceTable.
   */
  meniscusInterfaceTableDeclarations();
  /** @} */

  /** Sets the exact form of the first surface, in all rows that name it. */
  void SetExactMembrane(vtkImplicitFunction* function);

protected:
  vtkPVRefractionErrorVolume();
  ~vtkPVRefractionErrorVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  void ReduceStatistics(vtkImageData* output);

  vtkPVRefractionErrorVolume(const vtkPVRefractionErrorVolume&) = delete;
  void operator=(const vtkPVRefractionErrorVolume&) = delete;

  meniscus::InterfaceTable Table;
};

#endif
