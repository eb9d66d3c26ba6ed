// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace irradiance::test
{

/// How a cell reflects and emits (W/m2); a grey object uses the first band.
struct Look
{
  std::array<double, 3> reflectance{};
  std::array<double, 3> exitance{};
  std::array<double, 3> specular{};
  double exponent = kInfinity; ///< of the Phong lobe
};

inline Look grey(double reflectance, double exitance = 0)
{
  return { { reflectance, reflectance, reflectance }, { exitance, exitance, exitance } };
}

/// Makes an object from cells. Shared corners have the same bits, so closed shapes are watertight.
class ObjectBuilder
{
public:
  explicit ObjectBuilder(int bands = 1)
  {
    material_.bands = bands;
    emission_.bands = bands;
  }

  void addCell(const std::vector<Triangle>& triangles, const Look& look)
  {
    for (const Triangle& triangle : triangles)
    {
      triangles_.push_back(triangle);
      material_.cellOfTriangle.push_back(static_cast<std::uint32_t>(material_.numberOfCells));
    }
    ++material_.numberOfCells;
    for (std::size_t band = 0; band < static_cast<std::size_t>(material_.bands); ++band)
    {
      material_.reflectance.push_back(look.reflectance[band]);
      emission_.exitance.push_back(look.exitance[band]);
      specular_.push_back(look.specular[band]);
      isSpecular_ = isSpecular_ || look.specular[band] > 0;
    }
    exponents_.push_back(look.exponent);
    if (!emission_.luminaires.empty())
    {
      emission_.luminaireOfCell.push_back(Emission::kNone);
    }
  }

  /// nu x nv cells; `corner(i, j)` for i in 0..nu, j in 0..nv; the front faces du x dv.
  template <class Corner>
  void addGrid(int nu, int nv, const Look& look, const Corner& corner)
  {
    for (int j = 0; j < nv; ++j)
    {
      for (int i = 0; i < nu; ++i)
      {
        const Vector3 a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                      d = corner(i, j + 1);
        std::vector<Triangle> cell;
        if (a != b)
        {
          cell.push_back({ a, b, c });
        }
        if (c != d)
        {
          cell.push_back({ a, c, d });
        }
        addCell(cell, look);
      }
    }
  }

  /// The front of the quad faces u x v.
  void addQuad(
    const Vector3& corner, const Vector3& u, const Vector3& v, int nu, int nv, const Look& look)
  {
    addGrid(nu, nv, look,
      [&](int i, int j) { return Vector3(corner + u * (double(i) / nu) + v * (double(j) / nv)); });
  }

  /// One side of a box, n x n cells; `side`: 0 lower x, 1 upper x, 2 lower y, ... The front faces
  /// out, or in if `isRoom`.
  void addSide(const Box& box, int side, int n, const Look& look, bool isRoom = false)
  {
    const int axis = side / 2;
    const bool isUpper = side % 2 != 0;
    const bool isStraight = isUpper != isRoom;
    const int first = (axis + (isStraight ? 1 : 2)) % 3, second = (axis + (isStraight ? 2 : 1)) % 3;
    const auto along = [&](int i, int k) {
      return i == n ? box.upper[k] : box.lower[k] + box.extent()[k] * i / n;
    };
    addGrid(n, n, look, [&](int i, int j) {
      Vector3 point = isUpper ? box.upper : box.lower;
      point[first] = along(i, first);
      point[second] = along(j, second);
      return point;
    });
  }

  void addBox(const Box& box, int n, const Look& look, bool isRoom = false)
  {
    for (int side = 0; side < 6; ++side)
    {
      addSide(box, side, n, look, isRoom);
    }
  }

  /// The corners lie on the sphere; n stacks, 2 n slices.
  void addSphere(const Vector3& center, double radius, int n, const Look& look, bool isRoom = false)
  {
    const auto corner = [&](int slice, int stack) {
      if (stack == 0 || stack == n)
      {
        return Vector3(center + Vector3(0, 0, stack == 0 ? -radius : radius));
      }
      const double polar = M_PI * stack / n, around = M_PI * (slice % (2 * n)) / n;
      return Vector3(center +
        radius *
          Vector3(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
            -std::cos(polar)));
    };
    addGrid(
      2 * n, n, look, [&](int i, int j) { return isRoom ? corner(2 * n - i, j) : corner(i, j); });
  }

  void addPointLight(const Vector3& position, double flux)
  {
    emission_.points.push_back(
      { position, std::vector<double>(static_cast<std::size_t>(material_.bands), flux) });
  }

  /// A luminaire at a point, in a cell of its own.
  void addPointLuminaire(const Vector3& position, const Luminaire& lamp)
  {
    addCell({}, {});
    const auto cell = static_cast<std::uint32_t>(material_.numberOfCells - 1);
    emission_.points.push_back({ position, lamp.flux, cell });
    addLuminaire(cell, lamp);
  }

  /// The cells from `first` on are the opening of a luminaire.
  void addOpening(std::size_t first, Luminaire lamp)
  {
    double area = 0;
    for (std::size_t i = 0; i < triangles_.size(); ++i)
    {
      if (material_.cellOfTriangle[i] >= first)
      {
        const Vector3 ofTriangle = triangles_[i].areaVector() / 2;
        area += ofTriangle.norm();
        const auto same =
          std::find_if(lamp.faces.begin(), lamp.faces.end(), [&](const Vector3& face) {
            return face.normalized().dot(ofTriangle.normalized()) > 1 - 1e-12;
          });
        same == lamp.faces.end() ? lamp.faces.push_back(ofTriangle) : void(*same += ofTriangle);
      }
    }
    for (std::size_t i = first * lamp.flux.size(); i < emission_.exitance.size(); ++i)
    {
      emission_.exitance[i] = lamp.flux[i % lamp.flux.size()] / area;
    }
    addLuminaire(first, lamp);
  }

  Material& material() { return material_; }
  std::size_t numberOfCells() const { return material_.numberOfCells; }
  Emission& emission() { return emission_; }

  SceneObject build(const AffineMap& worldFromObject = {}, bool isFlattened = false) const
  {
    const auto material = std::make_shared<Material>(material_);
    if (isSpecular_)
    {
      material->setSpecular(specular_, exponents_);
    }
    const auto isLit = [](double watts) { return watts > 0; };
    const bool emits = !emission_.points.empty() ||
      std::any_of(emission_.exitance.begin(), emission_.exitance.end(), isLit);
    return { { std::make_shared<RigidObject>(TriangleMesh(triangles_)), worldFromObject,
               isFlattened },
      material, emits ? std::make_shared<Emission>(emission_) : nullptr };
  }

private:
  void addLuminaire(std::size_t firstCell, const Luminaire& lamp)
  {
    emission_.luminaireOfCell.resize(firstCell, Emission::kNone);
    emission_.luminaireOfCell.resize(
      material_.numberOfCells, static_cast<std::uint32_t>(emission_.luminaires.size()));
    emission_.luminaires.push_back(lamp);
  }

  std::vector<Triangle> triangles_;
  Material material_;
  Emission emission_;
  std::vector<double> specular_, exponents_;
  bool isSpecular_ = false;
};

/// Shines mostly below itself and to the one side, to x, of which 0 is the middle, and less to y
/// than to -y; if `isAllAround` also up.
inline Luminaire lopsidedLamp(const std::vector<double>& flux, bool isAllAround = false)
{
  const std::vector<double> down{ 3, 4, 2, 0.5, 3, 2, 1, 0, 3, 1, 0.5, 0, 3, 3, 1.5, 0.5, 3, 4, 2,
    0.5 };
  const std::vector<double> polar =
    isAllAround ? std::vector<double>{ 0, 60, 120, 180 } : std::vector<double>{ 0, 30, 60, 90 };
  const std::vector<double> azimuths{ 0, 90, 180, 270, 360 };
  return { std::make_shared<DirectionTable>(polar, azimuths, down), -Vector3::UnitZ(),
    Vector3::UnitX(), flux, {} };
}

inline Box box(const Vector3& lower, const Vector3& upper)
{
  return { lower, upper };
}

inline AffineMap shift(const Vector3& by)
{
  return { Matrix3::Identity(), by };
}

/// Its front is the mirror image of what it was, where its pose is mirrored.
inline SceneObject mirrored(SceneObject object, const AffineMap& pose)
{
  std::vector<Triangle> triangles;
  for (const Triangle& t : object.mesh().triangles())
  {
    triangles.push_back({ t.a, t.c, t.b });
  }
  object.body = std::make_shared<RigidObject>(TriangleMesh(triangles));
  object.worldFromObject = pose;
  return object;
}

/// An object without triangles.
inline SceneObject nothing(int bands = 1)
{
  return ObjectBuilder(bands).build();
}

}
