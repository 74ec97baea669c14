// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Surface/MeshingFiles.h"

#include <cstdint>
#include <fstream>
#include <type_traits>

namespace meniscus
{

namespace
{

/** First bytes of the files, with the version of their layout. */
constexpr std::uint64_t TaskMark = 0x314b534154534e4d;   // "MNSTASK1"
constexpr std::uint64_t AnswerMark = 0x31534e415f534e4d; // "MNS_ANS1"

template <class Value>
void Put(std::ostream& out, const Value& value)
{
  static_assert(std::is_trivially_copyable<Value>::value, "copied byte by byte");
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
void PutAll(std::ostream& out, const std::vector<Value>& values)
{
  static_assert(std::is_trivially_copyable<Value>::value, "copied byte by byte");
  Put(out, static_cast<std::uint64_t>(values.size()));
  out.write(reinterpret_cast<const char*>(values.data()),
    static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

/** A file that is read, and the number of its bytes. */
class InputFile
{
public:
  explicit InputFile(const std::string& name)
    : Stream(name, std::ios::binary | std::ios::ate)
    , Size(static_cast<std::uint64_t>(std::max<std::streamoff>(this->Stream.tellg(), 0)))
  {
    this->Stream.seekg(0);
  }

  template <class Value>
  bool Get(Value& value)
  {
    return bool(this->Stream.read(reinterpret_cast<char*>(&value), sizeof value));
  }

  // No array is longer than its file.
  template <class Value>
  bool GetAll(std::vector<Value>& values)
  {
    std::uint64_t count = 0;
    if (!this->Get(count) || count > this->Size / sizeof(Value))
    {
      return false;
    }
    values.resize(count);
    return bool(this->Stream.read(
      reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(Value))));
  }

  bool HasMark(std::uint64_t mark)
  {
    std::uint64_t found = 0;
    return this->Get(found) && found == mark;
  }

private:
  std::ifstream Stream;
  std::uint64_t Size;
};

template <class Corners>
bool AreIndices(const std::vector<Corners>& cells, std::size_t points)
{
  for (const Corners& cell : cells)
  {
    for (const int corner : cell)
    {
      if (corner < 0 || static_cast<std::size_t>(corner) >= points)
      {
        return false;
      }
    }
  }
  return true;
}

} // anonymous namespace

//------------------------------------------------------------------------------
bool WriteMeshingTask(const std::string& name, const MeshingTask& task)
{
  std::ofstream out(name, std::ios::binary);
  Put(out, TaskMark);
  PutAll(out, task.Surface.Points);
  PutAll(out, task.Surface.Triangles);
  Put(out, task.RadiusEdgeRatio);
  Put(out, task.MaximumVolume);
  Put(out, task.KeepsSurface);
  Put(out, task.FillsHull);
  return bool(out.flush());
}

//------------------------------------------------------------------------------
bool ReadMeshingTask(const std::string& name, MeshingTask& task)
{
  InputFile in(name);
  return in.HasMark(TaskMark) && in.GetAll(task.Surface.Points) &&
    in.GetAll(task.Surface.Triangles) && in.Get(task.RadiusEdgeRatio) &&
    in.Get(task.MaximumVolume) && in.Get(task.KeepsSurface) && in.Get(task.FillsHull) &&
    AreIndices(task.Surface.Triangles, task.Surface.Points.size());
}

//------------------------------------------------------------------------------
bool WriteMeshingAnswer(const std::string& name, const MeshingAnswer& answer)
{
  std::ofstream out(name, std::ios::binary);
  Put(out, AnswerMark);
  Put(out, answer.End);
  PutAll(out, answer.Cells.Points);
  PutAll(out, answer.Cells.Cells);
  PutAll(out, answer.Cells.Regions);
  return bool(out.flush());
}

//------------------------------------------------------------------------------
bool ReadMeshingAnswer(const std::string& name, MeshingAnswer& answer)
{
  InputFile in(name);
  TetrahedronCells& cells = answer.Cells;
  return in.HasMark(AnswerMark) && in.Get(answer.End) && in.GetAll(cells.Points) &&
    in.GetAll(cells.Cells) && in.GetAll(cells.Regions) &&
    cells.Regions.size() == cells.Cells.size() && AreIndices(cells.Cells, cells.Points.size());
}

} // namespace meniscus
