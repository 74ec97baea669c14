// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/PatchIntersectionBatch.h"

#include "Refraction/Membrane/Optics.h"
#include "Simd/InstructionSets.h"
#include "Simd/LaneLoop.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace meniscus
{
namespace
{

/** Loop bodies, for one lane each. */
struct NormalKernel
{
  CurvedPatch Patch;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const glm::dvec3 normal = this->Patch.GetNormal(glm::dvec2(lanes.X[i], lanes.Y[i]));
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.Normal[axis][i] = normal[axis];
    }
  }
};

/** A place in the facet's plane, and the height of the patch's point there. */
struct PlaceOnPatch
{
  float X;
  float Y;
  float Height;
};

/** A ray about the plane of a facet, in single precision. Lengths are in units of its size. */
struct RayAtFacet
{
  RayAtFacet(const PatchStart& start, const PatchIntersectionBatch& lanes, int i)
  {
    const glm::vec3 direction(lanes.GetDirection(i));
    this->PerHeight = 1.0f / glm::dot(start.Up, direction);
    this->ByX = this->PerHeight * glm::dot(start.ByX, direction);
    this->ByY = this->PerHeight * glm::dot(start.ByY, direction);
    this->X = static_cast<float>(lanes.X[i]);
    this->Y = static_cast<float>(lanes.Y[i]);
  }

  /** Depth per height above the plane. */
  float PerHeight;
  float ByX;
  float ByY;
  /** Intersection with the plane. */
  float X;
  float Y;
};

/** Sets the lane's place unless the patch is far from flat for the ray. */
void SetPlace(const PatchStart& start, const RayAtFacet& ray, const PlaceOnPatch& place,
  PatchIntersectionBatch& lanes, int i)
{
  constexpr float farthest = 0.25f;
  const bool isNearX = std::fabs(place.X - ray.X) < farthest;
  const bool isNearY = std::fabs(place.Y - ray.Y) < farthest;
  const bool isNear = isNearX & isNearY; // without a branch
  lanes.PatchX[i] = lanes.X[i] + static_cast<double>(isNear ? place.X - ray.X : 0.0f);
  lanes.PatchY[i] = lanes.Y[i] + static_cast<double>(isNear ? place.Y - ray.Y : 0.0f);
  lanes.Behind[i] = start.Size * static_cast<double>(isNear ? place.Height * ray.PerHeight : 0.0f);
}

/** The shift from the plane to the patch along its normal, and the normal, at a place. */
struct ShiftAt
{
  ShiftAt(const PatchStart& start, float x, float y)
  {
    const float c = 1.0f - x - y;
    const float products[3] = { x * y, y * c, c * x };
    this->Forms[0] = start.Symmetric[0] + start.Asymmetric[0] * (x - y);
    this->Forms[1] = start.Symmetric[1] + start.Asymmetric[1] * (y - c);
    this->Forms[2] = start.Symmetric[2] + start.Asymmetric[2] * (c - x);
    const float form =
      products[0] * this->Forms[0] + products[1] * this->Forms[1] + products[2] * this->Forms[2];
    this->Up = start.AlongUp.At(c, x, y, products);
    this->AlongX = start.AlongX.At(c, x, y, products);
    this->AlongY = start.AlongY.At(c, x, y, products);
    // 2 / (l + l^2) for a normal of a length l near 1, to the first order in l^2 - 1.
    const float squared = this->Up * this->Up + this->AlongX * this->AlongX * start.Sides[0] +
      this->AlongY * (this->AlongY * start.Sides[1] + this->AlongX * start.Sides[2]);
    this->PerForm = 1.75f - 0.75f * squared;
    this->Shift = form * this->PerForm;
  }

  float Forms[3];
  float PerForm;
  float Shift;
  float Up;
  float AlongX;
  float AlongY;
};

/**
 * Largest spread of a patch's normals s for GentleStartKernel. Shifts are up to about s / 4 of the
 * longest edge. A ray of the slant t moves by up to m = g t s / 4 along the facet, g altitudes of
 * which are as long as that edge. Left out are the change of the normals, by 2 s, which moves the
 * place by g s / 4 * 2 s (1 + t) m, and half of m^2 times the second derivative of the shift along
 * the ray, 2 g t s: together less than (g t s)^3 / 3. Rays with a longer last step than Newton's
 * method may have need two steps; none of those does that meet the dome or the lens of the
 * benchmark.
 */
constexpr double LargestGentleSpread = 0.04;

