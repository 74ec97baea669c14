// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SightOracle.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace meniscus::reference
{
namespace
{

// Number of boxes after which a point is given up: some ten times the number for a difficult point.
constexpr int MostBoxes = 200000;

// Fraction of the side below which boxes are not divided.
constexpr double SmallestPart = 1e-12;

template <typename T>
using Triple = std::array<T, 3>;

template <typename T>
T Dot(const Triple<T>& a, const Triple<T>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename T>
T Length(const Triple<T>& a)
{
  return Root(Square(a[0]) + Square(a[1]) + Square(a[2]));
}

double GetMagnitude(double a)
{
  return std::fabs(a);
}

double GetMagnitude(const Interval& a)
{
  return a.GetMagnitude();
}

Triple<double> Direction(const Triple<double>& a, double length)
{
  return length > 0.0 ? Triple<double>{ a[0] / length, a[1] / length, a[2] / length }
                      : Triple<double>{ 0.0, 0.0, 0.0 };
}

Triple<Interval> Direction(const Triple<Interval>& a, const Interval& length)
{
  const Interval any(-1.0, 1.0);
  if (!(length.Low > 0.0))
  {
    return { any, any, any };
  }
  Triple<Interval> result = { a[0] / length, a[1] / length, a[2] / length };
  for (Interval& c : result)
  {
    c = { std::max(c.Low, -1.0), std::min(c.High, 1.0) };
  }
  return result;
}

/** F, its derivatives, and bounds of the effect of the surface's error on it. */
template <typename T>
struct Equation
{
  T F[2];
  T By[2][2]; ///< By[i][k]: derivative of F_i by x (0) or z (1)
  T Away;     ///< |a|
  T Below;    ///< |p|
  double PerPosition;
  double PerNormal;
};

template <typename T>
Equation<T> Evaluate(const HeightJet<T>& jet, const T& x, const T& z, const glm::dvec3& eye,
  const glm::dvec3& point, double exterior, double interior)
{
  const Triple<T> a = { x - T(eye.x), jet.F - T(eye.y), z - T(eye.z) };
  const Triple<T> p = { T(point.x) - x, T(point.y) - jet.F, T(point.z) - z };
  const Triple<T> t[2] = { { T(1.0), jet.X, T(0.0) }, { T(0.0), jet.Z, T(1.0) } };
  Equation<T> e;
  e.Away = Length(a);
  e.Below = Length(p);
  const Triple<T> da = Direction(a, e.Away);
  const Triple<T> dp = Direction(p, e.Below);
  Triple<T> h;
  for (std::size_t c = 0; c < 3; ++c)
  {
    h[c] = exterior * (e.Below * a[c]) - interior * (e.Away * p[c]);
  }
  const T second[2][2] = { { jet.Xx, jet.Xz }, { jet.Xz, jet.Zz } };
  const T lengths = exterior * e.Below + interior * e.Away;
  for (std::size_t i = 0; i < 2; ++i)
  {
    e.F[i] = Dot(h, t[i]);
    for (std::size_t k = 0; k < 2; ++k)
    {
      // dh = (n1 |p| + n2 |a|) dS - n1 a (dp.dS) - n2 p (da.dS)
      e.By[i][k] = lengths * Dot(t[k], t[i]) - exterior * (Dot(a, t[i]) * Dot(dp, t[k])) -
        interior * (Dot(p, t[i]) * Dot(da, t[k])) + h[1] * second[i][k];
    }
  }
  const double tangent = std::max(GetMagnitude(Length(t[0])), GetMagnitude(Length(t[1])));
  e.PerPosition =
    2.0 * tangent * (exterior + interior) * (GetMagnitude(e.Away) + GetMagnitude(e.Below));
  e.PerNormal = tangent * GetMagnitude(Length(h));
  return e;
}

}

//------------------------------------------------------------------------------
bool OracleAnswer::IsUncertain(double x, double z, double slack) const
{
  for (const OracleBox& box : this->Uncertain)
  {
    if (std::fabs(x - box.X) <= box.Half + slack && std::fabs(z - box.Z) <= box.Half + slack)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
class SightOracle::Search
{
public:
  Search(const SightOracle& oracle, const glm::dvec3& point)
    : Oracle(oracle)
    , Point(point)
  {
  }

  OracleAnswer Run()
  {
    const double side = this->Oracle.Surface.Side;
    // A little beyond the border, to which the mesh's own border may extend.
    const double half = 0.5 * side * (1.0 + 1e-3) + 4.0 * this->Oracle.Error.Position;
    std::vector<OracleBox> stack = { { 0.0, 0.0, half } };
    for (int boxes = 0; !stack.empty(); ++boxes)
    {
      if (boxes >= MostBoxes)
      {
        this->Answer.Complete = false;
        break;
      }
      const OracleBox box = stack.back();
      stack.pop_back();
      if (this->IsSettled(box))
      {
        continue;
      }
      const double quarter = 0.5 * box.Half;
      for (int child = 0; child < 4; ++child)
      {
        stack.push_back({ box.X + (child & 1 ? quarter : -quarter),
          box.Z + (child & 2 ? quarter : -quarter), quarter });
      }
    }
    this->Sort();
    return this->Answer;
  }

private:
  using Jacobian = double[2][2];

  double GetSlack(double perPosition, double perNormal) const
  {
    return perPosition * this->Oracle.Error.Position + perNormal * this->Oracle.Error.Normal;
  }

  template <typename T>
  Equation<T> EvaluateAt(const HeightJet<T>& jet, const T& x, const T& z) const
  {
    return Evaluate(
      jet, x, z, this->Oracle.Eye, this->Point, this->Oracle.Exterior, this->Oracle.Interior);
  }

  Equation<double> EvaluateAt(double x, double z) const
  {
    return this->EvaluateAt(this->Oracle.Surface.At(x, z), x, z);
  }

  // Returns false if the box must be divided.
  bool IsSettled(const OracleBox& box)
  {
    const Interval x(box.X - box.Half, box.X + box.Half);
    const Interval z(box.Z - box.Half, box.Z + box.Half);
    const Equation<Interval> over = this->EvaluateAt(this->Oracle.Surface.Over(x, z), x, z);
    const Equation<double> middle = this->EvaluateAt(box.X, box.Z);
    const double slack = this->GetSlack(over.PerPosition, over.PerNormal);
    double widest = 0.0;
    for (int i = 0; i < 2; ++i)
    {
      const double reach = box.Half * (over.By[i][0].GetMagnitude() + over.By[i][1].GetMagnitude());
      widest = std::max(widest, reach);
      if (std::fabs(middle.F[i]) > reach + slack || over.F[i].GetMignitude() > slack)
      {
        return true;
      }
    }
    double inverse[2][2];
    const bool regular = Invert(middle, inverse);
    if (regular)
    {
      // Test whether Y J is within `off` of the identity over the box.
      double off[2] = { 0.0, 0.0 };
      double step[2];
      double radius[2];
      for (int i = 0; i < 2; ++i)
      {
        step[i] = -(inverse[i][0] * middle.F[0] + inverse[i][1] * middle.F[1]);
        radius[i] = (std::fabs(inverse[i][0]) + std::fabs(inverse[i][1])) * slack;
        for (int k = 0; k < 2; ++k)
        {
          const Interval entry = inverse[i][0] * over.By[0][k] + inverse[i][1] * over.By[1][k];
          off[i] += (entry - Interval(i == k ? 1.0 : 0.0)).GetMagnitude();
        }
      }
      for (int i = 0; i < 2; ++i)
      {
        // Krawczyk's test: roots are within off * half of the Newton step.
        if (std::fabs(step[i]) > box.Half * (1.0 + off[i]) + radius[i])
        {
          return true;
        }
      }
      if (std::max(off[0], off[1]) < 0.5)
      {
        if (this->TakeRoot(box))
        {
          return true;
        }
        if (std::max(radius[0], radius[1]) > box.Half)
        {
          // The root lies outside the region in which the derivative is known, but within the
          // error.
          this->Answer.Uncertain.push_back(box);
          return true;
        }
      }
    }
    // The values in the box cannot be distinguished from zero within the error, and the derivative
    // is not known well enough: smaller boxes would only trace the border of the uncertain region.
    if (box.Half < SmallestPart * this->Oracle.Surface.Side || widest <= 3.0 * slack)
    {
      this->Answer.Uncertain.push_back(box);
      return true;
    }
    return false;
  }

  static bool Invert(const Equation<double>& e, double (&inverse)[2][2])
  {
    const double determinant = e.By[0][0] * e.By[1][1] - e.By[0][1] * e.By[1][0];
    inverse[0][0] = e.By[1][1] / determinant;
    inverse[0][1] = -e.By[0][1] / determinant;
    inverse[1][0] = -e.By[1][0] / determinant;
    inverse[1][1] = e.By[0][0] / determinant;
    return std::isfinite(inverse[0][0] + inverse[0][1] + inverse[1][0] + inverse[1][1]);
  }

  // Newton's method from the middle of a box with at most one root. Returns false if it leaves the
  // box by more than the error explains.
  bool TakeRoot(const OracleBox& box)
  {
    double x = box.X;
    double z = box.Z;
    double inverse[2][2];
    Equation<double> e = this->EvaluateAt(x, z);
    for (int i = 0; i < 30; ++i)
    {
      if (!Invert(e, inverse))
      {
        return false;
      }
      const double dx = -(inverse[0][0] * e.F[0] + inverse[0][1] * e.F[1]);
      const double dz = -(inverse[1][0] * e.F[0] + inverse[1][1] * e.F[1]);
      x += dx;
      z += dz;
      e = this->EvaluateAt(x, z);
      if (std::max(std::fabs(x - box.X), std::fabs(z - box.Z)) > 4.0 * box.Half)
      {
        return false;
      }
      if (std::max(std::fabs(dx), std::fabs(dz)) < 1e-14 * this->Oracle.Surface.Side)
      {
        break;
      }
    }
    if (!Invert(e, inverse))
    {
      return false;
    }
    const double slack = this->GetSlack(e.PerPosition, e.PerNormal);
    const double radius = 1.5 * slack *
      std::max(std::fabs(inverse[0][0]) + std::fabs(inverse[0][1]),
        std::fabs(inverse[1][0]) + std::fabs(inverse[1][1]));
    const double outside = std::max(std::fabs(x - box.X), std::fabs(z - box.Z)) - box.Half;
    if (outside > 1e-9 * box.Half + 2.0 * radius)
    {
      return false;
    }
    this->AddRoot(x, z, radius, e);
    return true;
  }

  void AddRoot(double x, double z, double radius, const Equation<double>& e)
  {
    const SmoothSurface& surface = this->Oracle.Surface;
    const glm::dvec3 sight = surface.GetPoint(x, z);
    const double same = 1e-11 * surface.Side + 1e-3 * radius;
    for (const OracleImage& other : this->Roots)
    {
      if (glm::length(other.Sight - sight) < same)
      {
        return;
      }
    }
    const double determinant = e.By[0][0] * e.By[1][1] - e.By[0][1] * e.By[1][0];
    this->Roots.push_back({ sight, radius, determinant < 0.0 ? -1 : 1 });
  }

  // +1: an image on every surface within the error; -1: on none.
  int Classify(const OracleImage& root) const
  {
    const SmoothSurface& surface = this->Oracle.Surface;
    const SurfaceError& error = this->Oracle.Error;
    const HeightJet<double> jet = surface.At(root.Sight.x, root.Sight.z);
    const double bend = std::fabs(jet.Xx) + std::fabs(jet.Xz) + std::fabs(jet.Zz);
    const double turn = error.Normal + 2.0 * bend * root.Radius;
    const double band = 2.0 * root.Radius + 4.0 * error.Position + 1e-9 * surface.Side;
    const glm::dvec3 normal = surface.GetNormal(root.Sight.x, root.Sight.z);
    const double beyond =
      std::max(std::fabs(root.Sight.x), std::fabs(root.Sight.z)) - 0.5 * surface.Side;
    int result = beyond < -band ? 1 : (beyond > band ? -1 : 0);
    for (const glm::dvec3& way : { root.Sight - this->Oracle.Eye, this->Point - root.Sight })
    {
      const double along = glm::dot(way, normal);
      const double margin = 2.0 * (root.Radius + error.Position) + glm::length(way) * turn;
      const int side = along < -margin ? 1 : (along > margin ? -1 : 0);
      result = std::min(result, side);
    }
    return result;
  }

  // Roots that cannot be distinguished from others or from an uncertain box become uncertain
  // themselves.
  void Sort()
  {
    std::vector<bool> doubtful(this->Roots.size(), false);
    for (std::size_t i = 0; i < this->Roots.size(); ++i)
    {
      const OracleImage& root = this->Roots[i];
      doubtful[i] = this->Answer.IsUncertain(root.Sight.x, root.Sight.z, 2.0 * root.Radius);
      for (std::size_t j = 0; j < this->Roots.size(); ++j)
      {
        const OracleImage& other = this->Roots[j];
        doubtful[i] = doubtful[i] ||
          (i != j && glm::length(root.Sight - other.Sight) < 2.0 * (root.Radius + other.Radius));
      }
    }
    for (std::size_t i = 0; i < this->Roots.size(); ++i)
    {
      const OracleImage& root = this->Roots[i];
      const int kind = this->Classify(root);
      if (kind == 1 && !doubtful[i])
      {
        this->Answer.Images.push_back(root);
      }
      else if (kind >= 0)
      {
        this->Answer.Uncertain.push_back(
          { root.Sight.x, root.Sight.z, 4.0 * root.Radius + 4.0 * this->Oracle.Error.Position });
      }
    }
  }

  const SightOracle& Oracle;
  glm::dvec3 Point;
  OracleAnswer Answer;
  std::vector<OracleImage> Roots;
};

//------------------------------------------------------------------------------
OracleAnswer SightOracle::Find(const glm::dvec3& point) const
{
  return Search(*this, point).Run();
}

}
