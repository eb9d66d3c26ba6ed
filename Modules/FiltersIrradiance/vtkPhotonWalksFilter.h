// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPhotonWalksFilter
 * @brief   the stored photon walks of a vtkIrradianceFilter as polylines, to look at
 *
 * The input is the output of a vtkIrradianceFilter, connected or as a shallow copy; that then
 * stores its walks even where nothing can move, and shoots them all if it did not before. Each walk
 * is one polyline in world coordinates, m, from the light to where the photon is absorbed, with the
 * cell arrays
 * - `WalkId`: its number,
 * - `Power` (W), one or three components,
 * - `Repaired`: 1 if the last update shot it, or its tail, again,
 * - `Escaped`: 1 if it leaves the scene; its last point is then outside of the bounds of all,
 * - `Stale`: 1 if a RepairTimeBudget left it for later (only with such a budget),
 *
 * and the point arrays `Bounce`, the number of the point on its walk, and `Repaired`.
 *
 * With several processes each stores all walks, and the first shows them. Input that is no such
 * output, is out of date or lost its photons, and a cell that does not exist, are one error, and an
 * empty output. Progress and AbortExecute as in vtkIrradianceFilter.
 */

#ifndef vtkPhotonWalksFilter_h
#define vtkPhotonWalksFilter_h

#include "vtkFiltersIrradianceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSIRRADIANCE_EXPORT vtkPhotonWalksFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkPhotonWalksFilter* New();
  vtkTypeMacro(vtkPhotonWalksFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// @{
  /** Walks shown at most, those with the lowest numbers; 0 to 4,294,967,295. Default 1000. */
  vtkSetMacro(NumberOfWalks, vtkIdType);
  vtkGetMacro(NumberOfWalks, vtkIdType);
  /// @}

  /// @{
  /**
   * Only walks that touch this cell: its number in connection CellConnection of input port CellPort
   * (0 static, 1 dynamic) of the vtkIrradianceFilter, from leaf to leaf in a composite connection.
   * -1: all walks are meant. No walk touches the cells of a connection that has none. Defaults -1,
   * 0, 0.
   */
  vtkSetMacro(Cell, vtkIdType);
  vtkGetMacro(Cell, vtkIdType);
  vtkSetMacro(CellPort, int);
  vtkGetMacro(CellPort, int);
  vtkSetMacro(CellConnection, int);
  vtkGetMacro(CellConnection, int);
  /// @}

protected:
  vtkPhotonWalksFilter() = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkIdType NumberOfWalks = 1000;
  vtkIdType Cell = -1;
  int CellPort = 0;
  int CellConnection = 0;
};

#endif
