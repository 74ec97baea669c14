// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SchematicEye.h"
#include "MathBasics.h"

namespace meniscus::test
{
namespace
{

// Depth of the conic below its vertex, r^2 + (1 + Q) s^2 = 2 R s, and the upward unit normal.
double GetSag(const CorneaSurface& surface, double r)
{
  const double c = r / surface.Radius;
  return r * c / (1.0 + std::sqrt(1.0 - (1.0 + surface.Asphericity) * c * c));
}

glm::dvec3 GetNormal(const CorneaSurface& surface, const glm::dvec3& p)
{
  const double sag = -surface.Vertex - p.y;
  return glm::normalize(glm::dvec3(p.x, surface.Radius - (1.0 + surface.Asphericity) * sag, p.z));
}

}

//------------------------------------------------------------------------------
reference::MembraneMesh MakeCornea(const CorneaSurface& surface, int cells)
{
  reference::MembraneMesh mesh;
  for (const auto& [j, i] : Product(cells + 1, cells + 1))
  {
    // Squares around the axis become circles.
    const double x = 2.0 * i / cells - 1.0;
    const double z = 2.0 * j / cells - 1.0;
    const double r = CorneaRadius * std::max(std::fabs(x), std::fabs(z));
    const double part = r > 0.0 ? r / std::hypot(x, z) : 0.0;
    const glm::dvec3 p(part * x, -surface.Vertex - GetSag(surface, r), part * z);
    mesh.AddPoint(p, GetNormal(surface, p));
  }
  for (const auto& [j, i] : Product(cells, cells))
  {
    const std::int64_t a = static_cast<std::int64_t>(j) * (cells + 1) + i;
    const std::int64_t b = a + cells + 1;
    mesh.AddTriangle(a, b, a + 1);
    mesh.AddTriangle(a + 1, b, b + 1);
  }
  return mesh;
}

//------------------------------------------------------------------------------
reference::ExactSurface MakeExactCornea(const CorneaSurface& surface, double before)
{
  // x^2 + z^2 + (1 + Q) (y - centre)^2 = R^2 / (1 + Q), which has the radius of curvature R at its
  // vertex, R / (1 + Q) above its centre.
  const double stretch = 1.0 + surface.Asphericity;
  const glm::dvec3 centre(0.0, -surface.Vertex - surface.Radius / stretch, 0.0);
  return { before, surface.Behind, centre, surface.Radius / std::sqrt(stretch), glm::dvec3(0.0),
    false, stretch };
}

}
