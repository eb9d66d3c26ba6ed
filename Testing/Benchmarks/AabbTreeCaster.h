#ifndef AabbTreeCaster_h
#define AabbTreeCaster_h

#include "Caster.h"
#include "Meshes/TriangleMesh.h"

#include <memory>

/// CGAL's AABB_tree over Simple_cartesian<double>, its fastest kernel.
class AabbTreeCaster : public Caster
{
public:
  AabbTreeCaster(std::string name, const irradiance::TriangleMesh& mesh);
  ~AabbTreeCaster() override;

  void setRays(const std::vector<irradiance::Ray>& rays) override;
  void cast(std::vector<irradiance::Hit>& hits) override;

private:
  struct Tree; ///< keeps CGAL in one file
  std::unique_ptr<Tree> tree_;
};

#endif
