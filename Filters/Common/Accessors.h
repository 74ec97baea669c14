// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Setters and getters of classes that do not fit VTK's macros. */
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

/** Defines setter and getter of an object in a vtkSmartPointer, a member of the class or below. */
#define meniscusObjectMacro(className, name, type, member)                                         \
  void className::Set##name(type* object)                                                          \
  {                                                                                                \
    if (this->member != object)                                                                    \
    {                                                                                              \
      this->member = object;                                                                       \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  type* className::Get##name()                                                                     \
  {                                                                                                \
    return this->member;                                                                           \
  }

/**
 * Defines a getter that returns an expression of the class's vtkInternals. The name comes with the
 * parameter list and, if the getter has it, `const`, as in `NumberOfRays() const`.
 */
#define meniscusGetInternalMacro(className, type, name, expression)                                \
  type className::Get##name                                                                        \
  {                                                                                                \
    return static_cast<type>(this->Internals->expression);                                         \
  }
