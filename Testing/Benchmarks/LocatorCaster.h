#ifndef LocatorCaster_h
#define LocatorCaster_h

#include "Caster.h"
#include "Meshes/TriangleMesh.h"

#include <vtkNew.h>

class vtkStaticCellLocator;

/// VTK's vtkStaticCellLocator.
class LocatorCaster : public Caster
{
public:
  LocatorCaster(std::string name, const irradiance::TriangleMesh& mesh);
  ~LocatorCaster() override;

  void setRays(const std::vector<irradiance::Ray>& rays) override;
  void cast(std::vector<irradiance::Hit>& hits) override;

private:
  struct Segment
  {
    irradiance::Vector3 from, to;
  };

  vtkNew<vtkStaticCellLocator> locator_;
  double length_; ///< from any place in the scene, everything is closer
  std::vector<Segment> segments_;
};

#endif
