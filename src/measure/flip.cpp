#include "src/measure/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "src/core/parallel.h"
#include "src/measure/channels.h"
#include "src/measure/convolution.h"
#include "src/measure/opponent_color.h"

namespace lemma {
namespace {

using std::numbers::pi;

constexpr double kColorExponent = 0.7, kFeatureExponent = 0.5;  // q_c and q_f of the paper
constexpr double kFeatureWidth = 0.082;  // degrees between peak and trough of an edge detector

/// Weights of the contrast sensitivity of one channel: a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053},
    kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};

int blur_radius() {
  return static_cast<int>(std::ceil(3 * std::sqrt(kBlueYellow[0].b / (2 * pi * pi)) * kFlipPixelsPerDegree));
}

Kernel gaussian(double b, int radius) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) {
    const double degrees = i / kFlipPixelsPerDegree;
    kernel.push_back(static_cast<float>(std::exp(-pi * pi * degrees * degrees / b)));
  }
  return kernel;
}

double sum_of(const Kernel& kernel) {
  double sum = 0;
  for (const float weight : kernel) sum += double{weight};
  return sum;
}

void scale(Kernel& kernel, double factor) {
  for (float& weight : kernel) weight = static_cast<float>(weight * factor);
}

/// A sum of Gaussians is no product over the axes, but each of them is.
Plane blur(const Plane& plane, std::span<const Sensitivity> terms) {
  const int radius = blur_radius();
  double total = 0;
  const auto height = [](const Sensitivity& s) { return s.a * std::sqrt(pi / s.b); };
  for (const Sensitivity& s : terms) total += height(s) * std::pow(sum_of(gaussian(s.b, radius)), 2);
  Plane sum{plane.width, plane.height, std::vector<float>(plane.values.size())};
  for (const Sensitivity& s : terms) {
    const Kernel along = gaussian(s.b, radius);
    Kernel across = along;
    scale(across, height(s) / total);
    const Plane part = convolve(plane, along, across);
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += part.values[i];
  }
  return sum;
}

/// Luminance and the two colour planes of an image.
using Opponents = std::array<Plane, 3>;

Opponents opponents_of(const Image& srgb) {
  Opponents planes;
  for (Plane& p : planes) p = {srgb.width, srgb.height, std::vector<float>(srgb.pixels.size())};
  parallel_for(static_cast<std::size_t>(srgb.height), [&](std::size_t y) {
    const auto width = static_cast<std::size_t>(srgb.width);
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      Color color = channels(srgb.pixels[i]);
      for (double& c : color) c = opponent::linear_from_srgb(c);
      color = opponent::ycxcz_from_xyz(opponent::xyz_from_linear(color));
      for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = static_cast<float>(color[c]);
    }
  });
  return planes;
}

/// What the eye resolves of an image, clamped to what the screen shows.
Opponents blurred(const Opponents& planes) {
  return {blur(planes[0], {&kAchromatic, 1}), blur(planes[1], {&kRedGreen, 1}), blur(planes[2], kBlueYellow)};
}

Color lab_of(const Opponents& blurred, std::size_t pixel) {
  Color rgb = opponent::linear_from_xyz(
      opponent::xyz_from_ycxcz({double{blurred[0].values[pixel]}, double{blurred[1].values[pixel]},
                                double{blurred[2].values[pixel]}}));
  for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
  return opponent::hunt_lab_from_xyz(opponent::xyz_from_linear(rgb));
}

/// The distance of the two colours of the screen that are farthest apart, to the power q_c.
double largest_color_distance() {
  const auto lab = [](const Color& c) { return opponent::hunt_lab_from_xyz(opponent::xyz_from_linear(c)); };
  return std::pow(opponent::hyab(lab({0, 1, 0}), lab({0, 0, 1})), kColorExponent);
}

/// Distances up to 0.4 of the largest become 0 ... 0.95, the rest what is left up to 1.
double redistribute(double distance, double largest) {
  constexpr double knee = 0.4, at_knee = 0.95;
  return distance < knee * largest
             ? at_knee / (knee * largest) * distance
             : at_knee + (distance - knee * largest) / (largest - knee * largest) * (1 - at_knee);
}

/// The positive weights sum to 1, the negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const float weight : kernel) (weight > 0 ? positive : negative) += double{weight};
  for (float& weight : kernel)
    weight = static_cast<float>(weight > 0 ? weight / positive : -weight / negative);
  return kernel;
}

/// How strong edges and points are at every pixel.
struct Features {
  Plane edges, points;
};

Plane length_of(const Plane& x, const Plane& y) {
  Plane length = x;
  for (std::size_t i = 0; i < length.values.size(); ++i)
    length.values[i] = std::hypot(x.values[i], y.values[i]);
  return length;
}

/// First and second derivatives of a Gaussian, along each axis.
Features features_of(const Plane& luminance) {
  const double sigma = 0.5 * kFeatureWidth * kFlipPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  Kernel smooth, edge, point;
  for (int i = -radius; i <= radius; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma));
    smooth.push_back(static_cast<float>(g));
    edge.push_back(static_cast<float>(-i * g));
    point.push_back(static_cast<float>((i * i / (sigma * sigma) - 1) * g));
  }
  scale(smooth, 1 / sum_of(smooth));
  edge = balanced(edge), point = balanced(point);
  Plane y = luminance;
  for (float& value : y.values) value = (value + 16) / 116;
  return {length_of(convolve(y, edge, smooth), convolve(y, smooth, edge)),
          length_of(convolve(y, point, smooth), convolve(y, smooth, point))};
}

double feature_difference(const Features& a, const Features& b, std::size_t pixel) {
  const double edge = std::abs(a.edges.values[pixel] - b.edges.values[pixel]);
  const double point = std::abs(a.points.values[pixel] - b.points.values[pixel]);
  return std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeatureExponent);
}

}  // namespace

std::vector<float> ldr_flip(const Image& image, const Image& reference) {
  const Opponents a = opponents_of(image), r = opponents_of(reference);
  const Opponents seen_a = blurred(a), seen_r = blurred(r);
  const Features features_a = features_of(a[0]), features_r = features_of(r[0]);
  const double largest = largest_color_distance();
  std::vector<float> flip(image.pixels.size());
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    const auto width = static_cast<std::size_t>(image.width);
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const double distance = std::pow(opponent::hyab(lab_of(seen_a, i), lab_of(seen_r, i)), kColorExponent);
      flip[i] = static_cast<float>(
          std::pow(redistribute(distance, largest), 1 - feature_difference(features_a, features_r, i)));
    }
  });
  return flip;
}

}  // namespace lemma
