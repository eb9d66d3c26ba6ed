// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_OutputWriter_h
#define irradiance_OutputWriter_h

#include "Input/SceneReader.h"
#include "IrradianceEngine.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>

class vtkDataObject;
class vtkFieldData;
class vtkMultiBlockDataSet;

namespace irradiance
{

/// Copies the engine's sums to the output of the filter.
class OutputWriter
{
public:
  /// The arguments must outlive the writer. `withErrors`: also writes standard errors.
  /// `withReplicates`: also writes replicatesName() and photonName().
  OutputWriter(const IrradianceEngine& engine, const SceneReader& scene,
    const EngineSettings& settings, bool withErrors, bool withReplicates,
    const CancelPoint& cancelPoint)
    : engine_(engine)
    , scene_(scene)
    , settings_(settings)
    , withErrors_(withErrors)
    , withReplicates_(withReplicates)
    , cancelPoint_(cancelPoint)
    , errors_(engine.errorEstimate())
  {
  }

  void write(const std::vector<InputConnection>& statics,
    const std::vector<InputConnection>& dynamics, vtkMultiBlockDataSet* output) const;

  /// The same blocks and arrays without cells and field data, see PieceRequest.h.
  static void writeEmpty(const std::vector<InputConnection>& statics,
    const std::vector<InputConnection>& dynamics, const EngineSettings& settings, bool withErrors,
    vtkMultiBlockDataSet* output);

private:
  using MakePart = std::function<vtkSmartPointer<vtkPolyData>(const InputPart&)>;

  /// The output of a connection, in the structure of its input.
  static vtkSmartPointer<vtkDataObject> blockOf(
    const InputConnection& connection, const MakePart& makePart);
  static void writeBlocks(const std::vector<InputConnection>& statics,
    const std::vector<InputConnection>& dynamics, const MakePart& makeStatic,
    const MakePart& makeDynamic, vtkMultiBlockDataSet* output);
  void addIrradiance(vtkPolyData* polyData, const PartCells& cells) const;
  /// `suffix`: part of the arrays' names, such as Front.
  void addSide(
    vtkPolyData* polyData, const std::string& suffix, const PartCells& cells, int side) const;
  void addReplicates(
    vtkPolyData* polyData, const std::string& suffix, const PartCells& cells, int side) const;
  void addFieldData(vtkMultiBlockDataSet* output) const;
  void addStatistics(vtkFieldData* fields) const;
  /// W/m2; NaN where it is not known.
  double standardError(const CellSide& cell, int band) const;

  const IrradianceEngine& engine_;
  const SceneReader& scene_;
  const EngineSettings& settings_;
  bool withErrors_, withReplicates_;
  const CancelPoint& cancelPoint_;
  ErrorEstimate errors_;
};

}

#endif
