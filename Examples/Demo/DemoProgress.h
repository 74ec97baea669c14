// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

class vtkAlgorithm;

/** Draws the bar's state, `progress` from 0 to 1. */
void ShowProgress(const std::string& what, double progress);

/** Updates an algorithm under a progress bar on standard error and prints its duration. */
void UpdateWithProgress(vtkAlgorithm* algorithm, const std::string& what);
