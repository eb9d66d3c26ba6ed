// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLuminaireReader.h"

#include "Data/NamedArray.h"
#include "Luminaires/PhotometricFile.h"
#include "Pipeline/FilterRun.h"
#include "Progress/InputError.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <string>

using namespace irradiance;

vtkStandardNewMacro(vtkLuminaireReader);

namespace
{

/// The watts in a unit of the table.
double WattsOf(const PhotometricFile& file, const char* name, double efficacy)
{
  constexpr double most = 683.002; // lm/W, by the definition of the lumen, at 555 nm
  throwIf(!(efficacy >= 0 && efficacy <= most), "LuminousEfficacy is ", efficacy,
    "; 0 to 683.002 lm/W are possible");
  throwIf(!file.isRadiometric() && efficacy == 0, name,
    " gives candela; set LuminousEfficacy, the lumens in a watt of the lamp's light (some 300 for "
    "white LEDs, 683 at 555 nm)");
  return file.isRadiometric() ? 1 : 1 / efficacy;
}

void WriteOpening(const PhotometricFile& file, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  const bool isPoint = file.opening.shape == LuminousOpening::Shape::Point;
  const std::vector<Facet> facets =
    isPoint ? std::vector<Facet>{ { Vector3::Zero() } } : litFacets(file.opening, file.table);
  for (const Facet& facet : facets)
  {
    cells->InsertNextCell(static_cast<int>(facet.size()));
    for (const Vector3& point : facet)
    {
      cells->InsertCellPoint(points->InsertNextPoint(point.data()));
    }
  }
  output->SetPoints(points);
  isPoint ? output->SetVerts(cells) : output->SetPolys(cells);
}

/// Where it is active, vtkTransformPolyDataFilter turns it.
void AddDirection(vtkPolyData* output, const char* name, int attribute, const Vector3& d)
{
  vtkCellData* cells = output->GetCellData();
  const auto array = addArray<vtkDoubleArray>(cells, name, 3, output->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    array->SetTypedTuple(cell, d.data());
  }
  cells->SetActiveAttribute(name, attribute);
}

}

vtkLuminaireReader::vtkLuminaireReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkLuminaireReader::~vtkLuminaireReader()
{
  this->SetFileName(nullptr);
}

int vtkLuminaireReader::CanReadFile(const char* fileName)
{
  return fileName && isPhotometricFile(fileName) ? 1 : 0;
}

int vtkLuminaireReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  return runFilter(this, output, [&] {
    throwIf(!this->FileName || !*this->FileName, "there is no FileName");
    PhotometricFile file = readPhotometricFile(this->FileName, this->LampSet);
    file.table.scale(WattsOf(file, this->FileName, this->LuminousEfficacy));
    if (file.isRadiometric() && this->LuminousEfficacy != 0)
    {
      file.warnings.push_back(std::string(this->FileName) + " gives " + file.unit +
        "; LuminousEfficacy is not needed and has no effect");
    }
    for (const std::string& warning : file.warnings)
    {
      vtkWarningMacro(<< warning);
    }
    WriteOpening(file, output);
    AddDirection(output, "LampAxis", vtkDataSetAttributes::NORMALS, file.table.axis);
    AddDirection(output, "LampReference", vtkDataSetAttributes::VECTORS, file.table.reference);
    vtkFieldData* fields = output->GetFieldData();
    addColumn(fields, "RadiantIntensity", file.table.values);
    addColumn(fields, "PolarAngles", file.table.polar);
    addColumn(fields, "AzimuthAngles", file.table.azimuth);
    addColumn(fields, "Flux", { file.table.flux() });
    addText(fields, "LuminousShape", file.opening.name());
    addText(fields, "IntensityUnit", file.unit);
    addText(fields, "Luminaire", file.luminaire);
    addText(fields, "Manufacturer", file.manufacturer);
  });
}

void vtkLuminaireReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "LuminousEfficacy: " << this->LuminousEfficacy << "\n"
     << indent << "LampSet: " << this->LampSet << "\n";
}
