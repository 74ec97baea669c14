// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Optics/VisibleScalars.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Largest error at the end of a ramp down to zero, as a fraction of the value at its start: width,
 * slope, their product and the sum are each rounded to 2^-24.
 */
constexpr float EndRounding = 1.0f / 4194304.0f;

}

//------------------------------------------------------------------------------
bool VisibleScalars::Span::operator==(const Span& other) const
{
  return this->Lower == other.Lower && this->Upper == other.Upper &&
    this->LowerCounts == other.LowerCounts && this->UpperCounts == other.UpperCounts &&
    this->Touching == other.Touching;
}

//------------------------------------------------------------------------------
bool VisibleScalars::Span::Meets(float lowest, float highest) const
{
  if (lowest < this->Upper && highest > this->Lower)
  {
    return true;
  }
  if (this->Touching)
  {
    return lowest <= this->Upper && highest >= this->Lower;
  }
  return lowest == highest &&
    ((lowest == this->Lower && this->LowerCounts) || (lowest == this->Upper && this->UpperCounts));
}

//------------------------------------------------------------------------------
bool VisibleScalars::Span::Holds(const Span& other) const
{
  return other.Lower > this->Lower && other.Upper < this->Upper;
}

//------------------------------------------------------------------------------
VisibleScalars VisibleScalars::All()
{
  const float infinity = std::numeric_limits<float>::infinity();
  VisibleScalars all;
  all.Add({ -infinity, infinity, false, false, false });
  return all;
}

//------------------------------------------------------------------------------
void VisibleScalars::AddAttenuation(const std::vector<TransferFunctionInterval>& intervals)
{
  std::vector<Span> spans;
  for (const TransferFunctionInterval& interval : intervals)
  {
    const float start = interval.Attenuation;
    const float end = start + (interval.Upper - interval.Lower) * interval.AttenuationSlope;
    const Span span{ interval.Lower, interval.Upper, start > 0.0f, end > EndRounding * start,
      false };
    if (!span.LowerCounts && !span.UpperCounts)
    {
      continue;
    }
    // Intervals follow each other without gaps; where either side includes its end, the common end
    // is visible.
    if (!spans.empty() && spans.back().Upper == span.Lower &&
      (spans.back().UpperCounts || span.LowerCounts))
    {
      spans.back().Upper = span.Upper;
      spans.back().UpperCounts = span.UpperCounts;
    }
    else
    {
      spans.push_back(span);
    }
  }
  for (const Span& span : spans)
  {
    this->Add(span);
  }
}

//------------------------------------------------------------------------------
void VisibleScalars::AddIsovalue(float value)
{
  this->Add({ value, value, true, true, true });
}

//------------------------------------------------------------------------------
void VisibleScalars::Add(const Span& span)
{
  const auto holdsNew = [&span](const Span& s) { return s.Holds(span); };
  if (std::any_of(this->Spans.begin(), this->Spans.end(), holdsNew))
  {
    return;
  }
  const auto heldByNew = [&span](const Span& s) { return span.Holds(s); };
  this->Spans.erase(
    std::remove_if(this->Spans.begin(), this->Spans.end(), heldByNew), this->Spans.end());
  const auto before = [](const Span& a, const Span& b)
  { return a.Lower != b.Lower ? a.Lower < b.Lower : a.Upper < b.Upper; };
  this->Spans.insert(std::upper_bound(this->Spans.begin(), this->Spans.end(), span, before), span);
}

//------------------------------------------------------------------------------
std::vector<float> VisibleScalars::ListEnds() const
{
  std::vector<float> ends;
  for (const Span& span : this->Spans)
  {
    for (const float end : { span.Lower, span.Upper })
    {
      if (!std::isnan(end))
      {
        ends.push_back(end);
      }
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

//------------------------------------------------------------------------------
bool VisibleScalars::Meets(float lowest, float highest) const
{
  const auto endsBelow = [](const Span& span, float value) { return span.Upper < value; };
  auto span = std::lower_bound(this->Spans.begin(), this->Spans.end(), lowest, endsBelow);
  for (; span != this->Spans.end() && span->Lower <= highest; ++span)
  {
    if (span->Meets(lowest, highest))
    {
      return true;
    }
  }
  return false;
}

}
