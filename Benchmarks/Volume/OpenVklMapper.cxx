// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpenVklMapper.h"

#include "PixelRays.h"

#include <vtkCellArray.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRayCastImageDisplayHelper.h>
#include <vtkRenderer.h>
#include <vtkSMPTools.h>
#include <vtkTetra.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <openvkl/openvkl.h>

// Needs the header above.
#include <openvkl/device/openvkl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace meniscus::benchmark
{

namespace
{

/** Rays of a packet, and their block of pixels. */
constexpr int Lanes = 8;
constexpr int BlockWidth = 4;
constexpr int BlockHeight = 2;

/** Nodes of the tables of functions. */
constexpr int Nodes = 4096;

/**
 * An interval is taken to be at most this many nominal lengths long. Open VKL's nominal length is
 * the size of the smallest cell. Beside flat cells it is 0, and its renderers take no sample.
 */
constexpr float LargestCount = 1024.0f;

/** Opacity at which a ray ends. */
constexpr float FullOpacity = 0.999f;

/** -1 for rays that take part, 0 for others; aligned for Open VKL, as all that it reads or writes.
 */
struct Mask
{
  int Of[Lanes] = {};

  int& operator[](int lane) { return this->Of[lane]; }
  int operator[](int lane) const { return this->Of[lane]; }
  bool IsEmpty() const
  {
    return std::all_of(this->Of, this->Of + Lanes, [](int lane) { return lane == 0; });
  }
};

//------------------------------------------------------------------------------
// The device, loaded once; it lives as long as the process. Null if it cannot be loaded.
VKLDevice OpenDevice(int threads)
{
  static const VKLDevice device = [threads]()
  {
    vklInit();
    VKLDevice made = vklNewDevice("cpu");
    if (made)
    {
      if (threads > 0)
      {
        vklDeviceSetInt(made, "numThreads", threads);
      }
      vklCommitDevice(made);
    }
    return made;
  }();
  return device;
}

//------------------------------------------------------------------------------
// Colour and attenuation coefficient by value, interpolated between nodes.
class FunctionTable
{
public:
  struct Entry
  {
    float Color[3];
    float Attenuation;
  };

  void Make(vtkVolumeProperty* look, const double range[2])
  {
    vtkPiecewiseFunction* opacity = look->GetScalarOpacity();
    vtkColorTransferFunction* color = look->GetRGBTransferFunction();
    const double unit = look->GetScalarOpacityUnitDistance();
    this->Entries.resize(Nodes + 1);
    for (int i = 0; i <= Nodes; ++i)
    {
      const double value = range[0] + (range[1] - range[0]) * i / Nodes;
      double rgb[3];
      color->GetColor(value, rgb);
      this->Entries[i] = { { static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                             static_cast<float>(rgb[2]) },
        static_cast<float>(opacity->GetValue(value) / unit) };
    }
    this->Low = static_cast<float>(range[0]);
    this->Step = static_cast<float>((range[1] - range[0]) / Nodes);
  }

  Entry At(float value) const
  {
    // Values that are all equal are at the first node.
    const float place =
      this->Step > 0.0f ? std::clamp((value - this->Low) / this->Step, 0.0f, float(Nodes)) : 0.0f;
    const int node = std::min(static_cast<int>(place), Nodes - 1);
    const float share = place - static_cast<float>(node);
    const Entry& below = this->Entries[node];
    const Entry& above = this->Entries[node + 1];
    Entry result;
    for (int i = 0; i < 3; ++i)
    {
      result.Color[i] = below.Color[i] + share * (above.Color[i] - below.Color[i]);
    }
    result.Attenuation = below.Attenuation + share * (above.Attenuation - below.Attenuation);
    return result;
  }

  // Ranges of values with an opacity above 0, for Open VKL's iterators.
  std::vector<vkl_range1f> VisibleRanges() const
  {
    std::vector<vkl_range1f> ranges;
    for (int i = 0; i < Nodes; ++i)
    {
      if (this->Entries[i].Attenuation <= 0.0f && this->Entries[i + 1].Attenuation <= 0.0f)
      {
        continue;
      }
      const vkl_range1f range{ this->ValueOf(i), this->ValueOf(i + 1) };
      if (!ranges.empty() && ranges.back().upper >= range.lower)
      {
        ranges.back().upper = range.upper;
      }
      else
      {
        ranges.push_back(range);
      }
    }
    return ranges;
  }

private:
  float ValueOf(int node) const { return this->Low + static_cast<float>(node) * this->Step; }

  std::vector<Entry> Entries;
  float Low = 0.0f;
  float Step = 0.0f;
};

//------------------------------------------------------------------------------
// The mesh as Open VKL's volume.
class VklMesh
{
public:
  explicit VklMesh(VKLDevice device)
    : Device(device)
  {
  }
  VklMesh(const VklMesh&) = delete;
  void operator=(const VklMesh&) = delete;
  ~VklMesh() { this->Release(); }

  void Make(vtkUnstructuredGridBase* input)
  {
    this->Release();
    auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
    this->Volume = vklNewVolume(this->Device, "unstructured");
    this->SetPoints(grid);
    this->SetCells(grid);
    vklCommit(this->Volume);
    this->Sampler = vklNewSampler(this->Volume);
    vklCommit(this->Sampler);
    this->Context = vklNewIntervalIteratorContext(this->Sampler);
    this->Made = true;
  }

  // Iterators return intervals with values in these ranges.
  void SetVisibleRanges(const std::vector<vkl_range1f>& ranges)
  {
    this->SetArray(this->Context, "valueRanges", ranges.size(), VKL_BOX1F, ranges.data());
    vklCommit(this->Context);
  }

  const VKLSampler* GetSampler() const { return &this->Sampler; }
  const VKLIntervalIteratorContext* GetContext() const { return &this->Context; }

private:
  void SetArray(
    VKLObject object, const char* name, std::size_t count, VKLDataType type, const void* values)
  {
    VKLData data = vklNewData(this->Device, count, type, values, VKL_DATA_DEFAULT, 0);
    vklSetData(object, name, data);
    vklRelease(data);
  }

  // Open VKL finds no value in tetrahedra of the other orientation, which VTK draws like all
  // others.
  static bool IsTurned(vtkUnstructuredGrid* grid, vtkIdList* corners)
  {
    double points[4][3];
    for (int i = 0; i < 4; ++i)
    {
      grid->GetPoint(corners->GetId(i), points[i]);
    }
    return vtkTetra::ComputeVolume(points[0], points[1], points[2], points[3]) < 0.0;
  }

  void SetPoints(vtkUnstructuredGrid* grid)
  {
    const vtkIdType count = grid->GetNumberOfPoints();
    vtkDataArray* scalars = grid->GetPointData()->GetScalars();
    std::vector<float> points(3 * count);
    std::vector<float> values(count);
    vtkSMPTools::For(0, count,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          double point[3];
          grid->GetPoints()->GetData()->GetTuple(i, point);
          std::copy(point, point + 3, points.begin() + 3 * i);
          values[i] = static_cast<float>(scalars->GetComponent(i, 0));
        }
      });
    this->SetArray(this->Volume, "vertex.position", count, VKL_VEC3F, points.data());
    this->SetArray(this->Volume, "vertex.data", count, VKL_FLOAT, values.data());
  }

  void SetCells(vtkUnstructuredGrid* grid)
  {
    const vtkIdType count = grid->GetNumberOfCells();
    vtkCellArray* cells = grid->GetCells();
    std::vector<std::uint32_t> corners;
    corners.reserve(cells->GetNumberOfConnectivityIds());
    std::vector<std::uint32_t> starts(count);
    std::vector<std::uint8_t> types(count);
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < count; ++i)
    {
      starts[i] = static_cast<std::uint32_t>(corners.size());
      types[i] = static_cast<std::uint8_t>(grid->GetCellType(i));
      cells->GetCellAtId(i, ids);
      if (types[i] == VTK_TETRA && IsTurned(grid, ids))
      {
        const vtkIdType first = ids->GetId(0);
        ids->SetId(0, ids->GetId(1));
        ids->SetId(1, first);
      }
      corners.insert(corners.end(), ids->begin(), ids->end());
    }
    this->SetArray(this->Volume, "index", corners.size(), VKL_UINT, corners.data());
    this->SetArray(this->Volume, "cell.index", count, VKL_UINT, starts.data());
    this->SetArray(this->Volume, "cell.type", count, VKL_UCHAR, types.data());
  }

  void Release()
  {
    if (this->Made)
    {
      vklRelease(this->Context);
      vklRelease(this->Sampler);
      vklRelease(this->Volume);
      this->Made = false;
    }
  }

  VKLDevice Device;
  VKLVolume Volume;
  VKLSampler Sampler;
  VKLIntervalIteratorContext Context;
  bool Made = false;
};

