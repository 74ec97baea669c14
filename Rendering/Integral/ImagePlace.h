// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rendering/Integral/IntegralView.h"

#include <string>

class vtkInformation;
class vtkInformationVector;

namespace meniscus
{

/** Origin, spacing and direction of an image whose points are the centres of a rectangle's parts.
 */
struct ImagePlace
{
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Spacing[3] = { 1.0, 1.0, 1.0 };
  double Direction[9] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
};

/** @param size numbers of the rectangle's parts. */
ImagePlace PlaceOf(const ParallelRectangle& rectangle, const int size[2]);

/** Reason why an image cannot have a size; empty if it can. */
std::string DescribeBadSize(const int size[2]);

/**
 * Announces an image of floats. A size that is not valid counts as 1: its error is reported when
 * there is an output to empty.
 */
void AnnounceImage(vtkInformation* output, const int size[2]);

/** Asks for whole inputs on so many ports: every part of the image needs them. */
void RequestWholeInputs(vtkInformationVector** inputs, int ports);

}
