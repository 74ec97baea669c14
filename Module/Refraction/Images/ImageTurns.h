// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meniscus
{

/**
 * True if the image of a straight line may leave its chord by more than the tolerance although its
 * middle is on the chord: it may be S-shaped. Both parameters are angles at the eye in radians.
 *
 * Such a curve f of the sight direction differs from its chord by at most |f'''| angle^3 / 125. The
 * third derivative is taken to be 100 per square radian: refraction that changes within a tenth of
 * a radian. Of shorter sides, which are most sides of a mesh, only the middle is tested.
 */
constexpr bool MayTurnTwice(double angle, double tolerance)
{
  return 0.8 * angle * angle * angle > tolerance;
}

}
