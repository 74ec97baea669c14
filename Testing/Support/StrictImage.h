// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_StrictImage_h
#define meniscus_StrictImage_h

#include "VolumeScene.h"

#include <cstddef>
#include <string>

namespace meniscus
{
namespace test
{

/**
 * Difference of two 8-bit images, in grey levels, pixel against the same pixel: no shift, no
 * averaging, no allowance (VTK's own comparison lets a whole image be 50 levels off).
 */
struct StrictDifference
{
  bool SameSize = false;
  int Largest = 0;
  std::size_t PixelsBeyond = 0; // pixels off by more than the threshold
  ByteImage Image;              // absolute differences, times 32 to be seen
};

StrictDifference compareStrictly(const ByteImage& a, const ByteImage& b, int threshold);

ByteImage readPng(const std::string& path);
void writePng(const ByteImage& image, const std::string& path);

/**
 * Compares with the baseline of that name (Testing/Data/Baseline/NAME.png). On a failure or without
 * a baseline, writes NAME.png and NAME-difference.png into the build tree's Testing/Temporary and
 * says so in the message.
 */
struct BaselineResult
{
  bool Passed = false;
  std::string Message;
};

BaselineResult compareToBaseline(const ByteImage& image, const std::string& name, int threshold);

} // namespace test
} // namespace meniscus

#endif
