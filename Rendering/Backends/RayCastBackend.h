// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Interface of the classes that cast the rays of vtkTetrahedraRayCastMapper. A backend gets the
 * mapper's tables and the rays of a frame and fills an image; a presenter blends that into the
 * window. See Documentation/extending.md for the steps, RayCastBackendRegistry.h for the
 * registration.
 */
#ifndef meniscus_Rendering_Backends_RayCastBackend_h
#define meniscus_Rendering_Backends_RayCastBackend_h

#include "TableVersion.h"

#include "vtkMeniscusModule.h" // For export macro

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace meniscus
{

/** Tables and frame as the library's own backends read them; not installed. */
struct RayCastTables;
struct RayCastFrame;

/** Sums over the rays of a frame. */
struct RayCastStatistics
{
  /** Cells crossed. */
  std::int64_t Steps = 0;
  /** Rays that entered the mesh. */
  std::int64_t Rays = 0;
  /** Rays whose walk did not end on the boundary. */
  std::int64_t Lost = 0;
  /** Rays that found parts of the mesh to overlap; 0 if the backend does not count them. */
  std::int64_t Overlaps = 0;
  /** Pixels that got several rays, and the cells that these crossed, which are part of Steps. */
  std::int64_t RefinedPixels = 0;
  std::int64_t RefiningSteps = 0;
  /** Rays, which are part of Rays, that were not cast, but interpolated between others. */
  std::int64_t Interpolated = 0;
};

/** Memory and work of a backend, which the mapper adds up over its backends. */
struct RayCastCounters
{
  /** Bytes of tables taken in because an input changed, since construction. */
  std::int64_t UploadedBytes = 0;
  /** Bytes of tables kept now in the computer's memory and on a device. */
  std::int64_t HostBytes = 0;
  std::int64_t DeviceBytes = 0;
  /** Times that entries were listed on the processor for a device. */
  std::int64_t EntryListBuilds = 0;
  /** Times that the entries of refracted rays were listed. */
  std::int64_t RefractedEntryLists = 0;
  /** Pixels whose rays were cast, since construction. */
  std::int64_t CastPixels = 0;
};

/** Mesh and scalars as arrays, which stay the mapper's and are valid during a call. */
struct RayCastMesh
{
  /** Positions: xyz per vertex, relative to Center, in units of PositionUnit. */
  const std::int32_t* Positions = nullptr;
  std::int64_t NumberOfVertices = 0;
  /** Length of one step of a position in model coordinates. */
  double PositionUnit = 1.0;
  /** Centre in model coordinates. */
  double Center[3] = { 0.0, 0.0, 0.0 };
  /**
   * Eight numbers per cell: its vertices in ascending order; then, per vertex, the link across the
   * opposite face: 4 * cell + face of the neighbour, negative on the boundary of the visible cells.
   */
  const std::int32_t* Cells = nullptr;
  std::int64_t NumberOfCells = 0;
  /** One normalised scalar per vertex, or one per cell; the other is null. NaN: transparent. */
  const float* VertexScalars = nullptr;
  const float* CellScalars = nullptr;
  /** Versions of vertices with cells, of links, and of scalars. */
  TableVersion MeshVersion;
  TableVersion LinkVersion;
  TableVersion ScalarVersion;
};

/** Piecewise linear transfer function of the main scalar. */
struct RayCastTransferFunction
{
  /**
   * Ten numbers per interval, ascending and without gaps: lower and upper normalised scalar;
   * attenuation coefficient at the lower one, in 1 / world length, and its slope; colour there,
   * red, green and blue, and its slope.
   */
  const float* Intervals = nullptr;
  std::int64_t NumberOfIntervals = 0;
  TableVersion Version;
};

/** Numbers that are affine in the pixel: a vector per frame, column and row of the image. */
struct RayCastAffineMap
{
  double Base[3];
  double PerColumn[3];
  double PerRow[3];
};

/**
 * Rays of an image, in coordinates relative to RayCastMesh::Center with model coordinates' axes and
 * unit. The ray of a pixel is Origin + depth * Direction, both at (column + 0.5 - Width / 2, row +
 * 0.5 - Height / 2), rows from below. It begins at NearDepth.
 */
struct RayCastRays
{
  int Width = 0;
  int Height = 0;
  RayCastAffineMap Origin;
  RayCastAffineMap Direction;
  double NearDepth = 0.0;
  /**
   * A window depth w < 1 ends the ray at the depth (N[0] d + N[1]) / (D[0] d + D[1]) with d = 2 w -
   * 1, N = DepthNumerator and D = DepthDenominator; a window depth of 1 ends it at FarDepth.
   */
  double DepthNumerator[2];
  double DepthDenominator[2];
  double FarDepth = 0.0;
  /** World vector of a model vector, rows of a matrix; its length is the world length. */
  double ModelToWorld[3][3];
};

/** Properties of a frame that a backend may not have. */
struct RayCastFeatures
{
  /** A number of vtkVolumeMapper::BlendModes. */
  int BlendMode = 0;
  bool CellScalars = false;
  bool SeveralComponents = false;
  bool Shading = false;
  /** The light of a medium is attenuated on its way through it (GlobalIlluminationReach). */
  bool GlobalIllumination = false;
  bool GradientOpacity = false;
  bool PreIntegration = false;
  bool ClippingPlanes = false;
  /** Rays are refracted at a membrane, or only the part before or behind it is wanted. */
  bool Membrane = false;
  /** The medium behind the membrane takes and scatters light. */
  bool Medium = false;
};

/** One frame to draw: the mapper's tables, brought up to date, and the rays. */
class VTKMENISCUS_EXPORT RayCastRequest
{
public:
  RayCastRequest(RayCastTables& tables, const RayCastFrame& frame, vtkOpenGLRenderWindow* window);

  RayCastMesh GetMesh() const;
  RayCastTransferFunction GetTransferFunction() const;
  RayCastRays GetRays() const;
  RayCastFeatures GetFeatures() const;
  /** Opacity at which a ray may end. */
  double GetEarlyTerminationOpacity() const;
  /** Window that is drawn to; its OpenGL context is current. */
  vtkOpenGLRenderWindow* GetWindow() const { return this->Window; }

  /** All tables and settings, for the library's own backends. */
  RayCastTables& Tables;
  const RayCastFrame& Frame;

private:
  vtkOpenGLRenderWindow* Window;
};

/** Box of pixels of an image: columns [Left, Right) and rows [Bottom, Top), counted from below. */
struct RayCastImageBox
{
  int Left;
  int Right;
  int Bottom;
  int Top;
};

/** Image to fill and opaque geometry to end rays at, in the memory or on the graphics device. */
class VTKMENISCUS_EXPORT RayCastTarget
{
public:
  virtual ~RayCastTarget() = default;

  /** Pixels of the image; one ray each. */
  virtual int GetWidth() const = 0;
  virtual int GetHeight() const = 0;
  /**
   * Window depths in [0, 1], one per pixel, rows from below; 1 where no ray meets the mesh's box.
   * Valid while the image is made.
   */
  virtual const std::vector<float>& ReadDepths() = 0;
  /**
   * Takes premultiplied RGBA, four numbers per pixel, rows from below. Returns an error or "".
   * @param filled pixels outside this box must be zero, and are neither sent nor drawn.
   */
  virtual std::string WriteImage(const std::vector<float>& rgba, const RayCastImageBox& filled) = 0;
  std::string WriteImage(const std::vector<float>& rgba)
  {
    return this->WriteImage(rgba, { 0, this->GetWidth(), 0, this->GetHeight() });
  }

  /**
   * The depths of the image that the target still holds, complete or begun, if the frame at hand
   * differs from the frame of that image in the depths only; otherwise null. A backend may leave
   * pixels with equal depths as they are.
   */
  virtual const std::vector<float>* GetDepthsOfImage() { return nullptr; }

  /**
   * True if the application may give up this frame: it is a still picture, and the window has an
   * observer of vtkCommand::AbortCheckEvent.
   */
  virtual bool MayStop() { return false; }
  /**
   * Asks the application whether to go on with the image; true without MayStop(). To be called on
   * the thread of Cast(), between parts of the image. After false, Cast() may return without
   * WriteImage(): the window shows its last picture, and the next frame asks for the image again.
   * A backend may keep the parts that are done as long as GetDepthsOfImage() gives their depths.
   */
  virtual bool GoOn() { return true; }

  /** The same on the device: depths of the viewport's size, an image of 4 floats per pixel. */
  virtual vtkTextureObject* GetDepthTexture() = 0;
  virtual vtkTextureObject* GetImageTexture() = 0;
};

/** Memory with counters: of a backend alone, or shared by several (RayCastSharing). */
class VTKMENISCUS_EXPORT RayCastResources
{
public:
  virtual ~RayCastResources() = default;
  virtual RayCastCounters GetCounters() { return RayCastCounters(); }
  /**
   * Frees all objects on the graphics device; the next frame makes them again.
   * @param window  null for the window last drawn to.
   */
  virtual void ReleaseGraphicsResources(vtkWindow* window) { static_cast<void>(window); }
};

/**
 * Caster of rays. Each mapper has its own, made when first asked for a frame. All calls are made on
 * one thread with the window's OpenGL context current. Errors are texts, empty if there is none.
 */
class VTKMENISCUS_EXPORT RayCastBackend : public RayCastResources
{
public:
  /** Returns why the frame cannot be drawn, for the user to read; "" if it can be. */
  virtual std::string CanDraw(const RayCastRequest& request) = 0;
  /** Returns true if the mapper's AUTOMATIC may choose this backend, if it can draw the frame. */
  virtual bool IsAutomatic(const RayCastRequest& request)
  {
    static_cast<void>(request);
    return true;
  }
  /**
   * Returns true if the image of a frame depends on the request and the depths alone, so that an
   * equal frame needs no Cast(): the image of the last one is shown again. So it is if rays begin
   * or end elsewhere outside of the mesh.
   */
  virtual bool IsRepeatable() const { return false; }
  /**
   * Returns true if Cast() itself casts the several rays per pixel of a frame of still pictures.
   * For other backends, the image is the mean of several images with one ray per pixel.
   */
  virtual bool CastsSeveralRays(const RayCastRequest& request) const
  {
    static_cast<void>(request);
    return false;
  }
  /** Updates the backend's own objects from tables that changed. Called before Cast(). */
  virtual std::string Update(const RayCastRequest& request)
  {
    static_cast<void>(request);
    return std::string();
  }
  /** Fills the target's image: by WriteImage() or on the device. */
  virtual std::string Cast(const RayCastRequest& request, RayCastTarget& target) = 0;
  /** Statistics of the last frame, on demand: reading them back may take as long as a frame. */
  virtual RayCastStatistics GetStatistics() { return RayCastStatistics(); }
  /**
   * Returns true if the statistics count overlaps and cost nothing. They are then asked for after
   * every frame, to warn of overlapping cells.
   */
  virtual bool CountsOverlaps() const { return false; }
};

/** Resources that backends of one mapper share, one object of each class. */
class RayCastSharing
{
public:
  template <typename Resources>
  std::shared_ptr<Resources> Get()
  {
    std::shared_ptr<RayCastResources>& object = this->Objects[typeid(Resources)];
    if (!object)
    {
      object = std::make_shared<Resources>();
    }
    return std::static_pointer_cast<Resources>(object);
  }

  const std::map<std::type_index, std::shared_ptr<RayCastResources>>& GetObjects() const
  {
    return this->Objects;
  }

private:
  std::map<std::type_index, std::shared_ptr<RayCastResources>> Objects;
};

}

#endif
