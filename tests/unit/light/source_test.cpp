// SPDX-License-Identifier: Apache-2.0
#include "kiln/light/source.h"

#include <gtest/gtest.h>

#include "kiln/core/error.h"
#include "kiln/light/irradiance.h"
#include "kiln/light/spherical_harmonics.h"
#include "kiln/parallel/threads.h"
#include "sphere_texels.h"
#include "synthetic.h"

namespace kiln {
namespace {

using Projection = SphereImage::Projection;
using Radiance = std::function<Vec3<double>(const Vec3<double>&)>;

SphereImage empty_sphere(Projection projection, int n, bool node_aligned = false) {
  const auto blank = [](Size size) { return make_layers(size, {"R", "G", "B"}); };
  if (projection == Projection::Cube) {
    return cube_image(std::vector<Layers>(6, blank({n, n})), node_aligned);
  }
  if (projection == Projection::Octahedral) return octahedral_image(blank({n, n}));
  return latlong_image(blank({2 * n, n}));
}

/// Samples that hold a function of direction.
SphereImage sphere_of(SphereImage sphere, const Radiance& radiance) {
  for (size_t i = 0; i < sphere.images.size(); ++i) {
    for (int y = 0; y < sphere.size().height; ++y) {
      for (int x = 0; x < sphere.size().width; ++x) {
        const Vec3<double> value = radiance(sample_direction(sphere, static_cast<int>(i), x, y));
        sphere.images[i].layers[0].plane.at(x, y) = static_cast<float>(value.x);
        sphere.images[i].layers[1].plane.at(x, y) = static_cast<float>(value.y);
        sphere.images[i].layers[2].plane.at(x, y) = static_cast<float>(value.z);
      }
    }
  }
  return sphere;
}

/// Noise, and a sun of one sample.
SphereImage noisy_sphere(SphereImage sphere, float sun) {
  std::uint32_t index = 0;
  for (Layers& image : sphere.images) {
    for (Layer& layer : image.layers) {
      for (int y = 0; y < image.size.height; ++y) {
        for (int x = 0; x < image.size.width; ++x) {
          layer.plane.at(x, y) = static_cast<float>(2 * test::random_unit(3, index++));
        }
      }
    }
  }
  const int at = sphere.size().height / 3;
  sphere.images.back().layers[0].plane.at(at, at) = sun;
  return sphere;
}

struct Sample {
  Vec3<double> direction;
  double solid_angle;
  Vec3<double> radiance;
};

std::vector<Sample> samples_of(const SphereImage& sphere) {
  std::vector<Sample> samples;
  for (size_t i = 0; i < sphere.images.size(); ++i) {
    const Layers& image = sphere.images[i];
    for (int y = 0; y < image.size.height; ++y) {
      for (int x = 0; x < image.size.width; ++x) {
        samples.push_back({sample_direction(sphere, static_cast<int>(i), x, y),
                           sample_solid_angle(sphere, x, y),
                           {image.layers[0].plane.at(x, y), image.layers[1].plane.at(x, y),
                            image.layers[2].plane.at(x, y)}});
      }
    }
  }
  return samples;
}

std::vector<Sample> samples_of_masses(const Layers& masses) {
  return samples_of(latlong_image(masses));
}

template <class Function>
Vec3<double> sum_over(const std::vector<Sample>& samples, const Function& function) {
  Vec3<double> sum{};
  for (const Sample& s : samples) sum += (function(s.direction) * s.solid_angle) * s.radiance;
  return sum;
}

Vec3<double> total_power(const std::vector<Sample>& samples) {
  return sum_over(samples, [](const Vec3<double>&) { return 1.0; });
}

std::vector<SphereImage> all_kinds() {
  std::vector<SphereImage> all;
  for (const int n : {16, 21}) {
    all.push_back(empty_sphere(Projection::Cube, n));
    all.push_back(empty_sphere(Projection::Cube, n, true));
    all.push_back(empty_sphere(Projection::Octahedral, 2 * n - 1));
    all.push_back(empty_sphere(Projection::Octahedral, 2 * n));
  }
  all.push_back(empty_sphere(Projection::LatLong, 33));
  set_up(all.back(), Up::Z);
  all.push_back(empty_sphere(Projection::Octahedral, 32));
  set_up(all.back(), Up::Z);
  return all;
}

TEST(PointMasses, HoldThePowerOfTheSourceToTheTwelfthDigit) {
  for (const SphereImage& kind : all_kinds()) {
    const SphereImage sphere = noisy_sphere(kind, 1e4f);
    const Vec3<double> expected = total_power(samples_of(sphere));
    const Vec3<double> found = total_power(samples_of_masses(point_masses_of(sphere)));
    EXPECT_NEAR(found.x, expected.x, 1e-12 * expected.x);
    EXPECT_NEAR(found.y, expected.y, 1e-12 * expected.y);
    EXPECT_NEAR(found.z, expected.z, 1e-12 * expected.z);
  }
}

/// Greatest error of the harmonics of an order, relative to the mean of the samples.
double harmonic_error(const SphereImage& sphere, int order) {
  std::vector<Vec3<double>> expected(static_cast<size_t>((order + 1) * (order + 1)));
  for (const Sample& s : samples_of(sphere)) {
    const std::vector<double> values = harmonics_at(order, s.direction);
    for (size_t i = 0; i < values.size(); ++i) {
      expected[i] += (values[i] * s.solid_angle) * s.radiance;
    }
  }
  const auto found = project_sh(point_masses_of(sphere), order).coefficients;
  double worst = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    worst = std::max({worst, std::abs(found[i].x - expected[i].x) / expected[0].x,
                      std::abs(found[i].y - expected[i].y) / expected[0].y,
                      std::abs(found[i].z - expected[i].z) / expected[0].z});
  }
  return worst;
}

TEST(PointMasses, HaveTheHarmonicsOfTheSamples) {
  EXPECT_LT(harmonic_error(noisy_sphere(empty_sphere(Projection::Cube, 32), 1e4f), 32), 1e-5);
  for (const SphereImage& kind : all_kinds()) {
    EXPECT_LT(harmonic_error(noisy_sphere(kind, 1e4f), 8), 1e-5);
  }
}

TEST(PointMasses, OfACoarseSourceStillHaveThirtyTwoBands) {
  EXPECT_LT(harmonic_error(noisy_sphere(empty_sphere(Projection::Cube, 2), 100.0f), 32), 1e-5);
}

/// Legendre's polynomial of degree l.
double legendre(int l, double c) {
  double before = 1, value = l == 0 ? 1 : c;
  for (int k = 2; k <= l; ++k) {
    const double next = ((2 * k - 1) * c * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return value;
}

/// GGX with normal = view, times the cosine.
double ggx(double c, double alpha) {
  if (c <= 0) return 0;
  const double base = 0.5 * (1 - c) + alpha * alpha * 0.5 * (1 + c);
  return c / (base * base);
}

// A sun alone is the hardest: nothing averages out.
TEST(PointMasses, CarryBandsUpToTheEdgeOfAFace) {
  constexpr int n = 64;
  const SphereImage sphere = noisy_sphere(empty_sphere(Projection::Cube, n), 1e7f);
  const auto samples = samples_of(sphere), masses = samples_of_masses(point_masses_of(sphere));
  const double power = total_power(samples).x;
  for (const int band : {n / 2, n - 1, n}) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Vec3<double> axis = test::random_direction(11, i);
      const auto zonal = [&](const Vec3<double>& d) { return legendre(band, dot(d, axis)); };
      EXPECT_NEAR(sum_over(masses, zonal).x / power, sum_over(samples, zonal).x / power, 1e-5)
          << "band " << band;
    }
  }
}

TEST(PointMasses, AreFilteredAsTheSamplesAre) {
  const SphereImage sphere = noisy_sphere(empty_sphere(Projection::Cube, 64), 100.0f);
  const auto samples = samples_of(sphere), masses = samples_of_masses(point_masses_of(sphere));
  const double mean = total_power(samples).x / (4 * pi);
  for (const double alpha : {0.1, 1.0}) {
    const double integral =
        sum_over(samples_of(latlong_image(test::constant_environment({512, 256}, 1))),
                 [&](const Vec3<double>& d) { return ggx(d.z, alpha); })
            .x;
    for (std::uint32_t i = 0; i < 12; ++i) {
      const Vec3<double> axis = test::random_direction(5, i);
      const auto lobe = [&](const Vec3<double>& d) { return ggx(dot(d, axis), alpha); };
      EXPECT_NEAR(sum_over(masses, lobe).x / integral / mean,
                  sum_over(samples, lobe).x / integral / mean, 1e-5)
          << "alpha " << alpha;
    }
  }
}

TEST(PointMasses, WeighAConstantAsItsOwnRadiance) {
  const SphereImage sphere = sphere_of(empty_sphere(Projection::Cube, 20), [](const Vec3<double>&) {
    return Vec3<double>{1, 1, 1};
  });
  const Layers masses = point_masses_of(sphere);
  for (int y = 0; y < masses.size.height; ++y) {
    for (int x = 0; x < masses.size.width; ++x) {
      ASSERT_EQ(masses.find("W")->at(x, y), masses.find("R")->at(x, y));
    }
  }
  const std::vector<Vec3<double>> normals = {
      {0, 1, 0}, {1, 0, 0}, normalize(Vec3<double>{1, 2, 3})};
  for (const Vec3<double>& irradiance : normalised_irradiance(masses, normals)) {
    EXPECT_NEAR(irradiance.x, 1, 1e-12);
  }
}

TEST(PointMasses, DoNotDependOnThreads) {
  const SphereImage sphere = noisy_sphere(empty_sphere(Projection::Octahedral, 41), 1e3f);
  const auto made_with = [&](int threads) {
    const ThreadLimit limit(threads);
    return point_masses_of(sphere);
  };
  const Layers one = made_with(1), two = made_with(2);
  for (size_t c = 0; c < 4; ++c) {
    for (int y = 0; y < one.size.height; ++y) {
      const auto a = one.layers[c].plane.texels_of_row(y), b = two.layers[c].plane.texels_of_row(y);
      ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin()));
    }
  }
}

