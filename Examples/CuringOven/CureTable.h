// SPDX-License-Identifier: BSD-3-Clause
/** What the doses of the parts come to. */
#pragma once

#include "ProductionLine.h"

#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace curingoven
{

/** A row of the table: a part, or all of them. Areas in m2, doses in J/m2. */
struct Cure
{
  std::string Name;
  double Area = 0;
  double MeanDose = 0, LeastDose = 0, MostDose = 0;
  double UnderArea = 0; // its dose is below the least
  double OverArea = 0;  // its dose is above the most
  double OpenArea = 0; // a limit lies within the 95 % interval of its dose, or its error is unknown
};

/** The parts as they come out of vtkRadiantExposureFilter, in the order of ReadParts. */
std::vector<vtkPolyData*> PartsOf(vtkMultiBlockDataSet* scene);

/**
 * Adds the cell arrays `Area` (m2), `HalfWidth` (J/m2: of the 95 % interval of the dose) and `Cure`
 * (-1 under-cured, 0 well, 1 over-cured) to the parts of the scene, and returns a row for each.
 */
std::vector<Cure> Judge(
  vtkMultiBlockDataSet* scene, const std::vector<Part>& parts, const OvenOptions& options);

/** The accuracy within which 95 % of the parts' area is known, see --accuracy. After Judge. */
double ReachedAccuracy(vtkMultiBlockDataSet* scene, const OvenOptions& options);

void PrintTable(const std::vector<Cure>& rows, const OvenOptions& options);

/** Parts.csv and Cells.csv, all digits of all numbers. */
void WriteTables(const std::vector<Cure>& rows, vtkMultiBlockDataSet* scene,
  const std::vector<Part>& parts, const std::string& folder);

}
