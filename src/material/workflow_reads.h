// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/material/workflow.h"

namespace kiln {

/// Which slots a workflow reads: the first given one of each list. Where none is given, the
/// constant of the first.
struct WorkflowReads {
  std::vector<Slot> color;
  std::vector<Slot> width;  ///< of the specular lobe
  std::vector<Slot> specular;
  std::vector<Slot> metal;  ///< empty: the workflow has no metalness
};

/// THE table of workflows.
const WorkflowReads& workflow_reads(Workflow workflow);

/// Slots that are read where they are given and mean nothing where they are not.
std::vector<Slot> optional_slots(Workflow workflow, const std::vector<Slot>& given);

/// The lists of a workflow, with those that every workflow reads.
std::vector<std::vector<Slot>> alternatives_of(Workflow workflow);

}  // namespace kiln
