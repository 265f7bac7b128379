#pragma once

#include "src/scene/scene.h"

namespace lemma::test {

/// Chance that any comparison of any scene of the family fails although all estimators have the same mean.
/// Seeds are fixed, so a test that passes does so always; this is the chance of having to look at one after a
/// change that is right.
inline constexpr double kFalseAlarm = 1e-3;

/// Chance that a bias of the size that is stated as detectable is found.
inline constexpr double kPower = 0.9;

struct AgreementCase {
  Scene scene;
  /// A surface that the camera sees touches a light: samples of the light's area then have infinite variance
  /// where nothing weighs them (a distance e away, 1 / e^2 of a part e^2 of them), and are left out.
  bool touches_light = false;
  /// The smallest bias [part of the image mean] that each test of a choice must detect, unless the
  /// environment variable LEMMA_AGREEMENT says another, in percent.
  double usual_bias = 0.05;
};

/// Whether all combinations of {weights and integrator} x {light sampling} x {BRDF sampling} x {roulette} x
/// {sampler} x {accelerator} have the same means.
///
/// Each choice of an option that is not the first is compared with the first, all other options alike and
/// drawn with the same random numbers, so that what both do with them alike cancels. Such a comparison is
/// made for every combination of the other options, each with 16 seeds of its own. They are tested
///  - together, one test for a choice: it sees the bias that all combinations with this choice have in
///  common;
///  - together where one more option is fixed: what two choices make together;
///  - one by one.
/// What is pooled is weighted by its inverse variance, as a rendering with other seeds found it. That also
/// says how many samples are taken, until each test of a choice detects the bias wanted with the probability
/// kPower: (limit + quantile of the power) x standard error, both of the samples that are tested, is no more.
/// Standard errors of differences count as a tenth of the estimators' own at least: some differ in rare
/// samples only, which a few seeds may miss.
/// The tests of the other kinds detect what their own noise allows, which is printed.
///
/// Limits are those of Student's t, the degrees of freedom of sums by Welch and Satterthwaite, with Sidak's
/// correction for the number of tests; the false alarms are shared equally by the five kinds of tests (these
/// three of the image mean, the first and last of the means of blocks of 4 x 4 pixels) and by the scenes of
/// the family.
///
/// Without LEMMA_AGREEMENT about a quarter of the combinations is rendered, in which every two choices meet.
void expect_agreement(const AgreementCase& c, int scenes_of_family);

}  // namespace lemma::test
