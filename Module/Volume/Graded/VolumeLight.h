// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light of a medium that emits and absorbs, along bent rays.
 *
 * The arc of a ray in a cell is cut into segments along which the scalar is taken as linear in the
 * length, and the packets' model of composite blending integrates these. It does so in double
 * precision: an arc may have hundreds of segments, which are alike, so that all of them would round
 * the transmittance to the same side. With the ray parameter s of GradedCell.h, dx/ds = p, |p| = n,
 * dp/ds = F and the norm N of F's derivative, a segment of the time T has two errors:
 * 1. The scalar q. With the length l, the second derivative of q by l is grad q * F' / n^2, where
 *    F' is the part of F across the ray. Linear interpolation is off by at most l^2 / 8 times the
 *    largest of it: T^2 / 8 |grad q| |F| (largest n / smallest n)^2. The arc is divided until this
 *    is seen as no more than LargestPictureError on the medium's ErrorScale, or is no more than the
 *    rounding of scalars.
 * 2. The length, which is the integral of |p| by Simpson's rule: T^5 / 2880 times the largest
 *    fourth derivative of |p| by s. The first four derivatives of |p| by p are at most 1, 1 / n,
 *    2 / (sqrt(3) n^2) and 3 / n^3; those of p by s are F, at most N n, N |F| and N^2 n. With a =
 *    |F| / n, the chain rule bounds it by n (3 a^4 + (12 / sqrt(3) + 4) a^2 N + 4 N^2). Where n
 *    changes by up to a factor of 1.16, that is below 6.1 n (a^2 + N)^2, and the relative error is
 *    below ((a^2 + N) T^2)^2 / 470. This is kept below 2^-24, half a unit of single precision.
 * If the scalar is constant in the cells, the second error is the only one.
 */
#pragma once

#include "Volume/Graded/GradedPiece.h"
#include "Volume/Mesh/TetrahedralMesh.h"
#include "Volume/Optics/ErrorScale.h"
#include "Volume/Packet/Data/PacketOptics.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace meniscus
{

/** A medium that emits and absorbs light by a scalar. Everything must outlive its users. */
struct EmittingMedium
{
  const TetrahedralMesh* Mesh = nullptr;
  /** Normalised, one per vertex or one per cell. */
  const std::vector<float>* Scalars = nullptr;
  bool HasCellScalars = false;
  /** Attenuation per world length, and colour. */
  const std::vector<PacketInterval>* Intervals = nullptr;
};

/** Light that reaches the beginning of a ray. */
struct KeptLight
{
  /** Premultiplied colour, and the transmittance for light from behind. */
  float Values[4] = { 0.0f, 0.0f, 0.0f, 1.0f };
};

/** Light of a medium along several rays, whose arcs may come in turn. */
class VolumeLight
{
public:
  /**
   * Error of a normalised scalar, which is in [-1, 1], that is not made smaller: four roundings to
   * single precision. The packets' walk rounds the scalars of vertices and, with the weights, that
   * of a crossing.
   */
  static constexpr double LargestScalarError = 0x1p-22;
  /**
   * Largest error by ErrorScale. With the diameter of the mesh as the scale's length, a ray's
   * colour is off by at most twice as much: 7.7e-6, of the 2e-5 of the ray caster's pictures.
   */
  static constexpr double LargestPictureError = 0x1p-18;

  /** @param rays number of rays. */
  VolumeLight(const EmittingMedium& medium, std::size_t rays);
  ~VolumeLight();
  VolumeLight(const VolumeLight&) = delete;
  VolumeLight& operator=(const VolumeLight&) = delete;

  /**
   * Adds an arc of a ray behind those that it has, in a cell whose scalars are finite. In an
   * inverted cell light goes backwards: as for straight rays, the part of the path before the
   * largest optical path reached has been passed already and is not passed again.
   * @param end share of the time at which the ray ends; 1 for the whole arc.
   */
  void Add(std::size_t ray, GradedArc& arc, double end);

  /** Light of a ray by the arcs that it has. */
  KeptLight Get(std::size_t ray) const;

private:
  /** State of a ray. */
  struct Sum
  {
    double Color[3] = { 0.0, 0.0, 0.0 };
    double Transmittance = 1.0;
    /** Largest optical path reached. */
    double Reached = 0.0;
  };
  class Blending;
  double CountParts(double lower, double upper, double error) const;

  EmittingMedium Medium;
  ErrorScale Scale;
  std::unique_ptr<Blending> Model;
  std::vector<Sum> Sums;
};

}
