// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Membrane/RefractionScene.h"

#include "Filters/Common/ThreadedLoop.h"
#include "Filters/Interface/InterfaceInput.h"
#include "Filters/Membrane/BackPieces.h"
#include "Refraction/Stack/PlaneImages.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include "vtkImplicitFunction.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkRefractingInterface.h"
#include "vtkRefractingInterfaceCollection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

namespace meniscus
{

//------------------------------------------------------------------------------
RefractionScene::RefractionScene(Fitting fitting, Use use)
  : UsedFitting(fitting)
  , UsedFor(use)
{
}

//------------------------------------------------------------------------------
RefractionScene::Loan::Loan(RefractionScene& scene)
  : Scene(scene)
{
  scene.MayBorrow = true;
}

//------------------------------------------------------------------------------
RefractionScene::Loan::~Loan()
{
  this->Scene.Undecided = this->Scene.GetNumberOfUndecided();
  this->Scene.MayBorrow = false;
  if (this->Scene.HasBorrowed)
  {
    this->Scene.HasBorrowed = false;
    ReturnScene(*this->Scene.Prepared);
  }
}

//------------------------------------------------------------------------------
void RefractionScene::Borrow(const std::vector<Source>& sources)
{
  std::vector<MembraneOrigin> origins;
  for (const Source& source : sources)
  {
    origins.emplace_back(source.Data, source.Function, source.Curves);
  }
  this->Prepared = BorrowScene(this->Prepared, this->Version, origins, this->View);
  this->HasBorrowed = true;
  this->UndecidedBefore = this->CountUndecided();
}

//------------------------------------------------------------------------------
vtkTypeInt64 RefractionScene::CountUndecided() const
{
  if (const auto* curved = std::get_if<CurvedMembraneSolver>(&this->Prepared->Solver))
  {
    return curved->GetNumberOfUndecidedSearches() + curved->GetNumberOfUndecidedSides();
  }
  return this->GetPathSolver() ? this->GetPathSolver()->GetNumberOfUndecidedSearches() : 0;
}

//------------------------------------------------------------------------------
vtkTypeInt64 RefractionScene::GetNumberOfUndecided() const
{
  return this->Undecided + (this->HasBorrowed ? this->CountUndecided() - this->UndecidedBefore : 0);
}

//------------------------------------------------------------------------------
/** Surfaces of an input whose list rays can pass, and the parts of the view that it determines. */
std::vector<RefractionScene::Source> RefractionScene::ListSources(
  const Input& input, SceneMessages& messages) const
{
  std::vector<Source> sources;
  const std::vector<vtkPolyData*> surfaces =
    ListSurfaces(input.Surfaces, input.Port, input.Interfaces, messages.Error);
  for (std::size_t i = 0; i < surfaces.size() && messages.Error.empty(); ++i)
  {
    vtkRefractingInterface* interface = input.Interfaces->GetInterface(static_cast<int>(i));
    sources.push_back(
      { surfaces[i], this->UsedFitting == Fitting::Exact ? interface->GetExactSurface() : nullptr,
        input.IsCurved });
  }
  return sources;
}

//------------------------------------------------------------------------------
bool RefractionScene::SetSurfaces(const Input& input, SceneMessages& messages)
{
  const std::vector<Source> sources = this->ListSources(input, messages);
  if (!messages.Error.empty())
  {
    return false;
  }
  this->View.Media = ListMedia(input.Interfaces);
  this->View.Reflects = input.Reflects;
  this->View.Turns.clear();
  for (int i = 0; i < input.Interfaces->GetNumberOfItems(); ++i)
  {
    this->View.Turns.push_back(input.Interfaces->GetInterface(i)->GetTurnTowardsEye());
  }
  if (this->MayBorrow)
  {
    this->Borrow(sources);
  }
  return this->UpdateSurfaces(sources, messages);
}

//------------------------------------------------------------------------------
bool RefractionScene::Update(
  const Input& input, const std::array<double, 3>& eye, SceneMessages& messages)
{
  this->View.Eye = eye;
  return this->SetSurfaces(input, messages) && this->SetEye(eye, messages);
}

//------------------------------------------------------------------------------
bool RefractionScene::UpdateSurfaces(const std::vector<Source>& sources, SceneMessages& messages)
{
  PreparedScene& prepared = *this->Prepared;
  const std::size_t count = sources.size();
  bool isNew = prepared.Surfaces.size() != count;
  if (isNew && (count == 1 || prepared.Surfaces.size() == 1))
  {
    prepared.Surfaces.clear();
  }
  const auto change =
    count == 1 ? SourceSurface::Change::InPlace : SourceSurface::Change::NewObject;
  prepared.Surfaces.resize(count, { SourceSurface(change) });
  for (std::size_t i = 0; i < count; ++i)
  {
    isNew = this->ReadSurface(i, sources[i]) || isNew;
  }
  if (isNew)
  {
    prepared.HasSolver = false;
    prepared.HasRays = false;
    prepared.Version.Shape = SceneVersion::MakeNumber();
  }
  if (this->Version.Shape != prepared.Version.Shape)
  {
    this->Version.Shape = prepared.Version.Shape;
    if (!this->ReportSurfaces(messages))
    {
      return false;
    }
  }
  const bool isList = count > 1 || this->UsedFor == Use::Rays;
  if (!prepared.HasSolver || (isList && !(prepared.Media == this->View.Media)))
  {
    this->SetSolver();
  }
  return true;
}

//------------------------------------------------------------------------------
/**
 * Reads a surface again if its values have changed. An earlier one with the same values is shared.
 * Returns true if the surface is a new one.
 */
bool RefractionScene::ReadSurface(std::size_t index, const Source& source)
{
  std::vector<PreparedSurface>& surfaces = this->Prepared->Surfaces;
  SourceSurface& own = surfaces[index].Source;
  const MembraneOrigin origin(source.Data, source.Function, source.Curves);
  const auto isCurrent = [&origin, isTurned = own.IsTurned()](const PreparedSurface& surface)
  {
    return surface.Source.IsReady() && surface.Source.GetOrigin() == origin &&
      surface.Source.IsTurned() == isTurned;
  };
  const auto end = surfaces.begin() + static_cast<std::ptrdiff_t>(index);
  const auto earlier = std::find_if(surfaces.begin(), end, isCurrent);
  if (earlier != end && !isCurrent(surfaces[index]))
  {
    const bool isNew = own.GetSurface() != earlier->Source.GetSurface();
    surfaces[index] = *earlier;
    return isNew;
  }
  if (!own.Update(source.Data, source.Function, source.Curves))
  {
    return false;
  }
  surfaces[index].Shape = SceneVersion::MakeNumber();
  ++this->PatchBuilds;
  return true;
}

//------------------------------------------------------------------------------
/** Describes the shapes that are new to this scene. Returns false if one of them cannot be used. */
bool RefractionScene::ReportSurfaces(SceneMessages& messages)
{
  const std::vector<PreparedSurface>& surfaces = this->Prepared->Surfaces;
  std::vector<vtkTypeInt64> shapes;
  std::swap(shapes, this->ReportedShapes);
  this->SkippedFacets = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    const auto isShape = [&](const std::vector<vtkTypeInt64>& list)
    { return std::find(list.begin(), list.end(), surfaces[i].Shape) != list.end(); };
    const bool isRepeated = isShape(this->ReportedShapes);
    this->ReportedShapes.push_back(surfaces[i].Shape);
    if (!isRepeated)
    {
      this->SkippedFacets += surfaces[i].Source.GetMembrane().GetReport().Skipped();
    }
    SceneMessages read;
    if (isRepeated || isShape(shapes))
    {
      continue;
    }
    const bool isReady = surfaces[i].Source.Report(read);
    const std::string place = NameInterface(i, surfaces.size());
    messages.Error += read.Error.empty() ? "" : place + read.Error;
    messages.Warning += read.Warning.empty() ? "" : place + read.Warning;
    if (!isReady)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** The solver of this type, an empty one unless it was used last. */
template <typename Solver>
Solver& RefractionScene::UseSolver()
{
  auto& solver = this->Prepared->Solver;
  if (!std::holds_alternative<Solver>(solver))
  {
    this->Undecided = this->GetNumberOfUndecided();
    this->UndecidedBefore = 0;
    solver.template emplace<Solver>();
  }
  return std::get<Solver>(solver);
}

//------------------------------------------------------------------------------
/** Chooses the solver and hands it the surfaces. */
void RefractionScene::SetSolver()
{
  PreparedScene& prepared = *this->Prepared;
  const SourceSurface& first = prepared.Surfaces.front().Source;
  prepared.HasSolver = true;
  prepared.HasRays = false;
  prepared.Media = this->View.Media;
  if (prepared.Surfaces.size() > 1 || this->UsedFor == Use::Rays)
  {
    this->PrepareCrossings();
    std::vector<Interface> list;
    for (std::size_t i = 0; i < prepared.Media.size(); ++i)
    {
      list.push_back({ prepared.Surfaces[i].Source.GetSurface(), prepared.Media[i] });
    }
    this->AreEyesExamined = false;
    this->AreEyesBehind = false;
    this->UseSolver<StackSolver>().SetInterfaces(list);
  }
  else if (first.GetOrigin().Curves)
  {
    this->UseSolver<CurvedMembraneSolver>().SetSurface(first.GetSurface());
  }
  else
  {
    this->UseSolver<FlatMembraneSolver>().SetSurface(first.GetSurface());
  }
}

//------------------------------------------------------------------------------
void RefractionScene::PrepareCrossings()
{
  for (const PreparedSurface& surface : this->Prepared->Surfaces)
  {
    surface.Source.GetSurface()->Prepare(SurfaceParts::Crossings, FacetLoop);
  }
}

//------------------------------------------------------------------------------
/**
 * True if an open surface shows the eye its other side only, when rays pass the list from the
 * exterior of the first interface. False for an eye that is not finite.
 */
bool RefractionScene::IsOnWrongSide(std::size_t index, const glm::dvec3& eye) const
{
  const Membrane& surface = this->Prepared->Surfaces[index].Source.GetMembrane();
  const glm::dvec3 local = eye - surface.GetOrigin();
  const MediaChain chain(this->View.Media);
  return !chain.Ways.empty() && !surface.IsClosed() && std::isfinite(local.x + local.y + local.z) &&
    !surface.ShowsSide(local, chain.Ways.front()[index].FromFront ? 1.0 : -1.0);
}

//------------------------------------------------------------------------------
/** Turns surfaces round whose interfaces say so, or back. */
void RefractionScene::TurnSurfaces()
{
  PreparedScene& prepared = *this->Prepared;
  bool isNew = false;
  for (std::size_t i = 0; i < prepared.Surfaces.size(); ++i)
  {
    SourceSurface& source = prepared.Surfaces[i].Source;
    const bool isTurned =
      this->View.Turns[i] && source.IsTurned() != this->IsOnWrongSide(i, this->GetEye());
    if (isTurned != source.IsTurned())
    {
      source.Turn();
      ++this->PatchBuilds;
      isNew = true;
    }
  }
  if (isNew)
  {
    prepared.Version.Shape = SceneVersion::MakeNumber();
    this->Version.Shape = prepared.Version.Shape;
    this->SetSolver();
  }
}

//------------------------------------------------------------------------------
/** Makes a list of one surface if the eye is in front of it and it is an exact plane. */
bool RefractionScene::FindPlane(const CurvedMembraneSolver& curved)
{
  PreparedScene& prepared = *this->Prepared;
  prepared.Plane.Clear();
  if (this->View.Reflects || !curved.IsFlat())
  {
    return false;
  }
  this->PrepareCrossings();
  prepared.Path.SetInterfaces(
    { { prepared.Surfaces.front().Source.GetSurface(), this->View.Media.front() } });
  if (prepared.Path.SetEye(this->GetEye()) == EyeStatus::Ready && prepared.Path.HasPassage() &&
    prepared.Path.GetLinks().front().Passage.FromFront)
  {
    prepared.Plane.Set(prepared.Path);
  }
  if (!prepared.Plane.AreExact())
  {
    prepared.Plane.Clear();
  }
  return prepared.Plane.AreExact();
}

//------------------------------------------------------------------------------
/** Fits the solver to the eye of the view. */
EyeStatus RefractionScene::PlaceEye()
{
  this->Prepared->Plane.Clear();
  auto& solver = this->Prepared->Solver;
  const glm::dvec3 eye = this->GetEye();
  const InterfaceMedia& first = this->View.Media.front();
  if (auto* list = std::get_if<StackSolver>(&solver))
  {
    return this->UsedFor == Use::Rays ? list->PlaceEye(eye) : list->SetEye(eye, FacetLoop);
  }
  if (auto* curved = std::get_if<CurvedMembraneSolver>(&solver))
  {
    return this->FindPlane(*curved)
      ? curved->PlaceEye(eye, first.Exterior, first.Interior)
      : curved->SetEye(eye, first.Exterior, first.Interior, FacetLoop, this->View.Reflects);
  }
  return std::get<FlatMembraneSolver>(solver).SetEye(
    eye, first.Exterior, first.Interior, FacetLoop);
}

//------------------------------------------------------------------------------
bool RefractionScene::SetEye(const std::array<double, 3>& eye, SceneMessages& messages)
{
  PreparedScene& prepared = *this->Prepared;
  this->View.Eye = eye;
  if (!prepared.HasRays || !(prepared.View == this->View))
  {
    prepared.HasRays = false; // stale until the update succeeds
    this->TurnSurfaces();
    const EyeStatus status = this->PlaceEye();
    this->AreEyesExamined = false;
    if (status != EyeStatus::Ready)
    {
      messages.Error = DescribeBadEye(status, this->GetEye());
      return false;
    }
    prepared.View = this->View;
    prepared.HasRays = true;
    prepared.Version.Rays = SceneVersion::MakeNumber();
    ++this->EyeUpdates;
  }
  if (this->Version.Rays != prepared.Version.Rays)
  {
    this->Version.Rays = prepared.Version.Rays;
    messages.Warning += this->GetPathSolver()
      ? this->DescribeList(this->GetStack())
      : this->DescribeMembrane(std::get_if<CurvedMembraneSolver>(&prepared.Solver));
  }
  return true;
}

//------------------------------------------------------------------------------
/** Text of the warning about the eye of one interface; `curved` is null for flat facets. */
std::string RefractionScene::DescribeMembrane(const CurvedMembraneSolver* curved)
{
  // The test takes a few microseconds per point. Two sheets one behind the other overlap in many
  // consecutive points.
  constexpr std::size_t mostPoints = 256;
  const bool isEnclosed = curved && curved->IsClosed() && !curved->FacesEye();
  const bool reflects = this->View.Reflects;
  const bool isBehind = this->IsOnWrongSide(0, this->GetEye());
  const auto behind = static_cast<vtkTypeInt64>(
    curved && !reflects ? curved->CountVerticesBehindOtherPieces(mostPoints) : 0);
  const bool isNew = this->EyeReportOf != this->Version.Shape;
  std::ostringstream text;
  if (isEnclosed && (isNew || !this->EyeEnclosed))
  {
    text << "The eye is inside of a closed membrane whose normals point outwards: "
         << (reflects ? "it sees the back of the mirror only. To mirror its inside"
                      : "geometry outside passes unchanged. For a bubble around the eye")
         << ", reverse the normals. ";
  }
  if (isBehind && (isNew || this->Sees))
  {
    text << "No facet of the membrane faces the eye: its normals point to the other side, and "
         << (reflects ? "the eye sees the back of the mirror only. "
                      : "everything passes unchanged. ")
         << "Unless the eye is really behind the membrane, reverse the normals and the order of "
            "the corners, or use TurnTowardsEye of the vtkRefractingInterface. ";
  }
  if (behind > 0 && (isNew || this->PointsBehind == 0))
  {
    text
      << "Pieces of the membrane lie behind each other as seen from the eye: rays that meet two "
         "of them are refracted at one only, and objects behind both have an image through each. "
         "Use one piece, or a filter for each. ";
  }
  if (!isEnclosed && !isBehind)
  {
    text << this->DescribePieces(0, { this->GetEye() }, 1.0);
  }
  this->EyeEnclosed = isEnclosed;
  this->Sees = !isBehind;
  this->PointsBehind = behind;
  this->EyeReportOf = this->Version.Shape;
  return text.str();
}

//------------------------------------------------------------------------------
/** Text of the warning about pieces that show all eyes their backs, once for each shape. */
std::string RefractionScene::DescribePieces(
  std::size_t index, const std::vector<glm::dvec3>& eyes, double side)
{
  const std::size_t backs =
    CountBackFacets(*this->Prepared->Surfaces[index].Source.GetSurface(), eyes, side);
  std::ostringstream text;
  if (backs > 0 && this->PieceReportOf != this->Version.Shape)
  {
    this->PieceReportOf = this->Version.Shape;
    text << NameInterface(index, this->Prepared->Surfaces.size()) << backs
         << " facets belong to pieces of the surface that show the eye their backs: no ray is "
            "refracted there, and nothing is seen behind them. Reverse their normals and the order "
            "of their corners. ";
  }
  return text.str();
}

//------------------------------------------------------------------------------
/** Text of the warning about interfaces that the eye is behind or sees from their wrong side. */
std::string RefractionScene::DescribeList(const RefractionStack& stack)
{
  const bool isBlocked = stack.GetNumberOfInterfaces() > 0 && !stack.HasPassage();
  const std::size_t behind = stack.GetNumberOfInterfaces() - stack.GetLinks().size();
  const bool isBehind = behind > this->InterfacesBehindEye;
  this->InterfacesBehindEye = behind;
  const std::string reflection =
    stack.GetLinks().empty() || isBlocked ? std::string() : DescribeReflection(stack);
  this->Sees = !isBlocked && reflection.empty();
  this->EyeEnclosed = false;
  this->PointsBehind = 0;
  std::ostringstream text;
  text << reflection;
  if (isBlocked)
  {
    text << "No ray from the eye passes the surfaces in the order of the list. Do they cross, does "
            "one of them lie behind the eye or out of the others' way, or is the list in another "
            "order? ";
  }
  if (isBehind)
  {
    const std::size_t last = stack.GetLinks().front().Index - 1;
    text << "The eye is behind interface " << (last > 0 ? "0 to " : "") << last
         << ", and nothing is refracted there. If the eye is in front, surfaces are in the wrong "
            "order, normals point to the wrong side, or indices of refraction are exchanged. ";
  }
  if (this->UsedFor != Use::Rays && !isBlocked && !stack.GetLinks().empty())
  {
    const RefractionStack::Link& first = stack.GetLinks().front();
    text << this->DescribePieces(
      first.Index, { this->GetEye() }, first.Passage.FromFront ? 1.0 : -1.0);
  }
  for (std::size_t i = 0; (isBlocked || isBehind) && i < this->View.Media.size(); ++i)
  {
    if (this->View.Media[i].IsRefracting() && this->IsOnWrongSide(i, this->GetEye()))
    {
      text
        << "Interface " << i
        << " shows the eye the side of the medium behind it: unless the eye is there, reverse its "
           "normals, exchange its indices, or use TurnTowardsEye of the vtkRefractingInterface. ";
    }
  }
  return text.str();
}

//------------------------------------------------------------------------------
void RefractionScene::ReportEyes(const std::vector<glm::dvec3>& eyes, SceneMessages& messages)
{
  const auto first = std::find_if(this->View.Media.begin(), this->View.Media.end(),
    [](const InterfaceMedia& media) { return media.IsRefracting(); });
  if (this->AreEyesExamined || eyes.empty() || first == this->View.Media.end())
  {
    return;
  }
  const auto index = static_cast<std::size_t>(first - this->View.Media.begin());
  const bool areBehind = std::all_of(eyes.begin(), eyes.end(),
    [this, index](const glm::dvec3& eye) { return this->IsOnWrongSide(index, eye); });
  if (areBehind && !this->AreEyesBehind)
  {
    messages.Warning +=
      "No facet of the first membrane faces an eye: its normals point to the other side. Unless "
      "the eyes are really behind it, reverse the normals and the order of the corners. ";
  }
  const MediaChain chain(this->View.Media);
  if (!areBehind && !chain.Ways.empty())
  {
    messages.Warning +=
      this->DescribePieces(index, eyes, chain.Ways.front()[index].FromFront ? 1.0 : -1.0);
  }
  this->AreEyesExamined = true;
  this->AreEyesBehind = areBehind;
}

//------------------------------------------------------------------------------
std::vector<RefractionStack::Link> RefractionScene::ListLinks() const
{
  const std::vector<PreparedSurface>& surfaces = this->Prepared->Surfaces;
  if (surfaces.size() > 1)
  {
    return this->GetStack().GetLinks();
  }
  const InterfaceMedia& media = this->View.Media.front();
  return { { surfaces.front().Source.GetSurface(), { media.Exterior, media.Interior, true },
    glm::dvec3(0.0), 0, media.Exterior / media.Interior } };
}

//------------------------------------------------------------------------------
const glm::dvec3& RefractionScene::GetOrigin() const
{
  return this->Prepared->Surfaces.size() > 1 ? this->GetStack().GetOrigin()
                                             : this->GetFirstMembrane().GetOrigin();
}

//------------------------------------------------------------------------------
const Membrane& RefractionScene::GetFirstMembrane() const
{
  const StackSolver* list = this->GetPathSolver();
  return list && !list->GetStack().GetLinks().empty()
    ? list->GetStack().GetLinks().front().Surface->GetMembrane()
    : this->Prepared->Surfaces.front().Source.GetMembrane();
}

//------------------------------------------------------------------------------
bool RefractionScene::SetView(const std::vector<ViewPlane>& planes)
{
  const auto* curved = std::get_if<CurvedMembraneSolver>(&this->Prepared->Solver);
  if (this->GetPathSolver())
  {
    return false;
  }
  if (curved)
  {
    curved->PrepareTree(FacetLoop);
  }
  const Membrane& membrane = this->GetFirstMembrane();
  const auto& facets = membrane.GetFacets();
  // Rounding of a sum of three products of coordinates, with planes that are computed from two
  // matrices.
  constexpr double rounding = 1e-12;
  const auto getBulge = [curved](std::size_t facet)
  {
    return curved ? BoundBulge(curved->GetPatches().GetPatch(static_cast<std::int32_t>(facet)))
                  : 0.0;
  };
  // Bits of the planes that a vertex is behind. With NaN nothing is known, and no bit is set.
  const std::vector<glm::dvec3>& positions = membrane.GetPositions();
  const auto getHeight = [&membrane, &positions](const ViewPlane& plane, std::size_t vertex)
  { return glm::dot(plane.Normal, positions[vertex] + membrane.GetOrigin()) + plane.Offset; };
  std::vector<std::uint32_t> behind(positions.size(), 0);
  for (std::size_t k = 0; k < planes.size(); ++k)
  {
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      behind[i] |= getHeight(planes[k], i) < 0.0 ? 1u << k : 0u;
    }
  }
  std::vector<bool> inView(facets.size(), true);
  bool any = false;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    const auto vertex = [&facets, i](std::size_t k)
    { return static_cast<std::size_t>(facets[i][k]); };
    const std::uint32_t all = behind[vertex(0)] & behind[vertex(1)] & behind[vertex(2)];
    for (std::size_t k = 0; all != 0 && k < planes.size() && inView[i]; ++k)
    {
      double most = std::numeric_limits<double>::lowest();
      double reach = std::fabs(planes[k].Offset);
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        most = std::max(most, getHeight(planes[k], vertex(corner)));
        reach = std::max(reach, glm::length(positions[vertex(corner)] + membrane.GetOrigin()));
      }
      inView[i] = !(most < -rounding * reach && most < -getBulge(i) - rounding * reach);
    }
    any = any || !inView[i];
  }
  if (inView != this->FacetsInView)
  {
    this->FacetsInView = std::move(inView);
    ++this->ViewChange;
  }
  return any;
}