//------------------------------------------------------------------------------
// Colours (premultiplied) and opacities of the rays of a packet.
struct PacketColors
{
  float Color[3][Lanes] = {};
  float Opacity[Lanes] = {};
};

//------------------------------------------------------------------------------
// Casts the rays of one packet after the other. Each thread has its own.
class PacketCaster
{
public:
  PacketCaster(const VklMesh& mesh, const FunctionTable& function, double rate)
    : Mesh(mesh)
    , Function(function)
    , Rate(static_cast<float>(rate))
    , Buffer(vklGetIntervalIteratorSize8(mesh.GetContext()) + Alignment)
  {
  }

  PacketColors Cast(const reference::Ray rays[Lanes], Mask valid)
  {
    alignas(32) vkl_vrange1f8 range;
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const reference::Ray& ray = rays[lane];
      this->Origin.x[lane] = static_cast<float>(ray.Origin[0]);
      this->Origin.y[lane] = static_cast<float>(ray.Origin[1]);
      this->Origin.z[lane] = static_cast<float>(ray.Origin[2]);
      const auto length = static_cast<float>(reference::MakeLength(ray.Direction));
      this->Direction.x[lane] = static_cast<float>(ray.Direction[0]) / length;
      this->Direction.y[lane] = static_cast<float>(ray.Direction[1]) / length;
      this->Direction.z[lane] = static_cast<float>(ray.Direction[2]) / length;
      range.lower[lane] = static_cast<float>(ray.Begin) * length;
      range.upper[lane] = static_cast<float>(ray.End) * length;
    }
    void* place = this->Buffer.data();
    std::size_t space = this->Buffer.size();
    std::align(Alignment, space - Alignment, place, space);
    VKLIntervalIterator8 iterator = vklInitIntervalIterator8(
      valid.Of, this->Mesh.GetContext(), &this->Origin, &this->Direction, &range, nullptr, place);
    PacketColors colors;
    VKLInterval8 interval;
    Mask found;
    while (!valid.IsEmpty())
    {
      vklIterateInterval8(valid.Of, iterator, &interval, found.Of);
      for (int lane = 0; lane < Lanes; ++lane)
      {
        valid[lane] = valid[lane] && found[lane] ? -1 : 0;
      }
      this->March(interval, valid, colors);
      for (int lane = 0; lane < Lanes; ++lane)
      {
        valid[lane] = colors.Opacity[lane] < FullOpacity ? valid[lane] : 0;
      }
    }
    return colors;
  }

