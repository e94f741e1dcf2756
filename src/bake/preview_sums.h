// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kiln/image/layers.h"

namespace kiln {

/// What is to be told of a picture, all over the pixels that are shown.
struct PictureFacts {
  double mean_samples = 0, most_samples = 0;  ///< of a pixel
  double mean_error = 0;                      ///< mean standard error
  double above_target = 0;   ///< share of the pixels in blocks that miss the error asked for
  double mean_radiance = 0;  ///< of the reference
  double lost = 0;           ///< of glass: share of the light that no path carries out [0..1]
  double trapped = 0;  ///< of glass: share of the light on paths that were ended inside [0..1]
  double mean_difference = 0, rms_difference = 0, greatest_difference = 0;
};

/// Sums over a picture that may be made a band of rows at a time: each row has its own, so that the
/// facts are the same to the bit however many rows are made together, and in which order. Bands may
/// be added from many threads at once; they begin where blocks of pixels do.
class PictureSums {
 public:
  /// @param target_error  that blocks were to reach; 0: none
  PictureSums(Size picture, double target_error);

  /// @param first  row of the picture that the band begins with
  /// @param rows   planes of make_sampled_image
  void add_reference(int first, const Layers& rows);
  /// Planes R G B A of what is left.
  void add_difference(int first, const Layers& rows);
  /// Of glass.
  /// @param carried, trapped  share of each pixel's light on paths that left, and on those of them
  ///                          that were ended inside
  void add_glass(int first, const Layers& rows, const Plane& carried, const Plane& trapped);

  PictureFacts facts() const;

 private:
  struct Row {
    double shown = 0, radiance = 0, error = 0, samples = 0, most = 0, above = 0;
    double carried = 0, trapped = 0, difference = 0, squares = 0, greatest = 0;
  };
  double target_error_;
  std::vector<Row> rows_;
};

}  // namespace kiln
