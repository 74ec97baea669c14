// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Twin: Module/Volume/Packet/Models/PacketIntervals.h (intervals of a function)
//
// The transfer function: a table of intervals in which attenuation and colour are linear.

uniform int numberOfIntervals;

// The current interval.
int interval;
vec4 intervalRange;  // lower, upper, attenuation, slope
vec3 intervalColor;
vec3 intervalColorSlope;

void loadInterval()
{
  intervalRange = texelFetch(intervals, 3 * interval);
  intervalColor = texelFetch(intervals, 3 * interval + 1).rgb;
  intervalColorSlope = texelFetch(intervals, 3 * interval + 2).rgb;
}

void findInterval(float s)
{
  int low = 0;
  int high = numberOfIntervals - 1;
  while (low < high)
  {
    int middle = (low + high) / 2;
    bool above = texelFetch(intervals, 3 * middle).y < s;
    low = above ? middle + 1 : low;
    high = above ? high : middle;
  }
  interval = low;
  loadInterval();
}

// Colour and attenuation at a scalar.
vec4 lookUp(float s)
{
  findInterval(s);
  float offset = s - intervalRange.x;
  return vec4(
    intervalColor + offset * intervalColorSlope, intervalRange.z + offset * intervalRange.w);
}

// Next piece of the pending segment within one interval: the scalar and the fraction of the segment
// at its end, and the interval after it. Returns true if it ends the segment.
bool findPiece(out float to, out float reached, out int next)
{
  // A segment that begins outside of the interval first moves the interval, by an empty piece.
  bool inside = segmentScalar >= intervalRange.x && segmentScalar <= intervalRange.y;
  float target = inside ? segmentEnd : segmentScalar;
  bool upward = target > intervalRange.y;
  bool downward = target < intervalRange.x;
  bool last = inside && !upward && !downward;
  to = upward ? intervalRange.y : (downward ? intervalRange.x : segmentEnd);
  reached =
    last ? 1.0 : clamp((to - segmentStart) / (segmentEnd - segmentStart), segmentDone, 1.0);
  reached = inside ? reached : segmentDone;
  to = inside ? to : segmentScalar;
  next = interval + (upward ? 1 : -1);
  return last;
}
