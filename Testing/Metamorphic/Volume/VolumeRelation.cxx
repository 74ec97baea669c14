// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeRelation.h"

#include <vtkTetrahedraRayCastMapper.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meniscus
{
namespace test
{

namespace
{

std::string backendName(int backend)
{
  switch (backend)
  {
    case vtkTetrahedraRayCastMapper::NATIVE:
      return "native";
    case vtkTetrahedraRayCastMapper::COMPUTE:
      return "compute";
    default:
      return "opengl";
  }
}

double difference(const float* a, const float* b)
{
  double largest = 0.0;
  for (int c = 0; c < 4; ++c)
  {
    const double d = std::fabs(double(a[c]) - double(b[c]));
    largest = d <= largest ? largest : d; // passes NaN on
  }
  return largest;
}

// The worst of the wrong pixels of one comparison, as text.
struct WorstPixel
{
  int Count = 0;
  double Deviation = 0.0;
  double Tolerance = 0.0;
  int X = 0;
  int Y = 0;
  std::string Text;

  void take(int x, int y, double deviation, double tolerance, const float* a, const float* b)
  {
    if (++this->Count > 1 && deviation <= this->Deviation)
    {
      return;
    }
    this->Deviation = deviation;
    this->Tolerance = tolerance;
    this->X = x;
    this->Y = y;
    std::ostringstream text;
    text << "pixel (" << x << ", " << y << ") is";
    for (int c = 0; c < 4; ++c)
    {
      text << ' ' << b[c];
    }
    text << " and was";
    for (int c = 0; c < 4; ++c)
    {
      text << ' ' << a[c];
    }
    this->Text = text.str();
  }
};

} // anonymous namespace

//------------------------------------------------------------------------------
VolumeTrial::VolumeTrial(const VolumeCase& test, RandomNumbers random, VolumeStage& stage)
  : Scene(test)
  , Random(random)
  , Stage(stage)
  , Condition(this->Scene)
{
  this->Tally.Scenes = 1;
}

//------------------------------------------------------------------------------
const FloatImage& VolumeTrial::picture()
{
  if (this->Picture.Width == 0)
  {
    this->Picture = this->Stage.draw(this->Scene);
  }
  return this->Picture;
}

//------------------------------------------------------------------------------
void VolumeTrial::expectSame(const VolumeCase& changed, const std::string& words)
{
  this->picture();
  this->expectSame(this->Stage.draw(changed), words);
}

//------------------------------------------------------------------------------
void VolumeTrial::expectSame(const FloatImage& changed, const std::string& words)
{
  this->expectSame(
    changed,
    [](int x, int y) {
      return std::array<int, 2>{ x, y };
    },
    plainTolerance(this->Scene.Backend), words);
}

//------------------------------------------------------------------------------
void VolumeTrial::expectSame(
  const FloatImage& changed, const PixelMap& map, double tolerance, const std::string& words)
{
  const FloatImage before = this->picture();
  ++this->Tally.Comparisons;
  const std::string complaint = this->Stage.complaints();
  if (!complaint.empty())
  {
    this->fail(words + ": " + complaint);
  }
  WorstPixel worst;
  for (int y = 0; y < before.Height; ++y)
  {
    for (int x = 0; x < before.Width; ++x)
    {
      const std::array<int, 2> at = map(x, y);
      const float* a = before.pixel(x, y);
      const float* b = changed.pixel(at[0], at[1]);
      const double d = difference(a, b);
      const double allowed = d <= tolerance ? tolerance : tolerance + this->Condition.spread(x, y);
      if (d > tolerance && d <= allowed)
      {
        ++this->Tally.Values;
        ++this->Tally.Conditioned;
      }
      else if (!this->Tally.compare(d, allowed))
      {
        worst.take(x, y, d, allowed, a, b);
      }
    }
  }
  if (worst.Count > 0)
  {
    std::ostringstream text;
    text << words << ": " << worst.Count << " pixels, largest " << worst.Deviation << " of "
         << worst.Tolerance << ", " << worst.Text << ", exactly";
    for (const double value : this->Condition.exact(worst.X, worst.Y))
    {
      text << ' ' << value;
    }
    this->fail(text.str());
  }
}

//------------------------------------------------------------------------------
void VolumeTrial::fail(const std::string& words)
{
  this->Tally.Failures = 1;
  if (this->Tally.FirstFailure.empty())
  {
    this->Tally.FirstFailure =
      this->Scene.Name + ", " + backendName(this->Scene.Backend) + ", " + words;
  }
}

//------------------------------------------------------------------------------
RelationTally VolumeTrial::done()
{
  if (this->Tally.Comparisons == 0)
  {
    this->fail("nothing compared");
  }
  return this->Tally;
}

//------------------------------------------------------------------------------
VolumeRelation relationOf(const std::string& name, int cases, const CaseNeeds& needs,
  const std::function<void(VolumeCase&, RandomNumbers&)>& change)
{
  return { name, cases, needs,
    [=](VolumeTrial& trial)
    {
      VolumeCase changed = trial.scene();
      change(changed, trial.random());
      trial.expectSame(changed, name);
    },
    nullptr };
}

} // namespace test
} // namespace meniscus
