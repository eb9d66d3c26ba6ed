// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSunSkySource.h"

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"
#include "Daylight/SkyTable.h"
#include "Input/CommaTable.h"
#include "Pipeline/FilterRun.h"
#include "Progress/InputError.h"
#include "Time/TimeKeys.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

using namespace irradiance;

vtkStandardNewMacro(vtkSunSkySource);

namespace
{

/// The light of one time.
struct Daylight
{
  std::string Where; ///< the row of a series; empty: the properties
  double Time;
  double DirectNormal, DiffuseHorizontal;
  SunPosition Sun;
  double DistanceFactor = 1;
};

double IrradianceIn(const CommaTable& table, const std::string& column)
{
  const double value = table.value(column);
  table.failIf(value < 0, ", column ", column, ": ", value, " W/m2; it has to be 0 or more");
  return value;
}

}

class vtkSunSkySource::vtkInternals
{
public:
  void Update()
  {
    if (this->ReadTime == this->Source->GetMTime())
    {
      return;
    }
    this->Rows.clear();
    this->Steps.clear();
    this->Error.clear();
    try
    {
      const char* file = this->Source->GetWeatherFileName();
      this->HasSeries = file && *file;
      if (this->HasSeries)
      {
        this->ReadWeather(file);
      }
    }
    catch (const InputError& error)
    {
      this->Steps.clear();
      this->Error = error.what();
    }
    this->ReadTime = this->Source->GetMTime();
  }

  /// What the properties say, or the row at `time`.
  Daylight LightAt(double time) const
  {
    vtkSunSkySource* s = this->Source;
    if (this->HasSeries)
    {
      const auto after = std::upper_bound(this->Steps.begin(), this->Steps.end(), time);
      return this->Rows[static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(after - this->Steps.begin(), 1) - 1)];
    }
    Daylight light{ "", time, s->DirectNormalIrradiance, s->DiffuseHorizontalIrradiance,
      { s->SunAzimuth, s->SunAltitude } };
    if (s->SunFrom == PlaceAndTime)
    {
      const std::string given = s->DateTime ? s->DateTime : "";
      const auto clock = parseTime(given);
      throwIf(!clock, "DateTime is \"", given, "\"; it has to be a time such as 2024-06-21 12:00");
      this->PlaceSun(*clock, light);
    }
    return light;
  }

  bool HasBounds() const
  {
    double none[6];
    vtkMath::UninitializeBounds(none);
    return !std::equal(none, none + 6, this->Source->Bounds);
  }

  void CheckProperties() const
  {
    const vtkSunSkySource* s = this->Source;
    checkWithin("SunAngularRadius", s->SunAngularRadius, 0, 10);
    checkWithin("North", s->North, -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX);
    checkWithin("GroundReflectance", s->GroundReflectance, 0, 1);
    if (this->HasBounds())
    {
      const double* const box = s->Bounds;
      bool isBox = true;
      std::string values;
      for (int i = 0; i < 6; ++i)
      {
        isBox = isBox && std::abs(box[i]) < 1e30 && box[i - i % 2] < box[i - i % 2 + 1];
        values += " " + text(box[i]);
      }
      throwIf(!isBox,
        "Bounds is" + values +
          "; it has to be xmin, xmax, ymin, ymax, zmin and zmax of a box, or 1 -1 1 -1 1 -1 for "
          "none");
    }
    if (s->SkyModel == CIEGeneral)
    {
      checkWithin("CIEType", s->CIEType, 1, 15);
    }
    if (!this->HasSeries)
    {
      checkWithin("DirectNormalIrradiance", s->DirectNormalIrradiance, 0, VTK_DOUBLE_MAX);
      checkWithin("DiffuseHorizontalIrradiance", s->DiffuseHorizontalIrradiance, 0, VTK_DOUBLE_MAX);
    }
    if (this->HasSeries || s->SunFrom == PlaceAndTime)
    {
      checkWithin("Latitude", s->Latitude, -90, 90);
      checkWithin("Longitude", s->Longitude, -180, 360);
      checkWithin("TimeZone", s->TimeZone, -14, 14);
      return;
    }
    checkWithin("SunAzimuth", s->SunAzimuth, -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX);
    checkWithin("SunAltitude", s->SunAltitude, -90, 90);
  }

  /// In the frame of the scene.
  SkyTable Sky(const Daylight& light) const
  {
    const vtkSunSkySource* s = this->Source;
    const SunPosition sun{ light.Sun.azimuth - s->North, std::max(0., light.Sun.altitude) };
    const double direct = light.Sun.altitude < 0 ? 0 : light.DirectNormal;
    SkyShape shape; // uniform
    shape.isOvercast = s->SkyModel == CIEOvercast;
    if (s->SkyModel == CIEClear || s->SkyModel == CIEGeneral)
    {
      shape = cieSky(s->SkyModel == CIEClear ? 12 : s->CIEType);
    }
    else if (s->SkyModel == Perez && light.DiffuseHorizontal > 0)
    {
      shape = perezSky(direct, light.DiffuseHorizontal, sun.altitude, light.DistanceFactor);
    }
    SkyTable sky = skyTable(shape, sun, light.DiffuseHorizontal);
    throwIf(!sky.note.empty() && light.Where.empty(),
      "SkyModel Perez has no sky for DirectNormalIrradiance ", direct,
      ", DiffuseHorizontalIrradiance ", light.DiffuseHorizontal, " and the sun at an altitude of ",
      sun.altitude, " degrees: ", sky.note, "; choose a CIE sky");
    if (light.Sun.altitude < 0 && light.DiffuseHorizontal > 0)
    {
      sky.note += (sky.note.empty() ? "" : "; ") + std::string("the sun is below the horizon");
    }
    if (s->Ground)
    {
      sky.addGround(s->GroundReflectance / vtkMath::Pi() *
        (light.DiffuseHorizontal + direct * sun.direction()[2]));
    }
    return sky;
  }

  vtkSunSkySource* Source;
  std::string Error{}; ///< why there is no series
  bool HasSeries = false;
  std::vector<double> Steps{}; ///< times of the rows, seconds since the first
  std::vector<Daylight> Rows{};
  vtkMTimeType ReadTime = 0;

