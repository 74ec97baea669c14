// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChanges.h"
#include "VolumeRelation.h"

namespace meniscus::test
{

namespace
{

using Triangle = std::array<vtkIdType, 3>;

// A membrane as plain arrays.
struct Facets
{
  std::vector<reference::Vector3> Points;
  std::vector<reference::Vector3> Normals;
  std::vector<std::vector<vtkIdType>> Cells;

  explicit Facets(vtkPolyData* mesh)
  {
    vtkDataArray* normals = mesh->GetPointData()->GetNormals();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const double* x = mesh->GetPoint(i);
      const double* n = normals->GetTuple3(i);
      this->Points.push_back({ x[0], x[1], x[2] });
      this->Normals.push_back({ n[0], n[1], n[2] });
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
    {
      mesh->GetCellPoints(c, ids);
      this->Cells.emplace_back(ids->begin(), ids->end());
    }
  }

  vtkSmartPointer<vtkPolyData> ToMesh() const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> normals;
    normals->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      points->InsertNextPoint(this->Points[i].data());
      normals->InsertNextTuple(this->Normals[i].data());
    }
    vtkNew<vtkCellArray> cells;
    for (const std::vector<vtkIdType>& cell : this->Cells)
    {
      cells->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(points);
    mesh->SetPolys(cells);
    mesh->GetPointData()->SetNormals(normals);
    return mesh;
  }
};

//------------------------------------------------------------------------------
// Point of the surface on the normal through the middle of two points, created once per edge.
class EdgeMiddles
{
public:
  EdgeMiddles(Facets& facets, const reference::RefractingSurface& surface)
    : Mesh(facets)
    , Surface(surface)
  {
  }

  vtkIdType Of(vtkIdType a, vtkIdType b)
  {
    const auto key = std::minmax(a, b);
    const auto known = this->Known.find(key);
    if (known != this->Known.end())
    {
      return known->second;
    }
    reference::Ray ray;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ray.Origin[axis] = 0.5 *
        (this->Mesh.Points[static_cast<std::size_t>(a)][axis] +
          this->Mesh.Points[static_cast<std::size_t>(b)][axis]);
    }
    ray.Direction = this->Surface.Normal(ray.Origin);
    ray.Begin = -1.0;
    ray.End = 1.0;
    double nearest = 0.0;
    double least = HUGE_VAL;
    for (const double t : this->Surface.Meet(ray))
    {
      nearest = std::fabs(t) < least ? t : nearest;
      least = std::min(least, std::fabs(t));
    }
    reference::Vector3 place = ray.Origin;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] += nearest * ray.Direction[axis];
    }
    this->Mesh.Points.push_back(place);
    this->Mesh.Normals.push_back(this->Surface.Normal(place));
    return this->Known[key] = static_cast<vtkIdType>(this->Mesh.Points.size()) - 1;
  }

private:
  Facets& Mesh;
  const reference::RefractingSurface& Surface;
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> Known;
};

// Patches over planes and spheres reproduce them exactly, and so do patches over their parts.
void DivideFacets(VolumeCase& test, RandomNumbers& random)
{
  Facets facets(test.Membrane.Mesh);
  EdgeMiddles middles(facets, test.Membrane.Surface);
  const auto before = facets.Cells;
  facets.Cells.clear();
  // All facets are divided, so that no point lies on the edge of another facet.
  for (const auto& v : before)
  {
    const vtkIdType a = middles.Of(v[0], v[1]);
    const vtkIdType b = middles.Of(v[1], v[2]);
    const vtkIdType c = middles.Of(v[2], v[0]);
    facets.Cells.insert(
      facets.Cells.end(), { { v[0], a, c }, { a, v[1], b }, { c, b, v[2] }, { a, b, c } });
  }
  Shuffle(facets.Cells, random);
  test.Membrane.Mesh = facets.ToMesh();
}

// A plane or a dome with its own indices.
void MakeExactMembrane(VolumeCase& test, RandomNumbers& random)
{
  const auto before = test.Membrane.Surface;
  const double level = random.Uniform(-0.3, 1.1);
  const int cells = 2 + random.Below(6);
  test.Membrane = random.Below(2) ? MakePlaneCase(level, 1.6, cells)
                                  : MakeDomeCase(level, random.Uniform(3.0, 6.0), 1.6, cells);
  test.Membrane.Surface.Exterior = before.Exterior;
  test.Membrane.Surface.Interior = before.Interior;
}

