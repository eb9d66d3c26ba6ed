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
  OutputWriter(
    const IrradianceEngine& engine, const SceneReader& scene, const EngineSettings& settings)
    : engine_(engine)
    , scene_(scene)
    , separateSides_(settings.separateSides)
    , hasBudget_(settings.repairTimeBudget > 0)
  {
  }

  void write(const std::vector<InputConnection>& fixed, const std::vector<InputConnection>& moving,
    vtkIdType numberOfWalks, vtkMultiBlockDataSet* output) const;

private:
  /// IrradianceEngine::irradiance() or one that says as much of a part of it.
  using Part = double (IrradianceEngine::*)(std::uint32_t, std::size_t, int, int, double) const;

  void addIrradiance(vtkPolyData* polyData, std::uint32_t object, std::size_t firstCell) const;
  /// One array, or two for the two sides.
  void addArrays(vtkPolyData* polyData, const std::string& name, Part part, std::uint32_t object,
    std::size_t firstCell) const;
  void addArray(vtkPolyData* polyData, const std::string& name, Part part, std::uint32_t object,
    std::size_t firstCell, int side) const;
  void addFieldData(vtkIdType numberOfWalks, vtkMultiBlockDataSet* output) const;

  const IrradianceEngine& engine_;
  const SceneReader& scene_;
  bool separateSides_;
  bool hasBudget_;
};

}

#endif
