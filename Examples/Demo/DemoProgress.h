// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DemoProgress_h
#define DemoProgress_h

#include <string>

class vtkAlgorithm;

/** Updates an algorithm under a progress bar on standard error and prints how long it took. */
void UpdateWithProgress(vtkAlgorithm* algorithm, const std::string& what);

#endif