Vec3<double> smooth_sky(const Vec3<double>& d) {
  return {1 + d.x + 0.3 * d.y * d.z, 2 + d.y - 0.2 * d.x * d.z, 1.5 + 0.5 * d.z + d.x * d.y};
}

double greatest_error(const Layers& latlong, const Radiance& expected) {
  double worst = 0;
  for (int y = 0; y < latlong.size.height; ++y) {
    for (int x = 0; x < latlong.size.width; ++x) {
      const Vec3<double> value = expected(test::texel_direction(latlong.size, x, y));
      worst = std::max({worst, std::abs(latlong.layers[0].plane.at(x, y) - value.x),
                        std::abs(latlong.layers[1].plane.at(x, y) - value.y),
                        std::abs(latlong.layers[2].plane.at(x, y) - value.z)});
    }
  }
  return worst;
}

TEST(Picture, ShowsTheFunctionThatTheSamplesHold) {
  for (const SphereImage& kind : all_kinds()) {
    const Layers picture = picture_of(sphere_of(kind, smooth_sky));
    EXPECT_EQ(picture.size.width, 2 * picture.size.height);
    EXPECT_LT(greatest_error(picture, smooth_sky), 0.04);
  }
}

// Across an edge, texels of neighbouring faces do not lie quite opposite each other.
TEST(Picture, HasErrorsThatFallWithTheSize) {
  for (const bool node_aligned : {false, true}) {
    const auto error = [&](int n) {
      return greatest_error(
          picture_of(sphere_of(empty_sphere(Projection::Cube, n, node_aligned), smooth_sky)),
          smooth_sky);
    };
    EXPECT_LT(error(65), (node_aligned ? 0.3 : 0.6) * error(33));
  }
}