private:
  static constexpr std::size_t Alignment = 64;

  // All steps of one interval of each ray.
  void March(const VKLInterval8& interval, Mask valid, PacketColors& colors) const
  {
    float begin[Lanes];
    float step[Lanes];
    for (int lane = 0; lane < Lanes; ++lane)
    {
      begin[lane] = interval.tRange.lower[lane];
      const float length = interval.tRange.upper[lane] - begin[lane];
      step[lane] = std::max(interval.nominalDeltaT[lane], length / LargestCount) / this->Rate;
    }
    while (true)
    {
      bool any = false;
      float steps[Lanes] = {};
      alignas(32) vkl_vvec3f8 places = {};
      for (int lane = 0; lane < Lanes; ++lane)
      {
        const float end = interval.tRange.upper[lane];
        valid[lane] = begin[lane] < end && colors.Opacity[lane] < FullOpacity ? valid[lane] : 0;
        if (valid[lane])
        {
          const float next = std::min(begin[lane] + step[lane], end);
          const float middle = 0.5f * (begin[lane] + next);
          places.x[lane] = this->Origin.x[lane] + middle * this->Direction.x[lane];
          places.y[lane] = this->Origin.y[lane] + middle * this->Direction.y[lane];
          places.z[lane] = this->Origin.z[lane] + middle * this->Direction.z[lane];
          steps[lane] = next - begin[lane];
          // A step that is lost in rounding would never end.
          begin[lane] = next > begin[lane] ? next : end;
          any = true;
        }
      }
      if (!any)
      {
        return;
      }
      alignas(32) float samples[Lanes];
      vklComputeSample8(valid.Of, this->Mesh.GetSampler(), &places, samples);
      this->Add(samples, steps, valid, colors);
    }
  }

  void Add(const float samples[Lanes], const float steps[Lanes], const Mask& valid,
    PacketColors& colors) const
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      // Outside of the mesh, samples are not numbers.
      if (valid[lane] && !std::isnan(samples[lane]))
      {
        const FunctionTable::Entry entry = this->Function.At(samples[lane]);
        const float share =
          (1.0f - colors.Opacity[lane]) * -std::expm1(-entry.Attenuation * steps[lane]);
        for (int i = 0; i < 3; ++i)
        {
          colors.Color[i][lane] += share * entry.Color[i];
        }
        colors.Opacity[lane] += share;
      }
    }
  }

  const VklMesh& Mesh;
  const FunctionTable& Function;
  float Rate;
  std::vector<unsigned char> Buffer;
  alignas(32) vkl_vvec3f8 Origin = {};
  alignas(32) vkl_vvec3f8 Direction = {};
};

