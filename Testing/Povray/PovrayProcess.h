// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef meniscus_PovrayProcess_h
#define meniscus_PovrayProcess_h

#include "ComparisonScene.h"
#include "VolumeScene.h"

#include <string>

namespace meniscus
{
namespace test
{

/**
 * Writes FOLDER/NAME.pov and FOLDER/NAME.ini, runs POV-Ray there and reads FOLDER/NAME-povray.png.
 * POV-Ray's messages go to FOLDER/NAME.log; a picture without pixels says that it failed. To draw
 * the picture again by hand: `cd FOLDER; povray NAME.ini`.
 */
ByteImage drawByPovray(
  const ComparisonScene& scene, int pixels, const std::string& program, const std::string& folder);

} // namespace test
} // namespace meniscus

#endif
