#include "PolygonTriangulation.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"

namespace irradiance
{

namespace
{

/// The diagonal 0-2, unless only 1-3 lies inside.
void triangulateQuad(const std::vector<Vector3>& p, std::vector<Triangle>& triangles)
{
  const Triangle a{ p[0], p[1], p[2] }, b{ p[0], p[2], p[3] };
  const Triangle c{ p[0], p[1], p[3] }, d{ p[1], p[2], p[3] };
  const bool isFirstInside = a.areaVector().dot(b.areaVector()) >= 0;
  const bool isSecondInside = c.areaVector().dot(d.areaVector()) >= 0;
  if (isFirstInside || !isSecondInside)
  {
    triangles.insert(triangles.end(), { a, b });
  }
  else
  {
    triangles.insert(triangles.end(), { c, d });
  }
}

/// Clips ears; a fan where VTK finds none, as in a polygon without area.
void triangulatePolygon(const std::vector<Vector3>& corners, std::vector<Triangle>& triangles)
{
  const auto size = static_cast<vtkIdType>(corners.size());
  vtkNew<vtkPolygon> polygon;
  polygon->GetPoints()->SetDataTypeToDouble();
  polygon->GetPoints()->SetNumberOfPoints(size);
  polygon->GetPointIds()->SetNumberOfIds(size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    polygon->GetPoints()->SetPoint(i, corners[static_cast<std::size_t>(i)].data());
    polygon->GetPointIds()->SetId(i, i);
  }
  vtkNew<vtkIdList> ids;
  const bool isCut = polygon->Triangulate(ids) != 0 && ids->GetNumberOfIds() == 3 * (size - 2);
  for (vtkIdType i = 0; i + 2 < size; ++i)
  {
    const auto corner = [&](vtkIdType k) -> const Vector3& {
      const vtkIdType id = isCut ? ids->GetId(3 * i + k) : (k == 0 ? 0 : i + k);
      return corners[static_cast<std::size_t>(id)];
    };
    triangles.push_back({ corner(0), corner(1), corner(2) });
  }
}

}

void triangulate(const std::vector<Vector3>& corners, std::vector<Triangle>& triangles)
{
  if (corners.size() == 3)
  {
    triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  else if (corners.size() == 4)
  {
    triangulateQuad(corners, triangles);
  }
  else if (corners.size() > 4)
  {
    triangulatePolygon(corners, triangles);
  }
}

}
