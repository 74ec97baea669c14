// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Images that optical instruments make of rays behind a medium. */
#pragma once

#include "Common/RangeLoop.h"

#include <glm/vec2.hpp>

#include <array>
#include <vector>

namespace meniscus
{

/**
 * Knife edge of a schlieren instrument: the light source's image in its plane is moved by a
 * deflection, so that the knife cuts off more or less of it.
 */
struct KnifeEdge
{
  /** Direction from the blade into the open; unit length. */
  glm::dvec2 Open{ 0.0, 1.0 };
  /** Share of the source's image that the blade covers without a deflection, in [0, 1]. */
  double CutOff = 0.5;
  /** Deflection that moves the source's image by its width, in radians, > 0. */
  double Range = 1.0;

  /** Sets the direction into the open, in degrees from the image's first axis. */
  void SetAngle(double degrees);
  /** Deflection towards the open. */
  double Along(const glm::dvec2& deflection) const;
  /** Share of the light that passes, in [0, 1]. */
  double Transmit(const glm::dvec2& deflection) const;
};

/** Fringes between the light behind the medium and a plane reference wave. */
struct Interferometer
{
  /** In the units of the optical path difference, > 0. */
  double Wavelength = 1.0;
  /** Tilt of the reference wave: fringes over the image's width and height; 0 for none. */
  glm::dvec2 Fringes{ 0.0 };

  /**
   * Intensity in [0, 1].
   * @param place in the image, from 0 to 1 along both axes.
   */
  double Interfere(double pathDifference, const glm::dvec2& place) const;
};

/**
 * Irradiance on a screen, 1 without a medium. The light of each pixel goes to the quadrangle
 * between the landing points at its corners, which are means of the landing points of the pixels
 * around. Where quadrangles overlap, behind a caustic, their light adds up. No light is lost but
 * beyond the edges of the image. Memory is kept for the next image.
 */
class Shadowgraph
{
public:
  /**
   * Place of each pixel's ray on the screen in pixels, (0, 0) for the centre of the first one; NaN
   * for a ray that does not land, whose light is missing. To be set before Compute().
   */
  std::vector<glm::dvec2> Landings;

  void Compute(int width, int height, const RangeLoop& loop);
  /** One value per pixel, row by row. */
  const std::vector<double>& GetIrradiance() const { return this->Irradiance; }
  /** Light that falls beyond the image, in pixels. */
  double GetLightOffScreen() const { return this->LightOffScreen; }

private:
  class Band;
  void FindCorners(int row);
  glm::dvec2 FindCorner(int column, int row) const;
  void FindDensities(int row);
  void FindReach(int row);
  void FillBand(int number);
  void AddRow(int row, Band& band) const;
  std::array<glm::dvec2, 4> GetQuadrangle(int column, int row) const;
  const glm::dvec2& CornerAt(int column, int row) const;
  const double* DensitiesOf(int row) const;

  int Width = 0;
  int Height = 0;
  /** Landing points of the corners between pixels, of (Width + 1) * (Height + 1). */
  std::vector<glm::dvec2> Corners;
  /**
   * Light per area in the quadrangle of each pixel, negative for one that is turned over; 0 for a
   * pixel without light, and for the quadrangles that are spread one by one: those that are not
   * convex, and those without an area that divides.
   */
  std::vector<double> Densities;
  /** Columns of the quadrangles of each row that are spread one by one. */
  std::vector<std::vector<int>> Alone;
  /** Least and largest row on the screen that the light of each row of pixels reaches. */
  std::vector<glm::dvec2> Reaches;
  std::vector<double> Irradiance;
  double LightOffScreen = 0.0;
};

/**
 * Value of a picture at a place in pixels, linearly interpolated; beyond its edges, the value at
 * the nearest place on them.
 * @param picture one value per pixel, row by row.
 * @param place (0, 0) for the centre of the first pixel.
 */
double SamplePicture(
  const std::vector<float>& picture, int width, int height, const glm::dvec2& place);

}
