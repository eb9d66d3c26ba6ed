// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestScenes.h"

#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

/// Every array of an output, byte for byte, by a name such as "Dynamic 2/cell/Irradiance". Field
/// data count only where they depend on the scene alone, not on the cost of the update.
class OutputBits
{
public:
  explicit OutputBits(vtkDataObject* data)
  {
    if (auto* polyData = vtkPolyData::SafeDownCast(data))
    {
      this->AddBlock("", polyData);
      return;
    }
    auto* output = vtkMultiBlockDataSet::SafeDownCast(data);
    static const char* const names[2] = { "Static ", "Dynamic " };
    for (unsigned int port = 0; port < output->GetNumberOfBlocks(); ++port)
    {
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
      for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
      {
        this->AddLeaves(names[port] + std::to_string(i) + "/", blocks->GetBlock(i));
      }
    }
    static const std::set<std::string> costs{ "NumberOfInvalidWalks", "NumberOfRepairedSegments",
      "ShootSeconds", "VerifySeconds", "RepairSeconds", "HistoryBytes" };
    this->AddArrays("field/", output->GetFieldData(), costs);
  }

  explicit OutputBits(vtkIrradianceFilter* filter)
    : OutputBits(filter->GetOutput())
  {
  }

  bool IsEmpty() const { return this->Arrays.empty(); }

  /// Of all names and bytes (FNV-1a), to compare what two builds compute.
  std::uint64_t Digest() const
  {
    std::uint64_t digest = 0xcbf29ce484222325u;
    const auto add = [&](unsigned char byte) { digest = (digest ^ byte) * 0x100000001b3u; };
    for (const auto& [name, bytes] : this->Arrays)
    {
      std::for_each(name.begin(), name.end(), add);
      std::for_each(bytes.begin(), bytes.end(), add);
    }
    return digest;
  }

  /// Tells which array differs first, and where.
  friend testing::AssertionResult IsSame(const OutputBits& a, const OutputBits& b)
  {
    if (a.Arrays.size() != b.Arrays.size())
    {
      return testing::AssertionFailure()
        << a.Arrays.size() << " arrays against " << b.Arrays.size();
    }
    for (const auto& [name, bytes] : a.Arrays)
    {
      const auto found = b.Arrays.find(name);
      if (found == b.Arrays.end() || found->second.size() != bytes.size())
      {
        return testing::AssertionFailure() << name << " is missing or has another size";
      }
      if (bytes != found->second)
      {
        std::size_t at = 0;
        while (bytes[at] == found->second[at])
        {
          ++at;
        }
        return testing::AssertionFailure()
          << name << " differs from byte " << at << " of " << bytes.size();
      }
    }
    return testing::AssertionSuccess();
  }

private:
  void AddLeaves(const std::string& prefix, vtkDataObject* block)
  {
    auto* tree = vtkDataObjectTree::SafeDownCast(block);
    if (!tree)
    {
      this->AddBlock(prefix, vtkPolyData::SafeDownCast(block));
      return;
    }
    const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      this->AddBlock(prefix + std::to_string(leaves->GetCurrentFlatIndex()) + "/",
        vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()));
    }
  }

  void AddBlock(const std::string& prefix, vtkPolyData* block)
  {
    if (block->GetPoints())
    {
      this->Add(prefix + "points", block->GetPoints()->GetData());
    }
    this->AddArrays(prefix + "point/", block->GetPointData(), {});
    this->AddArrays(prefix + "cell/", block->GetCellData(), {});
  }

  void AddArrays(
    const std::string& prefix, vtkFieldData* data, const std::set<std::string>& excluded)
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      if (excluded.count(data->GetArrayName(i)) == 0)
      {
        this->Add(prefix + data->GetArrayName(i), data->GetAbstractArray(i));
      }
    }
  }

  void Add(const std::string& name, vtkAbstractArray* array)
  {
    if (auto* texts = vtkStringArray::SafeDownCast(array))
    {
      for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
      {
        const std::string text = texts->GetValue(i);
        this->Arrays[name].insert(this->Arrays[name].end(), text.begin(), text.end());
      }
      return;
    }
    const auto* begin = static_cast<const unsigned char*>(array->GetVoidPointer(0));
    const auto bytes = static_cast<std::size_t>(array->GetNumberOfValues()) *
      static_cast<std::size_t>(array->GetDataTypeSize());
    this->Arrays[name].assign(begin, begin + bytes);
  }

  std::map<std::string, std::vector<unsigned char>> Arrays;
};

/// Updates both; whether the first filter has the bits of the other, a new one.
inline testing::AssertionResult UpdatesLike(vtkIrradianceFilter* filter, vtkIrradianceFilter* fresh)
{
  filter->Update();
  fresh->Update();
  return IsSame(OutputBits(filter), OutputBits(fresh));
}
