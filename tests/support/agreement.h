#pragma once

#include "src/scene/scene.h"

namespace lemma::test {

/// Chance that any comparison of any scene of the family fails although all estimators have the same mean.
/// Seeds are fixed, so a test that passes does so always; this is the chance of having to look at one after a
/// change that is right.
inline constexpr double kFalseAlarm = 1e-3;

struct AgreementCase {
  Scene scene;
  /// A surface that the camera sees touches a light: samples of the light's area then have infinite variance
  /// where nothing weighs them (a distance e away, 1 / e^2 of a part e^2 of them), and are left out.
  bool touches_light = false;
};

/// Whether all combinations of {weights and integrator} x {light sampling} x {BRDF sampling} x {roulette} x
/// {sampler} x {accelerator} have the same means.
///
/// Each choice of an option that is not the first is tested in every combination of the other options:
/// against the first choice, all else alike and with the same random numbers, or against one long rendering
/// of the first choices of all options (see Pool). Tested are
///  - all together, one test for a choice: it sees the bias that all combinations with this choice have in
///  common;
///  - those together where one more option is fixed: what two choices make together;
///  - one by one.
/// What is pooled is weighted by its inverse variance, and the best combinations get most of the samples.
///
/// The environment variable LEMMA_AGREEMENT is the bias [percent of the image mean] that each test of a
/// choice must find with the probability kPower: it takes the whole product and the samples that this takes.
/// Without it, about a quarter of the combinations is rendered, in which every two choices meet, and each
/// choice gets the same time, about, or more until it sees 5 %; what it sees is printed. The tests of the
/// other kinds find what their own noise allows, which is printed.
///
/// Limits are those of Student's t with Sidak's correction for the number of tests, which holds for tests
/// that share a reference too (Sidak 1967); the false alarms are shared equally by the five kinds of tests
/// (these three of the image mean, the first and last of the means of blocks of 2 x 2 pixels) and by the
/// scenes of the family. Tests of pairs and of combinations, some of which have rare bright samples, count
/// the degrees of freedom of their renderings alone.
void expect_agreement(const AgreementCase& c, int scenes_of_family);

}  // namespace lemma::test
