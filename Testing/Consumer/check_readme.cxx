// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Looks through virtual.vtp, which the README's C++ example has written: rays from the eye to its
// points are refracted by the plane of water, and must end on the ball. Snell's law as n sin a = m
// sin b, written anew.
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

int main()
{
  constexpr double eye[3] = { 0.0, -2.0, 1.5 };
  constexpr double index = 1.333;
  constexpr double depth = 0.6; // of the ball's centre; its radius is 0.5
  // Coordinates are floats below 2, each rounded by at most 2^-24 of 2, and paths grow with
  // `index`.
  constexpr double largest = 0.5 + 1e-6;
  // Facets of 8 x 8: 0.5 cos(pi / 8) cos(pi / 14) in their middles.
  constexpr double smallest = 0.45;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName("virtual.vtp");
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  int wrong = 0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double* p = data->GetPoint(i);
    const double ray[3] = { p[0] - eye[0], p[1] - eye[1], p[2] - eye[2] };
    const double length = std::hypot(ray[0], ray[1], ray[2]);
    const double reach = -eye[2] / ray[2]; // to the water, as a part of the ray
    const double across = std::hypot(ray[0], ray[1]);
    const double sine = across / length / index;
    const double path = (1.0 - reach) * length * index;
    const double side = reach + path * sine / across;
    const double at[3] = { eye[0] + side * ray[0], eye[1] + side * ray[1],
      depth - path * std::sqrt(1.0 - sine * sine) };
    const double radius = std::hypot(at[0], at[1], at[2]);
    wrong += !(radius <= largest && radius >= smallest);
  }
  std::cout << wrong << " of " << data->GetNumberOfPoints() << " points are not on the ball\n";
  return wrong == 0 && data->GetNumberOfPoints() >= 20 ? EXIT_SUCCESS : EXIT_FAILURE;
}
