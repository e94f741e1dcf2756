// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

namespace kiln {

/// Pieces on their way through three stages, side by side: `first(i)` is called in order and one at
/// a time, `middle` in any order on all threads, `last` in order and one at a time again. At most
/// `at_once` pieces are on their way.
///
/// An exception of any stage ends all and is rethrown here.
struct Stages {
  std::function<std::shared_ptr<void>(int)> first;
  std::function<void(int, void*)> middle, last;
};
void run_stages(int count, int at_once, const Stages& stages);

/// The same for pieces of one type.
template <class Piece, class First, class Middle, class Last>
void run_stages(int count, int at_once, First first, Middle middle, Last last) {
  run_stages(count, at_once,
             {[&](int i) -> std::shared_ptr<void> { return std::make_shared<Piece>(first(i)); },
              [&](int i, void* piece) { middle(i, *static_cast<Piece*>(piece)); },
              [&](int i, void* piece) { last(i, *static_cast<Piece*>(piece)); }});
}

}  // namespace kiln
