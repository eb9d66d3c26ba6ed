// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSunSkySource
 * @brief   sun and sky as a lamp around the scene, from a sky model or a series of weather
 *
 * The output has no points and no cells. Its field data are a table of the radiance that comes from
 * afar, and the sun. The scene's z axis points up, its y axis to the north (see North), its x axis
 * to the east:
 *
 * | field | components | what it is |
 * |---|---|---|
 * | `SkyRadiance` | 1 | W/m2/sr, all polar angles of the first azimuth first; bilinear between |
 * | `SkyPolarAngles` | 1 | degrees from the zenith, 0..180; one that is given twice is a jump |
 * | `SkyAzimuths` | 1 | degrees from the y axis over the x axis, 0..360; one: round |
 * | `SunDirection` | 3 | the unit vector towards the sun |
 * | `SunIrradiance` | 1 | W/m2 on a plane across; 0 while the sun is below the horizon |
 * | `SunAngularRadius` | 1 | degrees; 0: a point at infinity |
 * | `SkyBounds` | 6 | Bounds, if they are set: xmin, xmax, ymin, ymax, zmin, zmax |
 * | `SkyNote` | 1 | a text, if anything was changed to get a sky; see below |
 *
 * DirectNormalIrradiance and DiffuseHorizontalIrradiance say how much light there is, SkyModel how
 * the diffuse light is spread. A free horizontal plane gets exactly the diffuse horizontal
 * irradiance from the table, a vertical plane within .2 % of what the model itself would bring.
 * Below the horizon is a ground, unless GroundOff.
 *
 * The sun stands where SunAzimuth and SunAltitude say, or where Michalsky's formula (Solar Energy
 * 40:227, 1988) finds it at a place and time, without refraction (half a degree at the horizon),
 * within .01 degrees from 1950 to 2050. While it is below the horizon, DirectNormalIrradiance
 * counts as 0, and models that need a sun have it at the horizon; SkyNote says so if there is
 * diffuse light. Without diffuse light the sky is black.
 *
 * @section WeatherFile Weather
 * Comma-separated values. The first line names the columns, in any order and any case; others,
 * empty lines and those that begin with # are passed over. The times have to increase.
 * - `time`: local time (TimeZone), as in `2024-06-21 12:00` or `2024-06-21T12:00:30`;
 * - `DNI`, `DHI`: direct normal and diffuse horizontal irradiance, W/m2.
 *
 * TIME_STEPS are the rows, in seconds since the first. At UPDATE_TIME_STEP there is the last row
 * that is not later, before the first row that one; without it the first. DATA_TIME_STEP is the
 * row's own time, so a dose takes the rows, as of files. The sun is found for the time of the row:
 * where rows are means over an hour, let their times be the middles.
 *
 * @section SkyErrors Errors
 * Values that are not finite or out of range are one error that names the property, or file, line
 * and column, and the value; the output is empty. For some rare input the model of Perez grows
 * without limit towards the horizon (b > 0), or is negative in places. This is an error, too, but a
 * row of a series has b = 0 or a radiance of 0 there, its diffuse horizontal irradiance all the
 * same, and a SkyNote.
 *
 * Sources: CIE S 011 / ISO 15469:2004; Perez, Seals, Michalsky, Solar Energy 50:235, 1993, with the
 * erratum 51:423. Theory: "Sun and sky".
 */

#ifndef vtkSunSkySource_h
#define vtkSunSkySource_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // For the internals