void ShuffleFacets(VolumeCase& test, RandomNumbers& random)
{
  Facets facets(test.Membrane.Mesh);
  std::vector<vtkIdType> order(facets.Points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = static_cast<vtkIdType>(i);
  }
  Shuffle(order, random);
  const Facets before = facets;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const auto to = static_cast<std::size_t>(order[i]);
    facets.Points[to] = before.Points[i];
    facets.Normals[to] = before.Normals[i];
  }
  for (auto& cell : facets.Cells)
  {
    for (vtkIdType& id : cell)
    {
      id = order[static_cast<std::size_t>(id)];
    }
    std::rotate(cell.begin(), cell.begin() + random.Below(3), cell.end());
  }
  Shuffle(facets.Cells, random);
  test.Membrane.Mesh = facets.ToMesh();
}

void UnshareFacets(VolumeCase& test, RandomNumbers&)
{
  const Facets before(test.Membrane.Mesh);
  Facets facets = before;
  facets.Points.clear();
  facets.Normals.clear();
  for (auto& cell : facets.Cells)
  {
    for (vtkIdType& id : cell)
    {
      facets.Points.push_back(before.Points[static_cast<std::size_t>(id)]);
      facets.Normals.push_back(before.Normals[static_cast<std::size_t>(id)]);
      id = static_cast<vtkIdType>(facets.Points.size()) - 1;
    }
  }
  test.Membrane.Mesh = facets.ToMesh();
}

// The same surface from the other side, with the indices exchanged.
void TurnMembrane(VolumeCase& test, RandomNumbers&)
{
  Facets facets(test.Membrane.Mesh);
  for (reference::Vector3& normal : facets.Normals)
  {
    normal = { -normal[0], -normal[1], -normal[2] };
  }
  for (auto& cell : facets.Cells)
  {
    std::reverse(cell.begin(), cell.end());
  }
  test.Membrane.Mesh = facets.ToMesh();
  std::swap(test.Membrane.Surface.Exterior, test.Membrane.Surface.Interior);
}

//------------------------------------------------------------------------------
void RemoveMembrane(VolumeCase& test, RandomNumbers&)
{
  test.Membrane.Mesh = nullptr;
}

void MakeEqual(VolumeCase& test, RandomNumbers&)
{
  test.Membrane.Surface.Interior = test.Membrane.Surface.Exterior;
}

// A membrane that no ray meets: behind the eye.
void AddIdleMembrane(VolumeCase& test, RandomNumbers& random)
{
  test.Membrane = MakeDomeCase(0.0, 5.0, 1.0, 2 + random.Below(5));
  Facets facets(test.Membrane.Mesh);
  const glm::dvec3 back = glm::normalize(test.View.Eye - test.View.Focus);
  const glm::dvec3 place = test.View.Eye + 5.0 * back;
  for (reference::Vector3& point : facets.Points)
  {
    point = { point[0] + place.x, point[1] + place.y, point[2] + place.z };
  }
  test.Membrane.Mesh = facets.ToMesh();
}

VolumeRelation Prepared(
  VolumeRelation relation, const std::function<void(VolumeCase&, RandomNumbers&)>& prepare)
{
  relation.Prepare = prepare;
  return relation;
}

} // anonymous namespace

//------------------------------------------------------------------------------
std::vector<VolumeRelation> MembraneRelations()
{
  CaseNeeds membrane;
  membrane.Membrane = true;
  CaseNeeds none;
  none.NoMembrane = true;
  return {
    Prepared(RelationOf("membrane divided", 4, membrane, DivideFacets), MakeExactMembrane),
    RelationOf("order of facets", 3, membrane, ShuffleFacets),
    // Patches are fitted to the neighbours with which a point is shared: for surfaces other than
    // planes and spheres, a membrane without shared points gives another, coarser surface.
    Prepared(RelationOf("points given per facet", 3, membrane, UnshareFacets), MakeExactMembrane),
    RelationOf("membrane turned over", 3, membrane, TurnMembrane),
    Prepared(RelationOf("equal indices", 3, membrane, RemoveMembrane), MakeEqual),
    RelationOf("membrane behind the eye", 3, none, AddIdleMembrane),
  };
}

} // namespace meniscus::test