//------------------------------------------------------------------------------
bool RefractionScene::MayBeInView(const glm::dvec3& low, const glm::dvec3& high) const
{
  if (const auto* curved = std::get_if<CurvedMembraneSolver>(&this->Prepared->Solver))
  {
    return curved->MayShow(low, high, this->FacetsInView);
  }
  const auto* flat = std::get_if<FlatMembraneSolver>(&this->Prepared->Solver);
  const glm::dvec3 half = 0.5 * high - 0.5 * low;
  return !flat ||
    flat->MayShow(0.5 * low + 0.5 * high, std::max({ half.x, half.y, half.z }), this->FacetsInView);
}

//------------------------------------------------------------------------------
void RefractionScene::Solve(const double* points, std::size_t from, std::size_t to,
  VirtualVertex* vertices, StackDetail* details, double* legs) const
{
  const auto& solver = this->Prepared->Solver;
  if (const auto* curved = std::get_if<CurvedMembraneSolver>(&solver))
  {
    const ParallelPlanes* plane = this->GetPlane();
    std::vector<unsigned char> isOpen(plane ? to : 0, 1);
    if (!plane || SolveAtPlane(*plane, points, from, to, vertices, isOpen.data()))
    {
      curved->Solve(points, from, to, vertices, plane ? isOpen.data() : nullptr);
    }
  }
  else if (const auto* flat = std::get_if<FlatMembraneSolver>(&solver))
  {
    flat->Solve(points, from, to, vertices);
  }
  else
  {
    this->GetPathSolver()->Solve(points, from, to, vertices, details, legs);
  }
}

}
