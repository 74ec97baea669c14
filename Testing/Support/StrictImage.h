// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "VolumeScene.h"

namespace meniscus::test
{

/**
 * Difference of two 8-bit images in grey levels, each pixel compared with the same pixel: without
 * shifts, averaging or allowance (VTK's own comparison accepts an offset of 50 levels of a whole
 * image). Images of different sizes differ completely.
 */
struct StrictDifference
{
  bool SameSize = false;
  int Largest = 0;
  std::size_t PixelsBeyond = 0; // pixels with a difference above the threshold
  ByteImage Image;              // absolute differences, times 32 to be seen
};

StrictDifference CompareStrictly(const ByteImage& a, const ByteImage& b, int threshold);

ByteImage ReadPng(const std::string& path);
void WritePng(const ByteImage& image, const std::string& path);

/**
 * Result of a comparison with a baseline (Testing/Data/Baseline/NAME.png) or, if that differs, with
 * its alternates (NAME_1.png, NAME_2.png, ...), as VTK's tests have them. On a failure, or without
 * a baseline, NAME.png and NAME-difference.png are written to the build tree's Testing/Temporary,
 * and the message says so.
 */
struct BaselineResult
{
  bool Passed = false;
  std::string Message;
};

/** @param folder  folder of the baselines; empty: Testing/Data/Baseline. */
BaselineResult CompareToBaseline(const ByteImage& image, const std::string& name, int threshold,
  const std::string& folder = std::string());

} // namespace meniscus::test