/** One step of Newton's method from the plane, with the slope of the shift at a fixed normal. */
struct GentleStartKernel
{
  PatchStart Start;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const PatchStart& start = this->Start;
    const RayAtFacet ray(start, lanes, i);
    const float x = ray.X;
    const float y = ray.Y;
    const float c = 1.0f - x - y;
    const ShiftAt at(start, x, y);
    const float cross = c * x * start.Asymmetric[2];
    const float formByX = y * (at.Forms[0] - at.Forms[1]) + (c - x) * at.Forms[2] +
      x * y * start.Asymmetric[0] + y * c * start.Asymmetric[1] - 2.0f * cross;
    const float formByY = x * (at.Forms[0] - at.Forms[2]) + (c - y) * at.Forms[1] -
      x * y * start.Asymmetric[0] + 2.0f * y * c * start.Asymmetric[1] - cross;
    // Moves per shift.
    const float moveX = at.Up * ray.ByX - at.AlongX;
    const float moveY = at.Up * ray.ByY - at.AlongY;
    const float slope = at.PerForm * (formByX * moveX + formByY * moveY);
    const float shift = at.Shift / (1.0f - slope);
    SetPlace(start, ray, { x + shift * moveX, y + shift * moveY, shift * at.Up }, lanes, i);
  }
};

struct StartKernel
{
  PatchStart Start;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const PatchStart& start = this->Start;
    const RayAtFacet ray(start, lanes, i);
    PlaceOnPatch place{ ray.X, ray.Y, 0.0f };
    PlaceOnPatch before = place;
    float lastMove = 0.0f;
    for (int step = 0; step < Steps; ++step)
    {
      lastMove = place.Height - before.Height;
      before = place;
      const ShiftAt at(start, place.X, place.Y);
      place.Height = at.Shift * at.Up;
      place.X = ray.X + (place.Height * ray.ByX - at.Shift * at.AlongX);
      place.Y = ray.Y + (place.Height * ray.ByY - at.Shift * at.AlongY);
    }
    // Steps shrink by a factor that hardly changes: the sum of all that would follow (Aitken).
    const float move = place.Height - before.Height;
    const float difference = lastMove - move;
    const float rest = difference != 0.0f ? move / difference : 0.0f;
    place.X += rest * (place.X - before.X);
    place.Y += rest * (place.Y - before.Y);
    place.Height += rest * move;
    SetPlace(start, ray, place, lanes, i);
  }

  static constexpr int Steps = 2;
};

struct PatchKernel
{
  CurvedPatch Patch;
  double Scale;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const glm::dvec3 direction = lanes.GetDirection(i);
    const glm::dvec3 start = lanes.GetStart(i);
    PatchJet jet;
    this->Patch.Evaluate(glm::dvec2(lanes.PatchX[i], lanes.PatchY[i]), jet);
    // Cramer's rule for by0 x + by1 y - direction l = rest.
    const glm::dvec3 along = this->Scale * direction;
    const glm::dvec3 rest = start + (lanes.Depth[i] + lanes.Behind[i]) * direction - jet.Position;
    const glm::dvec3 byX = glm::cross(jet.PositionBy[1], along);
    const double inverse = 1.0 / glm::dot(jet.PositionBy[0], byX);
    const double x = inverse * glm::dot(rest, byX);
    const double y = inverse * glm::dot(jet.PositionBy[0], glm::cross(rest, along));
    const double l = -inverse * glm::dot(rest, glm::cross(jet.PositionBy[0], jet.PositionBy[1]));
    lanes.PatchX[i] += x;
    lanes.PatchY[i] += y;
    lanes.Behind[i] += l * this->Scale;
    lanes.Move[i] = std::max(std::max(std::fabs(x), std::fabs(y)), std::fabs(l));
    // The last step is so short that the normal is linear within rounding.
    const glm::dvec3 normal = jet.Normal + x * jet.NormalBy[0] + y * jet.NormalBy[1];
    lanes.Normal[0][i] = normal.x;
    lanes.Normal[1][i] = normal.y;
    lanes.Normal[2][i] = normal.z;
  }
};

struct SearchKernel
{
  PatchSearchLimits Limits;
  double Scale;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const double x = lanes.PatchX[i];
    const double y = lanes.PatchY[i];
    const double least = std::min(std::min(x, y), 1.0 - x - y);
    const bool isNear = (std::fabs(x - lanes.X[i]) <= 1.0) & (std::fabs(y - lanes.Y[i]) <= 1.0) &
      (std::fabs(lanes.Behind[i]) <= this->Scale);
    const bool hasSettled = lanes.Move[i] < this->Limits.LastStep;
    const bool isInReach = least >= -this->Limits.Reach;
    const bool isInside = least >= -this->Limits.Border;
    const std::int64_t going = isNear ? PatchSearch::GoesOn : PatchSearch::Fails;
    const std::int64_t beside = isInReach ? PatchSearch::Misses : PatchSearch::EndsOutside;
    const std::int64_t settled = isInside ? PatchSearch::Meets : beside;
    // Not a number counts as a failure: both comparisons are false.
    lanes.State[i] = hasSettled ? settled : going;
  }
};

struct RefractKernel
{
  double Ratio;

