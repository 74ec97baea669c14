// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Meaning of the opacity of a volume property, a setting of several classes. */
#ifndef OpacityModel_h
#define OpacityModel_h

#include "vtkSetGet.h" // For vtkGetMacro

/**
 * Declares the setting OpacityModel in the public part of a class. The class has the member
 * `int OpacityModel`, and meniscusSetClampMacro defines its setter.
 */
#define meniscusOpacityModelMacro()                                                                \
  enum                                                                                             \
  {                                                                                                \
    ATTENUATION_COEFFICIENT = 0,                                                                   \
    OPACITY_PER_UNIT_DISTANCE = 1                                                                  \
  };                                                                                               \
  virtual void SetOpacityModel(int model);                                                         \
  vtkGetMacro(OpacityModel, int);                                                                  \
  void SetOpacityModelToAttenuationCoefficient()                                                   \
  {                                                                                                \
    this->SetOpacityModel(ATTENUATION_COEFFICIENT);                                                \
  }                                                                                                \
  void SetOpacityModelToOpacityPerUnitDistance()                                                   \
  {                                                                                                \
    this->SetOpacityModel(OPACITY_PER_UNIT_DISTANCE);                                              \
  }

#endif
