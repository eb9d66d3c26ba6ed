#ifndef Caster_h
#define Caster_h

#include "Geometry/Ray.h"

#include <string>
#include <utility>
#include <vector>

/// A rival: something that finds the closest hits of many rays.
class Caster
{
public:
  explicit Caster(std::string name)
    : name_(std::move(name))
  {
  }
  virtual ~Caster() = default;
  Caster(const Caster&) = delete;
  Caster& operator=(const Caster&) = delete;

  const std::string& name() const { return name_; }

  /// Brings the rays into the form that the rival takes; this is not timed.
  virtual void setRays(const std::vector<irradiance::Ray>& rays) = 0;
  /// Sets hits[i] for the i-th ray; this is timed. Only the distance is compared: what the numbers in
  /// the id mean is the rival's own affair.
  virtual void cast(std::vector<irradiance::Hit>& hits) = 0;

private:
  std::string name_;
};

#endif