private:
  void ReadWeather(const std::string& fileName)
  {
    CommaTable table(fileName, true);
    table.require({ "time", "dni", "dhi" });
    double first = 0;
    while (table.next())
    {
      const std::string& time = table.cell("time");
      const auto clock = parseTime(time);
      table.failIf(!clock, ", column time: \"", time, "\" is no time such as 2024-06-21 12:00");
      first = this->Rows.empty() ? clock->seconds : first;
      table.failIf(!this->Rows.empty() && clock->seconds - first <= this->Steps.back(),
        ": the time ", time, " is not after that of the row before");
      this->Steps.push_back(clock->seconds - first);
      this->Rows.push_back({ table.where(), this->Steps.back(), IrradianceIn(table, "dni"),
        IrradianceIn(table, "dhi"), {} });
      this->PlaceSun(*clock, this->Rows.back());
    }
    throwIf(this->Rows.empty(), "the file ", fileName, " has no row of weather");
  }

  void PlaceSun(const ClockTime& local, Daylight& light) const
  {
    light.Sun = sunPosition(local.seconds - 3600 * this->Source->TimeZone, this->Source->Latitude,
      this->Source->Longitude);
    light.DistanceFactor = distanceFactor(local.dayOfYear);
  }
};

vtkSunSkySource::vtkSunSkySource()
  : Internals(new vtkInternals{ this })
{
  this->SetNumberOfInputPorts(0);
}

vtkSunSkySource::~vtkSunSkySource()
{
  this->SetDateTime(nullptr);
  this->SetWeatherFileName(nullptr);
}

int vtkSunSkySource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Internals->Update(); // what is wrong is said once, when the data are asked for
  uniteTimes(nullptr, 0, outputs, this->Internals->Steps);
  return 1;
}

int vtkSunSkySource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  return runFilter(this, output, [&] {
    this->Internals->Update();
    throwIf(!this->Internals->Error.empty(), this->Internals->Error);
    this->Internals->CheckProperties();
    auto* timeKey = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    const double time = info->Has(timeKey) ? info->Get(timeKey) : 0;
    const Daylight light = this->Internals->LightAt(time);
    const SkyTable sky = this->Internals->Sky(light);
    vtkFieldData* fields = output->GetFieldData();
    addColumn(fields, kSkyRadiance, sky.radiance);
    addColumn(fields, kSkyPolarAngles, sky.polarAngles);
    addColumn(fields, kSkyAzimuths, sky.azimuths);
    const auto toSun =
      SunPosition{ light.Sun.azimuth - this->North, light.Sun.altitude }.direction();
    const auto addNumbers = addTuple<vtkDoubleArray>;
    addNumbers(fields, kSunDirection, { toSun.begin(), toSun.end() });
    addNumbers(fields, kSunIrradiance, { light.Sun.altitude < 0 ? 0 : light.DirectNormal });
    addNumbers(fields, kSunAngularRadius, { this->SunAngularRadius });
    if (this->Internals->HasBounds())
    {
      addNumbers(fields, kSkyBounds, { this->Bounds, this->Bounds + 6 });
    }
    addText(fields, "SkyNote",
      sky.note.empty() || light.Where.empty() ? sky.note : light.Where + ": " + sky.note);
    // As readers of files do: then a dose knows that it has to take the rows.
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), light.Time);
  });
}

void vtkSunSkySource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SkyModel: " << this->SkyModel << "\n"
     << indent << "CIEType: " << this->CIEType << "\n"
     << indent << "DirectNormalIrradiance: " << this->DirectNormalIrradiance << "\n"
     << indent << "DiffuseHorizontalIrradiance: " << this->DiffuseHorizontalIrradiance << "\n"
     << indent << "SunAngularRadius: " << this->SunAngularRadius << "\n"
     << indent << "SunFrom: " << this->SunFrom << "\n"
     << indent << "SunAzimuth: " << this->SunAzimuth << "\n"
     << indent << "SunAltitude: " << this->SunAltitude << "\n"
     << indent << "Latitude: " << this->Latitude << "\n"
     << indent << "Longitude: " << this->Longitude << "\n"
     << indent << "TimeZone: " << this->TimeZone << "\n"
     << indent << "DateTime: " << (this->DateTime ? this->DateTime : "(none)") << "\n"
     << indent << "North: " << this->North << "\n"
     << indent << "Ground: " << this->Ground << "\n"
     << indent << "GroundReflectance: " << this->GroundReflectance << "\n"
     << indent << "WeatherFileName: " << (this->WeatherFileName ? this->WeatherFileName : "(none)")
     << "\n"
     << indent << "Bounds:";
  for (const double value : this->Bounds)
  {
    os << " " << value;
  }
  os << "\n";
}
