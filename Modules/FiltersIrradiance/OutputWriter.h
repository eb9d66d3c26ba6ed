#ifndef irradiance_OutputWriter_h
#define irradiance_OutputWriter_h

#include "IrradianceEngine.h"
#include "SceneReader.h"

#include <string>

class vtkMultiBlockDataSet;

namespace irradiance
{

/// Copies the engine's sums to the output of the filter.
class OutputWriter
{
public:
  /// The arguments must outlive the writer.
  /// `withErrors`: standard errors are written as well.
  OutputWriter(const IrradianceEngine& engine, const SceneReader& scene,
    const EngineSettings& settings, bool withErrors)
    : engine_(engine)
    , scene_(scene)
    , settings_(settings)
    , withErrors_(withErrors)
    , errors_(engine.errorEstimate())
  {
  }

  void write(const std::vector<InputConnection>& fixed, const std::vector<InputConnection>& moving,
    vtkMultiBlockDataSet* output) const;

private:
  void addIrradiance(vtkPolyData* polyData, std::uint32_t object, std::size_t firstCell) const;
  /// `suffix`: of the arrays' names.
  void addSide(vtkPolyData* polyData, const std::string& suffix, std::uint32_t object,
    std::size_t firstCell, int side) const;
  void addFieldData(vtkMultiBlockDataSet* output) const;
  /// W/m2; NaN where it is not known.
  double standardError(
    std::uint32_t object, std::size_t cell, int side, int band, double area) const;

  const IrradianceEngine& engine_;
  const SceneReader& scene_;
  const EngineSettings& settings_;
  bool withErrors_;
  ErrorEstimate errors_;
};

}

#endif
