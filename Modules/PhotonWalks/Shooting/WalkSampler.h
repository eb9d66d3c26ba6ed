// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkSampler_h
#define irradiance_WalkSampler_h

#include "Lights/LightTable.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/SobolSequence.h"
#include "Shooting/ScatterLanes.h"
#include "Surfaces/Absorption.h"

#include <vector>

namespace irradiance
{

/// The unit direction in which light that comes `from` a point hits a surface, against its normal.
inline Vector3 incomingDirection(const SurfacePoint& point, const Vector3& from)
{
  const Vector3 incoming = (point.position - from).normalized();
  // Points that touch are too close to tell.
  return incoming.dot(point.normal) < 0 ? incoming : Vector3(-point.normal);
}

/// A ray that leaves a triangle, where its walk starts or was reflected.
struct ScatteredRay
{
  std::uint32_t walk, bounce; ///< the segment that begins
  TriangleId id;
  Vector3 weights;  ///< barycentric
  double side;      ///< 1 front, -1 back, 0: that from which `incoming` comes
  Vector3 incoming; ///< matters only if `side` is 0
  Reflection reflection = Reflection::Diffuse;
  /// Where the segment before began; matters only for specular reflection. Its direction follows
  /// from this and the hit, as both follow from what is stored.
  Vector3 from = Vector3::Zero();
};

/**
 * What walks do at their start and at their hits. Knows no scene, so whoever finds the hits may use
 * it. A walk is a pure function of objects, samples, its number and its hits.
 */
class WalkSampler
{
public:
  /// The arguments must outlive the sampler.
  WalkSampler(const SceneObjects& objects, const LightTable& lights, const SobolSequence& samples);

  int bands() const { return bands_; }

  /// The first rays of walks.
  void start(const std::uint32_t* walks, std::size_t count, Ray* rays) const;
  /// The power with which a walk starts; its light decides.
  Power powerOf(std::uint32_t walk) const { return lights_.power(numberOfLight(walk)); }
  /// The light from which a walk starts.
  const Light& lightOf(std::uint32_t walk) const { return lights_[numberOfLight(walk)]; }
  /// The power of every walk, if there is one band.
  Power powerPerWalk() const { return { { lights_.quantaPerWalk() } }; }

  std::uint32_t cellOf(const TriangleId& id) const
  {
    return surfaces_[id.object].cellOfTriangle[id.triangle];
  }
  /// What is reflected in all, in one band.
  double reflectanceOf(std::uint32_t object, std::uint32_t cell) const
  {
    return surfaces_[object].totalReflectance[cell];
  }
  /// Whether walks leave the hits of their segments `bounces`, to survive with `probabilities`.
  /// Appends the places of those that do to `survivors`, each plus `first`.
  void survive(const std::uint32_t* walks, const std::uint32_t* bounces,
    const double* probabilities, std::size_t count, std::uint32_t first,
    std::vector<std::uint32_t>& survivors) const;
  /// How a walk leaves the hit of its segment before `bounce`, given that it survives. `incoming`:
  /// the power of that segment; matters only if there are several bands.
  Reflection reflectionAt(
    const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const
  {
    return surfaces_[hit.object].isSpecular ? chosenReflection(hit, walk, bounce, incoming)
                                            : Reflection::Diffuse;
  }
  bool isSpecular(std::uint32_t object) const { return surfaces_[object].isSpecular; }
  const Material& materialOf(std::uint32_t object) const { return *surfaces_[object].material; }
  /// In world space.
  Triangle triangleOf(const TriangleId& id) const
  {
    const Triangle& triangle = surfaces_[id.object].triangles[id.triangle];
    return id.object == 0 ? triangle : transformed(*surfaces_[id.object].worldFromObject, triangle);
  }
  /// Whether a ray that hits this triangle hits its front.
  bool hitsFront(const Ray& ray, const TriangleId& id) const
  {
    return ray.direction.dot(triangleOf(id).areaVector()) <= 0;
  }

  /// Prefetch what the sampler will read at a hit. prefetchCell() is for later, as it reads what
  /// prefetchTriangle() requested.
  void prefetchTriangle(const Hit& hit) const;
  void prefetchCell(const Hit& hit) const;

private:
  friend class ScatteredRays;

  /// What the sampler reads of an object.
  struct Surface
  {
    const Triangle* triangles;
    const AffineMap* worldFromObject;
    const Material* material;
    const std::uint32_t* cellOfTriangle;
    const double* totalReflectance; ///< one band
    bool isSpecular;
  };

  Reflection chosenReflection(
    const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const;

  std::size_t numberOfLight(std::uint32_t walk) const;

  const LightTable& lights_;
  const SobolSequence& samples_;
  int bands_;
  std::vector<Surface> surfaces_;
};

/// Computes the rays of walks that leave triangles, many side by side.
class ScatteredRays
{
public:
  explicit ScatteredRays(const WalkSampler& sampler)
    : sampler_(sampler)
  {
  }

  /// The ray is written by the time of the next flush(), and to `isFront`, if given, whether the
  /// walk leaves the front.
  void add(const ScatteredRay& leaving, Ray* ray, bool* isFront = nullptr);
  void flush();

private:
  void addDiffuse(const ScatteredRay& leaving, Ray* ray, bool* isFront);
  /// Specular ones are few, and each has a lobe of its own: they are computed one by one.
  bool scatterSpecularly(const ScatteredRay& leaving, Ray& ray) const;

  const WalkSampler& sampler_;
  unsigned count_ = 0;
  ScatterLanes lanes_;
  TriangleId ids_[ScatterLanes::kSize];
  Ray* rays_[ScatterLanes::kSize];
  bool* isFront_[ScatterLanes::kSize];
};

}

#endif
