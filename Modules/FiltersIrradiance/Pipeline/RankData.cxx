// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/RankData.h"

#include "Pipeline/DataMessage.h"

#include "vtkCharArray.h"
#include "vtkDataObject.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cstdint>

namespace irradiance
{

namespace
{

using Messages = std::vector<vtkSmartPointer<vtkCharArray>>;

void broadcast(vtkCharArray* message, vtkMultiProcessController* controller, int from)
{
  constexpr vtkIdType most = 1 << 30; // MPI counts with an int
  const vtkIdType size = message->GetNumberOfTuples();
  for (vtkIdType begin = 0; begin < size; begin += most)
  {
    controller->Broadcast(message->GetPointer(begin), std::min(most, size - begin), from);
  }
}

/// What can fail is done before a message is on its way: a broadcast has no word for it.
Messages messagesOf(vtkDataObject* own, vtkMultiProcessController* controller, Ranks& ranks)
{
  Messages messages(ranks.count());
  for (auto& message : messages)
  {
    message = vtkSmartPointer<vtkCharArray>::New();
  }
  auto& ours = messages[ranks.rank()];
  ours = own ? messageOf(own) : ours;
  std::vector<std::int64_t> sizes(messages.size());
  sizes[ranks.rank()] = ours->GetNumberOfTuples();
  ranks.sum(sizes.data(), sizes.size());
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    messages[i]->SetNumberOfTuples(static_cast<vtkIdType>(sizes[i]));
  }
  ranks.expectSame(0, "no memory for the data of others");
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    broadcast(messages[i], controller, static_cast<int>(i));
  }
  return messages;
}

}

std::vector<vtkSmartPointer<vtkDataObject>> dataOfRanks(
  vtkDataObject* own, vtkMultiProcessController* controller, Ranks& ranks)
{
  if (!ranks.areSeveral())
  {
    return own ? std::vector<vtkSmartPointer<vtkDataObject>>{ own }
               : std::vector<vtkSmartPointer<vtkDataObject>>{};
  }
  std::vector<vtkSmartPointer<vtkDataObject>> all;
  Messages messages = messagesOf(own, controller, ranks);
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    if (messages[i]->GetNumberOfTuples() > 0)
    {
      all.push_back(i == ranks.rank() ? vtkSmartPointer<vtkDataObject>(own) : dataOf(messages[i]));
    }
    messages[i] = nullptr; // its memory
  }
  return all;
}

}
