// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "kiln/brdf/fujii.h"

namespace kiln {

/// The full model of Oren and Nayar with its interreflection term; sigma is the roughness [rad].
///
///     f = rho/pi (C1 + cos p C2 tan b + (1 - |cos p|) C3 tan((a + b)/2))
///         + 0.17 rho^2/pi s2 / (s2 + 0.13) (1 - cos p (2 b/pi)^2)
///     C1 = 1 - s2 / (2 (s2 + 0.33)),   C3 = s2 / (8 (s2 + 0.09)) (4 a b / pi^2)^2
///     C2 = 0.45 s2 / (s2 + 0.09) (sin a, less (2 b/pi)^3 where cos p < 0)
///
/// with a, b the greater and lesser of the angles to the normal, p the azimuth between the
/// directions, s2 = sigma^2. tan((a + b)/2) = (sin a + sin b) / (cos a + cos b).
///
/// @valid  color in [0,1], roughness in [0,1]; 0 is Lambert
/// @source Oren and Nayar 1994
template <class F>
struct OrenNayar {
  static constexpr std::string_view name = "oren-nayar";
  static constexpr std::string_view summary = "Oren-Nayar, full; gains a little energy at grazing";
  static constexpr std::string_view source = "Oren & Nayar 1994";
  static constexpr std::array params = {
      color_param, ModelParam{"roughness", 0, 1, 0.5, "deviation of the slope angles [rad]"}};
  static constexpr bool constant_albedo = false;
  static constexpr bool reciprocal = true;
  static constexpr bool has_albedo = true;
  static constexpr bool closed_albedo = false;
  static constexpr double greatest_albedo = 1.0511;  ///< roughness 0.30, grazing

  Vec3<F> color;  ///< rho, reflectance [0..1]
  F roughness;    ///< sigma [rad]

  /// f_r [1/sr], without the cosine.
  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    const F mu_o = clamp(wo.z, F(0), F(1)), mu_i = clamp(wi.z, F(0), F(1));
    const F high = max(mu_o, mu_i), low = min(mu_o, mu_i);
    const F sine_b = safe_sqrt(F(1) - high * high), sine_a = safe_sqrt(F(1) - low * low);
    const F turns_a = atan2(sine_a, low) * F(2 / pi), turns_b = atan2(sine_b, high) * F(2 / pi);
    const F flat = fma(wo.x, wi.x, wo.y * wi.y);
    const F cosine = clamp(flat / max(sine_a * sine_b, F(1e-9)), F(-1), F(1));
    const F away = select(cosine < F(0), turns_b * turns_b * turns_b, F(0));
    const F tan_half = (sine_a + sine_b) / max(high + low, F(1e-9));
    const F retro = cosine * (sine_a - away) * (sine_b / max(high, F(1e-9)));
    const F side = (F(1) - abs(cosine)) * square(turns_a * turns_b) * tan_half;
    const F single = fma(retro_weight(), retro, fma(side_weight(), side, base())) * F(1 / pi);
    const F twice = twice_weight() * fma(-cosine, turns_b * turns_b, F(1)) * F(1 / pi);
    return color * single + color * color * twice;
  }

  /// Reflected share of the light that comes from (or goes to) a direction with cosine mu. The
  /// terms with C1 and C2 and the interreflection in closed form, that with C3 by a fit.
  /// @accuracy 4e-7 absolute
  Vec3<F> albedo(F mu) const {
    const F c = clamp(mu, F(0), F(1)), sine = safe_sqrt(F(1) - c * c);
    const F angle = atan2(sine, c);
    const F single = fma(retro_weight(), retro_albedo(angle, sine, c),
                         fma(side_weight(), side_albedo(angle), base()));
    return color * single + color * color * twice_weight();
  }

 private:
  F variance() const { return roughness * roughness; }
  F base() const { return F(1) - F(0.5) * variance() / (variance() + F(0.33)); }
  F retro_weight() const { return F(0.45) * variance() / (variance() + F(0.09)); }
  F side_weight() const { return F(0.125) * variance() / (variance() + F(0.09)); }
  F twice_weight() const { return F(0.17) * variance() / (variance() + F(0.13)); }

  // (2/pi) INT (2 b/pi)^3 tan b cos t sin t dt
  //   = 2/pi^4 (a^4 - 3 a^2 cos 2a + 3 a sin 2a - 3 sin^2 a), a the angle of the direction.
  static F retro_albedo(F a, F sine, F cosine) {
    const F a2 = a * a, s2 = sine * sine;
    const F sum = fma(a2, a2 - F(3) + F(6) * s2, fma(F(6) * a, sine * cosine, F(-3) * s2));
    return F(2 / (pi * pi * pi * pi)) * sum;
  }

  // (2 - 4/pi) (2 a/pi)^2 INT (2 t/pi)^2 tan((a + t)/2) sin t cos t dt; the integral as
  // P(d) + Q(d) ln d with d = pi/2 - a.
  static F side_albedo(F a) {
    const F d = max(F(pi / 2) - a, F(1e-12));
    const F p =
        fma(d,
            fma(d, fma(d, fma(d, F(-0.0525884484904), F(-1.64257174278)), F(-1.36008772246)),
                F(2.33178643904)),
            F(0.883625251452));
    const F q = d * fma(d, fma(d, F(0.662642388527), F(2.69507384041)), F(2.00180110558));
    return F(2 - 4 / pi) * square(a * F(2 / pi)) * fma(q, log(d), p);
  }
};

}  // namespace kiln
