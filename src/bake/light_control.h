// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kiln/light/control_lobes.h"
#include "kiln/math/frame.h"

namespace kiln {

/// What a texel reflects, nearly, as lobes whose light is known (ControlLobes): a control variate.
///
/// An estimate samples only what the texel reflects beyond it,
///
///     L = INT f L cos dw = INT (f cos - g) L dw + INT g L dw,
///
/// and the last term is known. Any g leaves the estimate unbiased; the nearer g is to f cos, the
/// less noise is left.
template <class F>
struct LightControl {
  Vec3<F> specular, diffuse;  ///< reflectances of the two parts
  LobeMixture<F> lobe;
  CosineMixture<F> cosine;

  /// g toward the unit direction w in the shading frame [1/sr].
  Vec3<F> toward(const Vec3<F>& w) const { return specular * lobe(w) + diffuse * cosine(w); }

  /// INT g L dw.
  Vec3<F> light() const { return specular * lobe.light + diffuse * cosine.light; }
};

/// g = 0.
template <class F>
LightControl<F> no_control() {
  const Vec3<F> none{F(0), F(0), F(0)}, up{F(0), F(0), F(1)};
  const AxesAround<F> around{{up, up, up, up}, {F(0), F(0), F(0), F(0)}};
  return {none, none, {around, {F(1), F(1)}, {F(0), F(0)}, none}, {around, none}};
}

template <class F>
void turn_into(const Frame<F>& frame, AxesAround<F>& around) {
  for (Vec3<F>& axis : around.axes) axis = frame.to_local(axis);
}

/// The lobe of ControlLobes that is like a texel's: around the mirror direction, drawn toward the
/// normal the more the wider it is, and narrower as it is across when seen from the side. Of the
/// variance of a lobe under a constant light it leaves 0.02 at 15 degrees from the normal, 0.04 at
/// 30, 0.08 at 45 and 0.2 at 60, or less, whatever its width.
/// Beyond 60 degrees, below the narrowest lobe that there is and with growing anisotropy, specular
/// light is left to the samples by and by.
/// @param wo        to the viewer, in the shading frame
/// @param specular  reflectance of the lobe toward wo
/// @param diffuse   all else that is reflected
template <class F>
LightControl<F> make_light_control(const ControlLobes& lobes, const Frame<F>& frame,
                                   const Vec3<F>& wo, F alpha_x, F alpha_y, const Vec3<F>& specular,
                                   const Vec3<F>& diffuse) {
  LightControl<F> control;
  const F alpha = sqrt(alpha_x * alpha_y), like = alpha * sqrt(wo.z);
  const F roundness = min(alpha_x, alpha_y) / max(alpha_x, alpha_y);
  const F usable =
      select(like > F(0.7 * ControlLobes::least_alpha), roundness * min(F(2) * wo.z, F(1)), F(0));
  const F mirrored = F(1) - alpha * sqrt(alpha);
  const Vec3<F> axis{-mirrored * wo.x, -mirrored * wo.y, fma(mirrored, wo.z - F(1), F(1))};
  control.lobe = lobes.lobes(frame.to_world(normalize(axis)), like);
  control.cosine = lobes.cosines(frame.z);
  turn_into(frame, control.lobe.around);
  turn_into(frame, control.cosine.around);
  control.specular = specular * usable;
  control.diffuse = diffuse;
  return control;
}

}  // namespace kiln