/// Where two faces of a cube meet, or the halves of an edge of a lat-long or octahedral image.
std::vector<Vec3<double>> directions_on_seams() {
  std::vector<Vec3<double>> found;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const double t = 2 * test::random_unit(17, i) - 1;
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        for (const Vec3<double>& d :
             {Vec3<double>{a, b, t}, {a, t, b}, {t, a, b}, {0, a, t}, {t, a, 0}, {0, t, -1}}) {
          found.push_back(normalize(d));
        }
      }
    }
  }
  for (const double y : {-1.0, 1.0}) found.push_back({0, y, 0});
  return found;
}

TEST(Lookups, HaveNoSeams) {
  constexpr double nearby = 1e-9;
  for (const SphereImage& kind : all_kinds()) {
    const bool cube = kind.projection == Projection::Cube;
    const SphereImage sphere =
        cube && kind.node_aligned ? sphere_of(kind, smooth_sky) : noisy_sphere(kind, 5.0f);
    const SphereTexels texels(sphere);
    std::uint32_t index = 0;
    for (const Vec3<double>& d : directions_on_seams()) {
      const Vec3<double> step = nearby * test::random_direction(23, index++);
      const Vec3<double> a = texels.at(normalize(d + step)), b = texels.at(normalize(d - step));
      ASSERT_NEAR(a.x, b.x, 1e-5) << d.x << " " << d.y << " " << d.z;
      ASSERT_NEAR(a.y, b.y, 1e-5) << d.x << " " << d.y << " " << d.z;
    }
  }
}

