// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PhotonLocator.h"

#include "Rivals/PhotonMap.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <iterator>
#include <optional>

using irradiance::Sensor;
using irradiance::Vector3;

namespace
{

std::array<float, 3> inFloats(const Vector3& point)
{
  return { static_cast<float>(point[0]), static_cast<float>(point[1]),
    static_cast<float>(point[2]) };
}

/// It finds photons of all surfaces, near in any direction.
class PointLocator : public PhotonLocator
{
public:
  explicit PointLocator(const std::vector<Vector3>& points)
    : points_(points)
  {
  }

  std::vector<double> allSquaredDistances(const Sensor& sensor) const override
  {
    std::vector<double> distances;
    std::transform(points_.begin(), points_.end(), std::back_inserter(distances),
      [&](const Vector3& point) { return (point - sensor.position).squaredNorm(); });
    return distances;
  }

private:
  std::vector<Vector3> points_;
};

class PhotonMapLocator : public PointLocator
{
public:
  PhotonMapLocator(const std::vector<Vector3>& points, double power)
    : PointLocator(points)
  {
    std::transform(
      points.begin(), points.end(), std::back_inserter(photons_), [power](const Vector3& point) {
        return PhotonMap::Photon{ inFloats(point), static_cast<float>(power), {} };
      });
  }

  void build() override { map_.emplace(photons_); }

  void find(const Sensor& sensor, std::size_t count) override
  {
    map_->findNearest(inFloats(sensor.position), count, found_);
  }

  std::vector<double> squaredDistances() const override
  {
    std::vector<double> distances;
    std::transform(found_.begin(), found_.end(), std::back_inserter(distances),
      [](const PhotonMap::Neighbour& neighbour) { return neighbour.squaredDistance; });
    return distances;
  }

private:
  std::vector<PhotonMap::Photon> photons_;
  std::optional<PhotonMap> map_;
  std::vector<PhotonMap::Neighbour> found_;
};

class VtkLocator : public PointLocator
{
public:
  explicit VtkLocator(const std::vector<Vector3>& points)
    : PointLocator(points)
  {
    vtkNew<vtkPoints> own; // in floats
    for (const Vector3& point : points)
    {
      own->InsertNextPoint(point.data());
    }
    photons_->SetPoints(own);
    locator_->SetDataSet(photons_);
  }

  void build() override
  {
    photons_->Modified(); // else it would stay as it is
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ 1, "Sequential", false }, [this] { locator_->BuildLocator(); });
  }

  void find(const Sensor& sensor, std::size_t count) override
  {
    point_ = sensor.position;
    locator_->FindClosestNPoints(static_cast<int>(count), point_.data(), found_);
  }

  std::vector<double> squaredDistances() const override
  {
    std::vector<double> distances;
    for (vtkIdType i = 0; i < found_->GetNumberOfIds(); ++i)
    {
      Vector3 photon;
      photons_->GetPoint(found_->GetId(i), photon.data());
      distances.push_back((photon - point_).squaredNorm());
    }
    return distances;
  }

private:
  vtkNew<vtkPolyData> photons_;
  vtkNew<vtkStaticPointLocator> locator_;
  vtkNew<vtkIdList> found_;
  Vector3 point_;
};

}

std::unique_ptr<PhotonLocator> makePhotonMapLocator(
  const std::vector<Vector3>& points, double power)
{
  return std::make_unique<PhotonMapLocator>(points, power);
}

std::unique_ptr<PhotonLocator> makeVtkLocator(const std::vector<Vector3>& points)
{
  return std::make_unique<VtkLocator>(points);
}
