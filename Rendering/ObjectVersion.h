// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ObjectVersion_h
#define ObjectVersion_h

#include "vtkObject.h"

namespace meniscus
{

/** An object and its modification time: equal as long as it is the same object, unmodified. */
struct ObjectVersion
{
  const vtkObject* Object = nullptr;
  vtkMTimeType Time = 0;

  ObjectVersion() = default;
  explicit ObjectVersion(vtkObject* object)
    : Object(object)
    , Time(object ? object->GetMTime() : 0)
  {
  }
  bool operator==(const ObjectVersion& other) const
  {
    return this->Object == other.Object && this->Time == other.Time;
  }
};

}

#endif
