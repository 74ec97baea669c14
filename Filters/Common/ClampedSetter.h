// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/**
 * Defines the setter of a number that is limited to [minimum, maximum], as vtkSetClampMacro does in
 * a header, without its two public methods for the limits. A number that is not one stays.
 */
#define meniscusSetClampMacro(className, name, type, minimum, maximum)                             \
  void className::Set##name(type value)                                                            \
  {                                                                                                \
    const type limited = value < (minimum) ? (minimum) : value > (maximum) ? (maximum) : value;    \
    if (this->name != limited)                                                                     \
    {                                                                                              \
      this->name = limited;                                                                        \
      this->Modified();                                                                            \
    }                                                                                              \
  }