  void operator()(PatchIntersectionBatch& lanes, int i) const
  {
    const glm::dvec3 direction = lanes.GetDirection(i);
    const double length = glm::length(direction);
    const glm::dvec3 sight = (1.0 / length) * direction;
    const glm::dvec3 normal =
      glm::normalize(glm::dvec3(lanes.Normal[0][i], lanes.Normal[1][i], lanes.Normal[2][i]));
    // From behind, light passes from the interior into the exterior.
    const double facing = glm::dot(sight, normal);
    const double sign = facing > 0.0 ? -1.0 : 1.0;
    const double inverse = 1.0 / this->Ratio;
    const double ratio = facing > 0.0 ? inverse : this->Ratio;
    const double perRatio = facing > 0.0 ? this->Ratio : inverse;
    const double cosine = sign * facing;
    const double radicand = RefractionRadicand(cosine, ratio);
    // Eq. 2.2: a unit vector but for rounding, and of no use to rays that are totally reflected.
    const double root = std::sqrt(std::fabs(radicand));
    const glm::dvec3 along = ratio * sight - (ratio * cosine + root) * (sign * normal);
    // A point that is drawn at a distance behind the sight point is that distance times n2 / n1
    // away along the refracted ray (Eq. 2.4).
    const glm::dvec3 step = length * perRatio * along;
    lanes.Normal[0][i] = step.x;
    lanes.Normal[1][i] = step.y;
    lanes.Normal[2][i] = step.z;
    lanes.Refracted[i] = radicand < 0.0 ? 0.0 : sign;
  }
};

}

//------------------------------------------------------------------------------
void PatchIntersectionBatch::Copy(int to, int from)
{
  this->Index[to] = this->Index[from];
  for (double* of : { this->Start[0], this->Start[1], this->Start[2], this->Direction[0],
         this->Direction[1], this->Direction[2], this->Depth, this->X, this->Y, this->Slant,
         this->PatchX, this->PatchY, this->Behind })
  {
    of[to] = of[from];
  }
}

//------------------------------------------------------------------------------
void SetNormals(const CurvedPatch& patch, InstructionSet set, PatchIntersectionBatch& lanes)
{
  RunLanes(NormalKernel{ patch }, set, lanes);
}

//------------------------------------------------------------------------------
PatchStart::PatchStart(
  const CurvedPatch& patch, const FacetPlane& plane, double size, double spread)
  : Size(size)
  , Up(plane.Normal / glm::length(plane.Normal))
  , ByX(size * plane.ByX)
  , ByY(size * plane.ByY)
{
  const auto formAlong = [&patch](const glm::dvec3& axis)
  {
    Form form;
    for (int k = 0; k < 3; ++k)
    {
      form.Corner[k] = static_cast<float>(glm::dot(patch.Normal[k], axis));
      form.Bend[k] = static_cast<float>(glm::dot(patch.Bend[k], axis));
    }
    return form;
  };
  this->AlongUp = formAlong(glm::normalize(plane.Normal));
  this->AlongX = formAlong(size * plane.ByX);
  this->AlongY = formAlong(size * plane.ByY);
  const glm::dvec3 sides[2] = { (patch.Corner[1] - patch.Corner[0]) / size,
    (patch.Corner[2] - patch.Corner[0]) / size };
  this->Sides[0] = static_cast<float>(glm::dot(sides[0], sides[0]));
  this->Sides[1] = static_cast<float>(glm::dot(sides[1], sides[1]));
  this->Sides[2] = static_cast<float>(2.0 * glm::dot(sides[0], sides[1]));
  for (int k = 0; k < 3; ++k)
  {
    this->Symmetric[k] = static_cast<float>(patch.Symmetric[k] / size);
    this->Asymmetric[k] = static_cast<float>(patch.Asymmetric[k] / size);
  }
  this->IsGentle = spread <= LargestGentleSpread;
}

//------------------------------------------------------------------------------
void StartNearPatch(const PatchStart& start, InstructionSet set, PatchIntersectionBatch& lanes)
{
  if (start.IsGentle)
  {
    RunLanes(GentleStartKernel{ start }, set, lanes);
  }
  else
  {
    RunLanes(StartKernel{ start }, set, lanes);
  }
}

//------------------------------------------------------------------------------
void StepToPatch(
  const CurvedPatch& patch, double scale, InstructionSet set, PatchIntersectionBatch& lanes)
{
  RunLanes(PatchKernel{ patch, scale }, set, lanes);
}

//------------------------------------------------------------------------------
void FindStates(
  const PatchSearchLimits& limits, double scale, InstructionSet set, PatchIntersectionBatch& lanes)
{
  RunLanes(SearchKernel{ limits, scale }, set, lanes);
}

//------------------------------------------------------------------------------
void Refract(double ratio, InstructionSet set, PatchIntersectionBatch& lanes)
{
  RunLanes(RefractKernel{ ratio }, set, lanes);
}

}
