// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkFront.h"

namespace irradiance
{

void WalkFront::reserve(std::size_t walks, int bands)
{
  for (FrontColumn<double>* column : { &originX, &originY, &originZ, &distance })
  {
    column->reserve(walks);
  }
  for (FrontColumn<float>* column : { &directionX, &directionY, &directionZ, &weightB, &weightC })
  {
    column->reserve(walks);
  }
  for (FrontColumn<std::uint32_t>* column : { &start, &hit, &candidate, &walk, &bounce, &block })
  {
    column->reserve(walks);
  }
  for (FrontColumn<std::uint16_t>* column : { &slot, &parent })
  {
    column->reserve(walks);
  }
  for (FrontColumn<std::uint8_t>* column : { &side, &hitSide, &isSpecular })
  {
    column->reserve(walks);
  }
  survivors.reserve(walks / kGroup + 1);
  for (int band = 0; bands > 1 && band < bands; ++band)
  {
    power[band].reserve(walks);
  }
}

void WalkFront::pad()
{
  for (std::size_t i = size; i % kGroup != 0; ++i)
  {
    originX[i] = originY[i] = originZ[i] = 0;
    directionX[i] = directionY[i] = directionZ[i] = 0;
    start[i] = hit[i] = kNone;
    side[i] = hitSide[i] = 1;
    weightB[i] = weightC[i] = 0;
    walk[i] = walk[0];
    bounce[i] = bounce[0]; // so that the group has one
  }
}

FrontPair& FrontPair::ofThread()
{
  static thread_local FrontPair fronts;
  return fronts;
}

}
