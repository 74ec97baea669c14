// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBentMediumAlgorithm
 * @brief   base of the filters with a mesh whose index of refraction bends light
 *
 * The mesh is any vtkDataSet or vtkCompositeDataSet that vtkTetrahedraRayIntegral takes.
 * SetInputArrayToProcess(0, port, 0, association, name), with the mesh's input port, chooses a
 * point array, by default the active scalars: densities of a gas (Quantity DENSITY), from which n =
 * 1 + GladstoneDale * density, or values of n (REFRACTIVE_INDEX). n^2 is quadratic in each
 * tetrahedron, linear at jumps, and rays are exact in it; there is no step size. Errors are of
 * second order in the size of the cells.
 *
 * Cells with a value that is not finite, with n <= 0 or with a negative density are holes; indices
 * below 1 are used. Warnings report both. Errors, with an empty output: no cells, no such point
 * array, no usable values.
 *
 * The output is a vtkImageData, unless a subclass overrides FillOutputPortInformation().
 *
 * @sa vtkBentRayAlgorithm vtkApparentGeometryFilter
 */
#ifndef vtkBentMediumAlgorithm_h
#define vtkBentMediumAlgorithm_h

#include "vtkImageAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkDataObject;

namespace meniscus
{
class BentMedium;
}

class VTKMENISCUS_EXPORT vtkBentMediumAlgorithm : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(vtkBentMediumAlgorithm, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Meanings of the mesh's values. */
  enum
  {
    DENSITY = 0,         ///< density of a gas
    REFRACTIVE_INDEX = 1 ///< index of refraction
  };

  /** @{ */
  /** Set/Get the meaning of the mesh's values. Default is DENSITY. */
  virtual void SetQuantity(int quantity);
  vtkGetMacro(Quantity, int);
  void SetQuantityToDensity() { this->SetQuantity(DENSITY); }
  void SetQuantityToRefractiveIndex() { this->SetQuantity(REFRACTIVE_INDEX); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the Gladstone-Dale constant: n - 1 is this constant times the density. Its unit is one
   * over the density's. Default is 2.26157e-4 m^3/kg: dry air at 589.3 nm, by Ciddor's equations
   * (Applied Optics 35, 1996).
   */
  vtkSetMacro(GladstoneDale, double);
  vtkGetMacro(GladstoneDale, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the index of refraction outside of the mesh, >= 0, for Snell's law on its boundary:
   * for lenses and solids. With 0, the default, nothing is refracted there: the boundary is the end
   * of the data, not of the medium. Has no effect on straight rays.
   */
  virtual void SetOutsideIndex(double index);
  vtkGetMacro(OutsideIndex, double);
  /** @} */

protected:
  /** @param port input port of the mesh. */
  explicit vtkBentMediumAlgorithm(int port = 0);
  ~vtkBentMediumAlgorithm() override;

  /** Lets a port take a mesh. */
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** Reports an error, if there is one. Returns true if there is none. */
  bool TellError(const std::string& error);
  /**
   * Reads the mesh. Returns false after an error, which has been reported, or an abort.
   * @param mesh the mesh's data.
   * @param share share of the progress that this takes.
   */
  bool UpdateMedium(vtkDataObject* mesh, double share);

  /** The medium of the last UpdateMedium(). */
  std::unique_ptr<meniscus::BentMedium> Medium;

private:
  vtkBentMediumAlgorithm(const vtkBentMediumAlgorithm&) = delete;
  void operator=(const vtkBentMediumAlgorithm&) = delete;

  int Quantity = DENSITY;
  double GladstoneDale;
  double OutsideIndex = 0.0;
};

#endif
