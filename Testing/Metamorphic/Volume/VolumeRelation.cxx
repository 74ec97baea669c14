// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeRelation.h"

#include <vtkTetrahedraRayCastMapper.h>

namespace meniscus::test
{

namespace
{

std::string BackendName(int backend)
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

double Difference(const float* a, const float* b)
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

  void Take(int x, int y, double deviation, double tolerance, const float* a, const float* b)
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
const FloatImage& VolumeTrial::MakePicture()
{
  if (this->Picture.Width == 0)
  {
    this->Picture = this->Stage.Draw(this->Scene);
  }
  return this->Picture;
}

//------------------------------------------------------------------------------
void VolumeTrial::ExpectSame(const VolumeCase& changed, const std::string& words)
{
  this->MakePicture();
  this->ExpectSame(this->Stage.Draw(changed), words);
}

//------------------------------------------------------------------------------
void VolumeTrial::ExpectSame(const FloatImage& changed, const std::string& words)
{
  this->ExpectSame(changed, PlainTolerance(this->Scene.Backend), words);
}

//------------------------------------------------------------------------------
void VolumeTrial::ExpectSame(const FloatImage& changed, double tolerance, const std::string& words)
{
  this->ExpectSame(
    changed,
    [](int x, int y) {
      return std::array<int, 2>{ x, y };
    },
    tolerance, words);
}

//------------------------------------------------------------------------------
void VolumeTrial::ExpectSame(
  const FloatImage& changed, const PixelMap& map, double tolerance, const std::string& words)
{
  const FloatImage before = this->MakePicture();
  ++this->Tally.Comparisons;
  const std::string complaint = this->Stage.Complaints();
  if (!complaint.empty())
  {
    this->Fail(words + ": " + complaint);
  }
  std::vector<Conditioning::PixelRange> sensitive;
  for (const auto& [y, x] : Product(before.Height, before.Width))
  {
    const std::array<int, 2> at = map(x, y);
    const double d = Difference(before.GetPixel(x, y), changed.GetPixel(at[0], at[1]));
    if (d <= tolerance)
    {
      this->Tally.Compare(d, tolerance);
      continue;
    }
    sensitive.push_back(this->Condition.FindRange(x, y, d - tolerance));
  }
  this->Condition.Extend(sensitive);
  WorstPixel worst;
  for (const Conditioning::PixelRange& pixel : sensitive)
  {
    const std::array<int, 2> at = map(pixel.X, pixel.Y);
    const float* a = before.GetPixel(pixel.X, pixel.Y);
    const float* b = changed.GetPixel(at[0], at[1]);
    const double d = Difference(a, b);
    const double allowed = tolerance + pixel.GetSpread();
    if (d <= allowed)
    {
      ++this->Tally.Values;
      ++this->Tally.Conditioned;
    }
    else
    {
      this->Tally.Compare(d, allowed);
      worst.Take(pixel.X, pixel.Y, d, allowed, a, b);
    }
  }
  if (worst.Count > 0)
  {
    std::ostringstream text;
    text << words << ": " << worst.Count << " pixels, largest " << worst.Deviation << " of "
         << worst.Tolerance << ", " << worst.Text << ", exactly";
    for (const double value : this->Condition.GetExact(worst.X, worst.Y))
    {
      text << ' ' << value;
    }
    this->Fail(text.str());
  }
}

//------------------------------------------------------------------------------
void VolumeTrial::Fail(const std::string& words)
{
  this->Tally.Failures = 1;
  if (this->Tally.FirstFailure.empty())
  {
    this->Tally.FirstFailure =
      this->Scene.Name + ", " + BackendName(this->Scene.Backend) + ", " + words;
  }
}

//------------------------------------------------------------------------------
RelationTally VolumeTrial::Done()
{
  if (this->Tally.Comparisons == 0)
  {
    this->Fail("nothing compared");
  }
  return this->Tally;
}

//------------------------------------------------------------------------------
VolumeRelation RelationOf(const std::string& name, int cases, const CaseNeeds& needs,
  const std::function<void(VolumeCase&, RandomNumbers&)>& change)
{
  return { name, cases, needs,
    [=](VolumeTrial& trial)
    {
      VolumeCase changed = trial.MakeScene();
      change(changed, trial.MakeRandom());
      trial.ExpectSame(changed, name);
    },
    nullptr };
}

} // namespace meniscus::test
