// SPDX-License-Identifier: Apache-2.0
#include "kiln/parallel/stages.h"

#include <tbb/parallel_pipeline.h>

namespace kiln {

void run_stages(int count, int at_once, const Stages& stages) {
  struct Piece {
    int index = 0;
    std::shared_ptr<void> held;
  };
  int next = 0;
  const auto first = tbb::make_filter<void, Piece>(tbb::filter_mode::serial_in_order,
                                                   [&](tbb::flow_control& flow) {
                                                     if (next == count) {
                                                       flow.stop();
                                                       return Piece{};
                                                     }
                                                     const int index = next++;
                                                     return Piece{index, stages.first(index)};
                                                   });
  const auto middle = tbb::make_filter<Piece, Piece>(tbb::filter_mode::parallel, [&](Piece piece) {
    stages.middle(piece.index, piece.held.get());
    return piece;
  });
  const auto last = tbb::make_filter<Piece, void>(
      tbb::filter_mode::serial_in_order,
      [&](const Piece& piece) { stages.last(piece.index, piece.held.get()); });
  tbb::parallel_pipeline(static_cast<size_t>(at_once), first & middle & last);
}

}  // namespace kiln
