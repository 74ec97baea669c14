// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Images of places: the place on an object that each pixel shows. They are drawn from geometry in
 * double precision, or made by tracing rays through an analytic membrane. Two images are compared
 * pixel by pixel.
 */
#pragma once

#include "HeightField.h"
#include "VTKBasics.h"

namespace meniscus::test
{

/** A membrane of the references as a data set, with or without its normals. */
vtkSmartPointer<vtkPolyData> MakeMembrane(
  const reference::MembraneMesh& mesh, bool withNormals = true);

/**
 * A pinhole camera at the eye that looks at a point, with square images. `halfTangent` is the
 * tangent of half the view angle; z is up in the image.
 */
class PixelCamera
{
public:
  PixelCamera(
    const glm::dvec3& eye, const glm::dvec3& target, double halfTangent, int pixels = 512);

  int GetPixels() const { return this->Pixels; }
  const glm::dvec3& GetEye() const { return this->Eye; }
  /** Unit direction through the middle of a pixel. */
  glm::dvec3 GetRay(int x, int y) const;
  /** Pixel coordinates, and depth along the view. */
  glm::dvec3 Project(const glm::dvec3& point) const;
  /** Ray (x, y) has the direction forward + x' right + y' up with x' and y' from -1 to 1. */
  const glm::dvec3& GetForward() const { return this->Forward; }
  const glm::dvec3& GetRight() const { return this->Right; }
  const glm::dvec3& GetUp() const { return this->Up; }

private:
  glm::dvec3 Eye;
  glm::dvec3 Forward;
  glm::dvec3 Right;
  glm::dvec3 Up;
  int Pixels;
};

/**
 * Place on the object that a pixel shows, or none. If the object's plane extends beyond it, pixels
 * next to the object have places, too.
 */
struct PlacePixel
{
  bool Covered = false;
  double Depth = std::numeric_limits<double>::max();
  glm::dvec3 Place{ 0.0 };
};
using PlacePicture = std::vector<PlacePixel>;

/**
 * Draws the polygons as fans of triangles, with perspective-correct interpolation of the point
 * array "Place" of three components.
 */
PlacePicture DrawPlaces(vtkPolyData* data, const PixelCamera& camera);

/** Adds the point array "Place" with the points' own coordinates. */
void AddPlaces(vtkPolyData* data);

/** Intersection of a refracted ray with the object or its plane. */
using PlaceTracer = std::function<PlacePixel(const glm::dvec3& start, const glm::dvec3& direction)>;

/** The last leg of a sight ray, of unit direction. */
struct LastLeg
{
  glm::dvec3 Start;
  glm::dvec3 Direction;
};

/** The last leg of the sight ray of a unit direction; nothing if the ray ends before. */
using RayTracer = std::function<std::optional<LastLeg>(const glm::dvec3& direction)>;

/** Image of an object by the rays of all pixels; pixels without a last leg stay empty. */
PlacePicture TraceRays(const PixelCamera& camera, const RayTracer& rays, const PlaceTracer& object);

/** Rays behind a membrane, or in front of a mirror; none for those that miss it. */
RayTracer MakeFieldRays(const reference::HeightField& membrane, const glm::dvec3& eye);

/** Image of an object by these rays. */
PlacePicture TracePlaces(
  const reference::HeightField& membrane, const PixelCamera& camera, const PlaceTracer& object);

/** A horizontal square around the axis, at height `y`, below the membrane or above it. */
PlaceTracer MakeSquareTracer(double y, double size);

/** The nearest of the triangles within `length`; places are positions. For one thread. */
PlaceTracer MakeMeshTracer(vtkPolyData* triangles, double length = 1e4);

/** Extent of the object in a pixel: the largest distance to a neighbouring pixel's place. */
double GetFootprint(const PlacePicture& picture, const PixelCamera& camera, std::size_t pixel);

/** A membrane above a horizontal square of tiles. */
struct PictureScene
{
  std::string Name;
  reference::HeightField Field;
  glm::dvec3 Eye;
  int Cells;    ///< cells of the membrane along a side
  double Depth; ///< depth of the square
  double Size;  ///< side of the square
  int Tiles;    ///< number of tiles along a side

  PixelCamera GetCamera() const;
};

/** Domes and waves with zones of convergence. */
const std::vector<PictureScene>& GetPictureScenes();

struct PlaceComparison
{
  int Covered = 0;  ///< number of pixels covered in the reference
  int Coverage = 0; ///< number of pixels that only one of the two images covers
  int Place = 0;    ///< number of pixels with an error of more than half a pixel
  /** Largest error, in pixels of `Part`, over the pixels that both images cover. */
  double Error = 0.0;

  static constexpr double Part = 0.99;
  /** Error in pixels beyond which a pixel counts as showing another place. */
  static constexpr double AcceptedPixels = 0.5;
};

PlaceComparison ComparePlaces(
  const PlacePicture& truth, const PlacePicture& other, const PixelCamera& camera);

}
