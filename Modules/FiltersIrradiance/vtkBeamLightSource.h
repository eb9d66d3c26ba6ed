// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBeamLightSource
 * @brief   spots and floodlights, LEDs and ring lights from the angles or the exponent of their beam
 *
 * For lamps of which no file is at hand. The beam is round, brightest in its middle, and has no
 * light beyond 90 degrees. At the angle t from its axis the intensity is, with BeamFrom
 *
 * - Angles: I0 exp(-ln 2 (t / b)^p), b = BeamAngle / 2, with p such that it is I0 / 10 at
 *   FieldAngle / 2; if FieldAngle is 0, I0 cos^n t, with n such that it is I0 / 2 at b;
 * - CosinePower: I0 cos^n t, n = Exponent. 1: Lambert's law, 0: the same in all directions.
 *
 * BeamAngle and FieldAngle are the full angles between the directions of half, and of a tenth of,
 * the intensity of the middle (ANSI/IES LS-1, ANSI C78.379). Some catalogues give the field angle
 * of floodlights as their beam spread.
 *
 * The output is for port 0 or 1 of vtkIrradianceFilter. It has the field data and cell arrays of
 * vtkLuminaireReader; each lamp is a point or a polygon that shines from its front. Of the light of
 * its table, linear between the angles, less than .1 % is elsewhere than the formula has it.
 *
 * Lamps of a ring have equal distances. The first one is from Center towards the x axis, as far as
 * this is across Direction (if Direction is along x: towards y), the others follow
 * counter-clockwise for one who looks along Direction.
 *
 * Values that are out of range are one error that names property and value; the output is empty.
 */

#ifndef vtkBeamLightSource_h
#define vtkBeamLightSource_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSIRRADIANCE_EXPORT vtkBeamLightSource : public vtkPolyDataAlgorithm
{
public:
  static vtkBeamLightSource* New();
  vtkTypeMacro(vtkBeamLightSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What says how the intensity falls with the angle from the axis.
  enum BeamSources
  {
    Angles = 0,     ///< BeamAngle and FieldAngle
    CosinePower = 1 ///< Exponent
  };

  /// @{
  /** W of all lamps together, 0 or more. Default 1. */
  vtkSetMacro(Flux, double);
  vtkGetMacro(Flux, double);
  /// @}

  /// @{
  /** See BeamSources. Default Angles. */
  vtkSetClampMacro(BeamFrom, int, Angles, CosinePower);
  vtkGetMacro(BeamFrom, int);
  void SetBeamFromToAngles() { this->SetBeamFrom(Angles); }
  void SetBeamFromToCosinePower() { this->SetBeamFrom(CosinePower); }
  /// @}

  /// @{
  /**
   * Degrees, both full angles: BeamAngle 0.01 to 179.9, default 60; FieldAngle more than that, to
   * 180, or 0, the default: a power of the cosine. Exponent: of the cosine, 0 to 1e6, default 1.
   */
  vtkSetMacro(BeamAngle, double);
  vtkGetMacro(BeamAngle, double);
  vtkSetMacro(FieldAngle, double);
  vtkGetMacro(FieldAngle, double);
  vtkSetMacro(Exponent, double);
  vtkGetMacro(Exponent, double);
  /// @}

  /// @{
  /**
   * The middle of the lamp, or of the ring, m (default: the origin), where the light goes, of any
   * length but 0 (default 0 0 -1), and the radius of the luminous opening, m: a disc across the axis
   * of the lamp, as a polygon of 32 corners that has its area. 0, the default: a point.
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  /// @}

  /// @{
  /**
   * How many lamps, 1 to 100000 (default 1), stand in a ring of RingRadius, m (default 0). Each
   * leans by Tilt, -180 to 180 degrees (default 0), from Direction towards the axis of the ring:
   * they meet in the point RingRadius / tan(Tilt) before Center.
   */
  vtkSetMacro(NumberOfLamps, int);
  vtkGetMacro(NumberOfLamps, int);
  vtkSetMacro(RingRadius, double);
  vtkGetMacro(RingRadius, double);
  vtkSetMacro(Tilt, double);
  vtkGetMacro(Tilt, double);
  /// @}

protected:
  vtkBeamLightSource();

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int BeamFrom = Angles, NumberOfLamps = 1;
  double Flux = 1, BeamAngle = 60, FieldAngle = 0, Exponent = 1;
  double Center[3] = { 0, 0, 0 }, Direction[3] = { 0, 0, -1 };
  double Radius = 0, RingRadius = 0, Tilt = 0;

private:
  void CheckProperties() const;
};

#endif