TEST(Picture, OfALatLongImageThatIsZUpHasItsMiddleOnTop) {
  SphereImage sphere = sphere_of(empty_sphere(Projection::LatLong, 32), smooth_sky);
  set_up(sphere, Up::Z);
  const Layers picture = picture_of(sphere);
  EXPECT_EQ(picture.size, (Size{64, 32}));
  EXPECT_LT(greatest_error(picture,
                           [](const Vec3<double>& d) {
                             return smooth_sky({d.x, -d.z, d.y});
                           }),
            0.02);
}

TEST(AverageFaces, OfTheSameSizeAreTheFaces) {
  const SphereImage cube = noisy_sphere(empty_sphere(Projection::Cube, 12), 1e4f);
  const std::vector<Layers> faces = average_faces(cube, 12);
  for (size_t f = 0; f < 6; ++f) {
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        ASSERT_EQ(faces[f].layers[0].plane.at(x, y), cube.images[f].layers[0].plane.at(x, y));
      }
    }
  }
}

TEST(AverageFaces, KeepThePowerWhateverTheSize) {
  for (const bool node_aligned : {false, true}) {
    const SphereImage cube = noisy_sphere(empty_sphere(Projection::Cube, 24, node_aligned), 1e3f);
    const Vec3<double> expected = total_power(samples_of(cube));
    for (const int size : {1, 5, 8, 12, 23}) {
      const Vec3<double> found = total_power(samples_of(cube_image(average_faces(cube, size))));
      EXPECT_NEAR(found.x, expected.x, 2e-7 * expected.x) << size;
      EXPECT_NEAR(found.y, expected.y, 2e-7 * expected.y) << size;
    }
  }
}

TEST(AverageFaces, WeighTexelsByTheirSolidAngle) {
  const SphereImage cube = noisy_sphere(empty_sphere(Projection::Cube, 6), 1.0f);
  double sum = 0, whole = 0;
  for (int y = 0; y < 3; ++y) {
    for (int x = 3; x < 6; ++x) {
      const double solid_angle = cube_texel_solid_angle(6, x, y);
      sum += solid_angle * cube.images[2].layers[1].plane.at(x, y);
      whole += solid_angle;
    }
  }
  EXPECT_FLOAT_EQ(average_faces(cube, 2)[2].layers[1].plane.at(1, 0), sum / whole);
}

TEST(AverageFaces, OfALargerSizeAreInterpolated) {
  const SphereImage cube = sphere_of(empty_sphere(Projection::Cube, 32), smooth_sky);
  SphereImage larger = cube_image(average_faces(cube, 80));
  double worst = 0;
  for (const Sample& s : samples_of(larger)) {
    worst = std::max(worst, std::abs(s.radiance.x - smooth_sky(s.direction).x));
  }
  EXPECT_LT(worst, 0.01);
}

TEST(Sources, WithoutColourAreRefused) {
  SphereImage cube = empty_sphere(Projection::Cube, 4);
  for (Layers& face : cube.images) face = make_layers({4, 4}, {"R", "G"});
  EXPECT_THROW(picture_of(cube), Error);
  EXPECT_THROW(point_masses_of(cube), Error);
  EXPECT_THROW(average_faces(cube, 2), Error);
}

}  // namespace
}  // namespace kiln
