#ifndef EmbreeCaster_h
#define EmbreeCaster_h

#include "Caster.h"
#include "EmbreeScene.h"

#include <memory>

enum class RaysPerCall
{
  One = 1,
  Eight = 8,
  Sixteen = 16
};

/// rtcIntersect1, 8 or 16, told that the rays are incoherent: with the other flag packets of photon
/// rays are two to four times slower.
class EmbreeCaster : public Caster
{
public:
  EmbreeCaster(std::string name, std::shared_ptr<const EmbreeScene> scene, RaysPerCall raysPerCall);

  void setRays(const std::vector<irradiance::Ray>& rays) override;
  void cast(std::vector<irradiance::Hit>& hits) override;

private:
  struct FloatRay
  {
    float origin[3], direction[3];
  };

  template <typename Packet, typename Intersect>
  void castPackets(Intersect intersect, std::vector<irradiance::Hit>& hits) const;
  void castOneByOne(std::vector<irradiance::Hit>& hits) const;

  std::shared_ptr<const EmbreeScene> scene_;
  RaysPerCall raysPerCall_;
  std::vector<FloatRay> rays_;
};

/// Tells the processor to take denormal numbers for zero in this thread, as Embree's manual advises.
void flushDenormals();

#endif