class VTKFILTERSIRRADIANCE_EXPORT vtkSunSkySource : public vtkPolyDataAlgorithm
{
public:
  static vtkSunSkySource* New();
  vtkTypeMacro(vtkSunSkySource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How the diffuse light is spread over the sky.
  enum SkyModels
  {
    Uniform = 0,     ///< one radiance
    CIEOvercast = 1, ///< CIE's traditional overcast sky (type 16): three times brighter at the top
    CIEClear = 2,    ///< type 12 of the CIE general sky
    CIEGeneral = 3,  ///< type CIEType of the CIE general sky
    Perez = 4        ///< the all-weather sky, which follows from both irradiances and the sun
  };

  /// What says where the sun is.
  enum SunSources
  {
    Angles = 0,      ///< SunAzimuth and SunAltitude
    PlaceAndTime = 1 ///< Latitude, Longitude, TimeZone and DateTime
  };

  /// @{
  /** See SkyModels. Default Perez. */
  vtkSetClampMacro(SkyModel, int, Uniform, Perez);
  vtkGetMacro(SkyModel, int);
  void SetSkyModelToUniform() { this->SetSkyModel(Uniform); }
  void SetSkyModelToCIEOvercast() { this->SetSkyModel(CIEOvercast); }
  void SetSkyModelToCIEClear() { this->SetSkyModel(CIEClear); }
  void SetSkyModelToCIEGeneral() { this->SetSkyModel(CIEGeneral); }
  void SetSkyModelToPerez() { this->SetSkyModel(Perez); }
  /// @}

  /// @{
  /** The type of the CIE general sky, 1 to 15, of SkyModel CIEGeneral. Default 12. */
  vtkSetMacro(CIEType, int);
  vtkGetMacro(CIEType, int);
  /// @}

  /// @{
  /**
   * W/m2, 0 or more: sunlight on a plane across it (DNI, default 0), and the light of the sky on a
   * horizontal plane (DHI, default 100).
   */
  vtkSetMacro(DirectNormalIrradiance, double);
  vtkGetMacro(DirectNormalIrradiance, double);
  vtkSetMacro(DiffuseHorizontalIrradiance, double);
  vtkGetMacro(DiffuseHorizontalIrradiance, double);
  /// @}

  /// @{
  /** See SunSources. With a WeatherFileName the place and the time of the row. Default Angles. */
  vtkSetClampMacro(SunFrom, int, Angles, PlaceAndTime);
  vtkGetMacro(SunFrom, int);
  void SetSunFromToAngles() { this->SetSunFrom(Angles); }
  void SetSunFromToPlaceAndTime() { this->SetSunFrom(PlaceAndTime); }
  /// @}

  /// @{
  /**
   * Degrees: from north over east (90: in the east; default 180, in the south); over the horizon
   * (-90 to 90, default 45); the radius of the sun's disc (0 to 10, default 0.2666; 0: a point);
   * the azimuth of the scene's y axis (default 0).
   */
  vtkSetMacro(SunAzimuth, double);
  vtkGetMacro(SunAzimuth, double);
  vtkSetMacro(SunAltitude, double);
  vtkGetMacro(SunAltitude, double);
  vtkSetMacro(SunAngularRadius, double);
  vtkGetMacro(SunAngularRadius, double);
  vtkSetMacro(North, double);
  vtkGetMacro(North, double);
  /// @}

  /// @{
  /**
   * Degrees, north positive (-90 to 90) and east positive (-180 to 360); by how many hours local
   * time is ahead of UT (-7: mountain time; -14 to 14); default 0 each. Local time, as
   * 2024-06-21 12:00 or 2024-06-21 12:00:30, of 1901 to 2099; default: none.
   */
  vtkSetMacro(Latitude, double);
  vtkGetMacro(Latitude, double);
  vtkSetMacro(Longitude, double);
  vtkGetMacro(Longitude, double);
  vtkSetMacro(TimeZone, double);
  vtkGetMacro(TimeZone, double);
  vtkSetStringMacro(DateTime);
  vtkGetStringMacro(DateTime);
  /// @}

  /// @{
  /**
   * Whether light comes from below the horizon (default on): from an endless ground in full sun and
   * sky, of radiance GroundReflectance (DHI + DNI sin(altitude)) / pi; 0 to 1, default 0.2.
   */
  vtkSetMacro(Ground, vtkTypeBool);
  vtkGetMacro(Ground, vtkTypeBool);
  vtkBooleanMacro(Ground, vtkTypeBool);
  vtkSetMacro(GroundReflectance, double);
  vtkGetMacro(GroundReflectance, double);
  /// @}

  /// @{
  /**
   * A series of weather (.csv), see above, instead of DirectNormalIrradiance,
   * DiffuseHorizontalIrradiance, SunFrom and DateTime; null or empty: none. It is read again after
   * Modified(). Default: none.
   */
  vtkSetFilePathMacro(WeatherFileName);
  vtkGetFilePathMacro(WeatherFileName);
  /// @}

  /// @{
  /**
   * The box that the light enters, xmin, xmax, ymin, ymax, zmin, zmax, m: all of the scene has to
   * stay inside, wherever it moves. Default 1, -1, 1, -1, 1, -1, which is no box: then filters take
   * the bounds of what is static, and a tenth of their diagonal on all sides.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  /// @}

protected:
  vtkSunSkySource();
  ~vtkSunSkySource() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int SkyModel = Perez, CIEType = 12, SunFrom = Angles;
  double DirectNormalIrradiance = 0, DiffuseHorizontalIrradiance = 100;
  double SunAzimuth = 180, SunAltitude = 45, SunAngularRadius = 0.2666, North = 0;
  double Latitude = 0, Longitude = 0, TimeZone = 0;
  vtkTypeBool Ground = true;
  double GroundReflectance = 0.2;
  char *DateTime = nullptr, *WeatherFileName = nullptr;
  double Bounds[6] = { 1, -1, 1, -1, 1, -1 };

private:
  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
