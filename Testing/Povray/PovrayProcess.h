// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PovrayWriter.h"
#include "VolumeScene.h"

namespace meniscus::test
{

/** How POV-Ray is started, and where. */
struct PovrayProcess
{
  std::string Program = "povray";
  std::string Folder;

  /**
   * Writes NAME.pov and NAME.ini into the folder, runs POV-Ray there and reads NAME-povray.png. Its
   * messages go to NAME.log; a picture without pixels says that it failed. To draw the picture
   * again by hand: `cd FOLDER; povray NAME.ini`.
   */
  ByteImage Draw(const ComparisonScene& scene, const std::string& name, int pixels,
    const PictureWindow& window = {}) const;
};

} // namespace meniscus::test
