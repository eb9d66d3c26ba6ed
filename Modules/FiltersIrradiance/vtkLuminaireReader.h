// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLuminaireReader
 * @brief   a lamp with its intensity distribution, from an IES or EULUMDAT file
 *
 * Reads photometric files: IES LM-63 of 1986, 1991, 1995, 2002 and 2019 (.ies) and EULUMDAT (.ldt).
 * What is in a file decides, not its name: text with a line that begins with TILT= is IES.
 *
 * @section LuminaireOutput Output
 * The luminous opening, m, with its middle in the origin, as an input of vtkIrradianceFilter: one
 * vertex for a point, else polygons whose front shines. The lamp is aimed at -z. IES: length along
 * x, width along y. EULUMDAT: length along y. Discs have 32 corners, cylinders 16 sides, spheres 96
 * faces. Faces that get no light are left out; flat openings that shine up and down are two faces,
 * 1 mm apart. vtkTransformPolyDataFilter turns the lamp with its light.
 *
 * Field data:
 * - `RadiantIntensity` (W/sr): all polar angles of the first azimuth, then of the second ...
 * - `PolarAngles`, `AzimuthAngles` (degrees): of the table, which is full. One azimuth alone: round.
 * - `Flux` (W): the integral of what is linear in both angles.
 * - `LuminousShape`, `IntensityUnit` (of the file: cd, mW/sr ...), `Luminaire`, `Manufacturer`.
 *
 * Cell data: `LampAxis`, where the polar angle is 0, and `LampReference`, where the azimuth is 0: -z
 * and x for IES type C, which looks along d = (sin V cos H, sin V sin H, -cos V), and EULUMDAT.
 * Type B: V is the azimuth about the axis y, d = (cos H sin V, -sin H, -cos H cos V). Type A: V and H
 * are height and bearing, d = (cos V cos H, -cos V sin H, sin V). There H goes clockwise as seen from
 * above (LM-63-2002); the opening lies as for type C.
 *
 * Where a table has no angles there is no light. Factors of the file count (multiplier, ballast; of
 * a TILT table its value without tilt), lumens of an IES file do not: its table is for its lamps.
 *
 * @section LuminaireErrors Errors
 * Files that are cut off or odd: one error that names the file, the line and the value; the output
 * is empty. Warnings: light that is not as much as the light output ratio of an EULUMDAT file says,
 * several luminaires in one file, LuminousEfficacy without use.
 *
 * Sources: ANSI/IESNA LM-63-2002; Stockmar, EULUMDAT, 1990.
 */

#ifndef vtkLuminaireReader_h
#define vtkLuminaireReader_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSIRRADIANCE_EXPORT vtkLuminaireReader : public vtkPolyDataAlgorithm
{
public:
  static vtkLuminaireReader* New();
  vtkTypeMacro(vtkLuminaireReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// @{
  /** The lamp file. It is read again after Modified(). Default: none, an error. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  /// @}

  /// @{
  /**
   * Lumens in a watt of the lamp's light (not of its electrical power), by which candela become
   * W/sr: some 300 for white LEDs, 683 at 555 nm; Radiance takes 179 for all light. 0: not set, an
   * error if the file gives candela. Files that say W/sr or mW/sr (germicidal lamps do, in
   * [_INTENSITYUNITS] or [TEST]) need none. 0 to 683.002. Default 0.
   */
  vtkSetMacro(LuminousEfficacy, double);
  vtkGetMacro(LuminousEfficacy, double);
  /// @}

  /// @{
  /** Which of the lamps that an EULUMDAT file names are fitted, counted from 0. Default 0. */
  vtkSetClampMacro(LampSet, int, 0, VTK_INT_MAX);
  vtkGetMacro(LampSet, int);
  /// @}

  /// 1 if the file looks like one of a lamp, well or not, else 0.
  virtual int CanReadFile(const char* fileName);

protected:
  vtkLuminaireReader();
  ~vtkLuminaireReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* FileName = nullptr;
  double LuminousEfficacy = 0;
  int LampSet = 0;
};

#endif
