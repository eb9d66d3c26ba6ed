#ifndef irradiance_OutputWriter_h
#define irradiance_OutputWriter_h

#include "IrradianceEngine.h"
#include "SceneReader.h"

class vtkMultiBlockDataSet;

namespace irradiance
{

/// Copies the engine's sums to the output of the filter.
class OutputWriter
{
public:
  /// The arguments must outlive the writer.
  OutputWriter(const IrradianceEngine& engine, const SceneReader& scene, bool separateSides)
    : engine_(engine)
    , scene_(scene)
    , separateSides_(separateSides)
  {
  }

  void write(const std::vector<InputConnection>& fixed, const std::vector<InputConnection>& moving,
    vtkIdType numberOfWalks, vtkMultiBlockDataSet* output) const;

private:
  void addIrradiance(vtkPolyData* polyData, std::uint32_t object, std::size_t firstCell) const;
  void addArray(vtkPolyData* polyData, const char* name, std::uint32_t object,
    std::size_t firstCell, int side) const;
  void addFieldData(vtkIdType numberOfWalks, vtkMultiBlockDataSet* output) const;

  const IrradianceEngine& engine_;
  const SceneReader& scene_;
  bool separateSides_;
};

}

#endif