//------------------------------------------------------------------------------
class OpenVklMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static OpenVklMapper* New();
  vtkTypeMacro(OpenVklMapper, vtkUnstructuredGridVolumeMapper);

  void SetUp(VKLDevice device, double rate)
  {
    this->Mesh = std::make_unique<VklMesh>(device);
    this->Rate = rate;
  }

  void Render(vtkRenderer* renderer, vtkVolume* volume) override
  {
    vtkUnstructuredGridBase* grid = this->GetInput();
    vtkVolumeProperty* look = volume->GetProperty();
    const bool changed = grid != this->Source || grid->GetMTime() > this->MeshTime;
    if (changed)
    {
      this->Mesh->Make(grid);
      this->Source = grid;
      this->MeshTime.Modified();
    }
    if (changed || look != this->Look || look->GetMTime() > this->LookTime)
    {
      double range[2];
      grid->GetPointData()->GetScalars()->GetFiniteRange(range);
      this->Function.Make(look, range);
      const std::vector<vkl_range1f> ranges = this->Function.VisibleRanges();
      this->Visible = !ranges.empty();
      if (this->Visible)
      {
        this->Mesh->SetVisibleRanges(ranges);
      }
      this->Look = look;
      this->LookTime.Modified();
    }
    // Without ranges, Open VKL would return all values.
    if (!this->Visible)
    {
      return;
    }
    this->Cast(renderer);
    this->Display->RenderTexture(volume, renderer, this->Memory, this->Size, this->Size,
      this->Corner, 0.0f, this->Image.data());
  }

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Display->ReleaseGraphicsResources(window);
  }

protected:
  OpenVklMapper() { this->Display->PreMultipliedColorsOn(); }

private:
  void Cast(vtkRenderer* renderer)
  {
    const test::PixelRays rays(renderer);
    this->Size[0] = rays.GetWidth();
    this->Size[1] = rays.GetHeight();
    for (int i = 0; i < 2; ++i)
    {
      this->Memory[i] = 1;
      while (this->Memory[i] < this->Size[i])
      {
        this->Memory[i] *= 2;
      }
    }
    this->Image.assign(std::size_t(4) * this->Memory[0] * this->Memory[1], 0);
    const int columns = (this->Size[0] + BlockWidth - 1) / BlockWidth;
    const int rows = (this->Size[1] + BlockHeight - 1) / BlockHeight;
    // Rows of blocks in many parts, since most of the work may be in a few of them.
    vtkSMPTools::For(0, rows, 2,
      [&](vtkIdType begin, vtkIdType end)
      {
        PacketCaster caster(*this->Mesh, this->Function, this->Rate);
        for (int row = static_cast<int>(begin); row < end; ++row)
        {
          for (int column = 0; column < columns; ++column)
          {
            this->CastBlock(caster, rays, column * BlockWidth, row * BlockHeight);
          }
        }
      });
  }

  void CastBlock(PacketCaster& caster, const test::PixelRays& rays, int left, int bottom)
  {
    reference::Ray packet[Lanes];
    Mask valid;
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const int x = left + lane % BlockWidth;
      const int y = bottom + lane / BlockWidth;
      packet[lane] = rays.GetRay(x, y);
      valid[lane] = x < this->Size[0] && y < this->Size[1] ? -1 : 0;
    }
    const PacketColors colors = caster.Cast(packet, valid);
    for (int lane = 0; lane < Lanes; ++lane)
    {
      if (!valid[lane])
      {
        continue;
      }
      const std::size_t pixel =
        std::size_t(bottom + lane / BlockWidth) * this->Memory[0] + left + lane % BlockWidth;
      unsigned char* out = &this->Image[4 * pixel];
      for (int i = 0; i < 3; ++i)
      {
        out[i] = ToByte(colors.Color[i][lane]);
      }
      out[3] = ToByte(colors.Opacity[lane]);
    }
  }

  static unsigned char ToByte(float value)
  {
    return static_cast<unsigned char>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
  }

  std::unique_ptr<VklMesh> Mesh;
  FunctionTable Function;
  double Rate = 1.0;
  bool Visible = false;
  vtkNew<vtkRayCastImageDisplayHelper> Display;
  std::vector<unsigned char> Image;
  int Memory[2] = {};
  int Size[2] = {};
  int Corner[2] = {};
  vtkUnstructuredGridBase* Source = nullptr;
  vtkVolumeProperty* Look = nullptr;
  vtkTimeStamp MeshTime;
  vtkTimeStamp LookTime;
};

vtkStandardNewMacro(OpenVklMapper);

} // anonymous namespace

//------------------------------------------------------------------------------
MapperPointer MakeOpenVklMapper(double rate, int threads)
{
  VKLDevice device = OpenDevice(threads);
  if (!device)
  {
    return nullptr;
  }
  auto mapper = vtkSmartPointer<OpenVklMapper>::New();
  mapper->SetUp(device, rate);
  return mapper;
}

} // namespace meniscus::benchmark
