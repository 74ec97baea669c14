// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * usage: meniscus_tetgen TASK ANSWER
 *
 * Reads a task, lets TetGen make tetrahedra and writes the answer. TetGen crashes on some surfaces,
 * or does not end, so vtkTetrahedralizeSurface runs it as this program.
 */
#include "Surface/MeshingFiles.h"
#include "Surface/TetrahedronShape.h"

#define TETLIBRARY
#include <tetgen.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#ifdef __linux__
#include <csignal>
#include <sys/prctl.h>
#endif

namespace
{

using meniscus::MeshingAnswer;
using meniscus::MeshingEnd;
using meniscus::MeshingTask;

//------------------------------------------------------------------------------
// The surface in TetGen's form: facets of one triangle.
void Describe(const meniscus::TriangleSurface& surface, tetgenio& in)
{
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(surface.Points.size());
  in.pointlist = new REAL[3 * surface.Points.size()];
  for (std::size_t i = 0; i < surface.Points.size(); ++i)
  {
    std::copy_n(&surface.Points[i].x, 3, in.pointlist + 3 * i);
  }
  in.numberoffacets = static_cast<int>(surface.Triangles.size());
  in.facetlist = new tetgenio::facet[surface.Triangles.size()];
  for (std::size_t i = 0; i < surface.Triangles.size(); ++i)
  {
    tetgenio::facet& facet = in.facetlist[i];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist->numberofvertices = 3;
    facet.polygonlist->vertexlist = new int[3];
    std::copy_n(surface.Triangles[i].begin(), 3, facet.polygonlist->vertexlist);
  }
}

//------------------------------------------------------------------------------
// p: a surface, A: numbers of regions, J: indices of points as they are, Q: quiet, c: up to the
// convex hull, Y: no points on the surface, q: bound of radius to shortest edge, O0: no
// optimisation of angles afterwards, which exceeds that bound again.
std::string SwitchesFor(const MeshingTask& task, bool optimizes)
{
  std::string switches = "pAJQ";
  char number[64];
  if (task.FillsHull)
  {
    switches += "cM";
  }
  if (task.KeepsSurface)
  {
    switches += 'Y';
  }
  // Decimal fractions without exponents, which TetGen cannot read.
  if (task.RadiusEdgeRatio > 0.0)
  {
    std::snprintf(number, sizeof number, "q%.6f", task.RadiusEdgeRatio);
    switches += number;
  }
  return optimizes ? switches : switches + "O0";
}

//------------------------------------------------------------------------------
void Copy(const tetgenio& result, meniscus::TetrahedronCells& cells)
{
  for (int p = 0; p < result.numberofpoints; ++p)
  {
    const REAL* x = result.pointlist + 3 * static_cast<std::size_t>(p);
    cells.Points.emplace_back(x[0], x[1], x[2]);
  }
  const auto attributes = static_cast<std::size_t>(result.numberoftetrahedronattributes);
  for (std::size_t c = 0; c < static_cast<std::size_t>(result.numberoftetrahedra); ++c)
  {
    const int* ids = result.tetrahedronlist + 4 * c;
    cells.Cells.push_back({ ids[0], ids[1], ids[2], ids[3] });
    cells.Regions.push_back(
      attributes > 0 ? static_cast<int>(result.tetrahedronattributelist[c * attributes]) : 0);
  }
}

//------------------------------------------------------------------------------
MeshingEnd EndOf(int code)
{
  for (const MeshingEnd end :
    { MeshingEnd::OutOfMemory, MeshingEnd::InternalError, MeshingEnd::SelfIntersection,
      MeshingEnd::SmallFeature, MeshingEnd::CloseFacets, MeshingEnd::BadInput })
  {
    if (code == static_cast<int>(end))
    {
      return end;
    }
  }
  return MeshingEnd::OtherError;
}

/** File of the answer, for answerException(). */
std::string answerFile;

//------------------------------------------------------------------------------
// Answers with the exception that TetGen has thrown. An exception that nobody catches comes here
// before any object is destroyed: TetGen frees its mesh before it throws, and its destructor would
// free it again.
[[noreturn]] void AnswerException()
{
  MeshingAnswer answer;
  try
  {
    std::rethrow_exception(std::current_exception());
  }
  catch (int code)
  {
    answer.End = EndOf(code);
  }
  catch (const std::bad_alloc&)
  {
    answer.End = MeshingEnd::OutOfMemory;
  }
  catch (...)
  {
  }
  std::_Exit(meniscus::WriteMeshingAnswer(answerFile, answer) ? EXIT_SUCCESS : EXIT_FAILURE);
}

//------------------------------------------------------------------------------
MeshingAnswer Mesh(const MeshingTask& task, bool optimizes)
{
  MeshingAnswer answer;
  tetgenio in;
  Describe(task.Surface, in);
  tetgenio result;
  tetgenbehavior behavior;
  std::string switches = SwitchesFor(task, optimizes);
  if (!behavior.parse_commandline(&switches[0]))
  {
    return answer;
  }
  // Not by a switch, whose decimal fractions have no exponent.
  if (task.MaximumVolume > 0.0)
  {
    behavior.fixedvolume = 1;
    behavior.maxvolume = task.MaximumVolume;
  }
  tetrahedralize(&behavior, &in, &result);
  Copy(result, answer.Cells);
  answer.End = MeshingEnd::Done;
  return answer;
}

//------------------------------------------------------------------------------
// Without points on the surface there is no bound to keep, and cells next to it may only be rounded
// by optimisation; elsewhere only if there are cells without volume.
MeshingAnswer Mesh(const MeshingTask& task)
{
  MeshingAnswer answer = Mesh(task, task.KeepsSurface);
  const auto isFlat = [&](const meniscus::Tetrahedron& cell)
  {
    const auto point = [&](std::size_t i)
    { return answer.Cells.Points[static_cast<std::size_t>(cell[i])]; };
    return meniscus::IsFlat(point(0), point(1), point(2), point(3));
  };
  const bool hasFlat = std::any_of(answer.Cells.Cells.begin(), answer.Cells.Cells.end(), isFlat);
  return hasFlat && !task.KeepsSurface ? Mesh(task, true) : answer;
}

//------------------------------------------------------------------------------
// Ends this program together with the thread that has started it, which waits for it otherwise:
// nobody would read the answer, and the time limit is that thread's.
void EndWithParent()
{
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

} // anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  EndWithParent();
  MeshingTask task;
  if (argc != 3 || !meniscus::ReadMeshingTask(argv[1], task))
  {
    std::fprintf(
      stderr, "usage: meniscus_tetgen TASK ANSWER (files of vtkTetrahedralizeSurface)\n");
    return EXIT_FAILURE;
  }
  answerFile = argv[2];
  std::set_terminate(AnswerException);
  return meniscus::WriteMeshingAnswer(answerFile, Mesh(task)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
