#include "src/app/render_passes.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/measure/error_figures.h"
#include "src/measure/estimated_error.h"
#include "src/measure/stop_rule.h"

namespace lemma {
namespace {

StopRule stop_rule(const RenderOptions& o) {
  const bool open_end = o.seconds || o.target_relmse;
  return {.spp = o.spp.value_or(open_end ? RenderSettings::kMostSamples : o.settings.spp),
          .seconds = o.seconds,
          .relmse = o.target_relmse,
          .looks = !o.reference.empty()};
}

/// The part of a rendering that is done when a part of its next pass is; never goes back.
class PassProgress {
 public:
  PassProgress(Progress& progress, const StopRule& rule) : progress_(progress), rule_(rule) {}

  void update(const PassState& state, std::uint32_t next, double part) {
    const double spp = state.spp + part * (next - state.spp);
    double done = spp / rule_.spp;
    if (rule_.seconds && state.spp > 0)
      done = std::max(done, state.seconds * spp / state.spp / *rule_.seconds);
    if (rule_.relmse && state.relmse > 0)
      done = std::max(done, *rule_.relmse / state.relmse * spp / state.spp);
    const bool may_go_on = rule_.seconds || rule_.relmse;
    shown_ = std::max(shown_, may_go_on ? std::min(done, 0.99) : done);
    if (shown_ > 0) progress_.update(shown_);
  }

  void finish() {
    if (shown_ < 1) progress_.update(1);
  }

 private:
  Progress& progress_;
  const StopRule& rule_;
  double shown_ = 0;
};

ErrorPoint error_point(const RenderResult& result, const Image& reference, const ReferenceNoise& noise) {
  const ErrorFigures errors = error_figures(result.image, reference);
  return {.spp = result.spp,
          .seconds = result.seconds,
          .cpu_seconds = result.cpu_seconds,
          .mse = errors.mse - noise.mse,
          .relmse = errors.relmse - noise.relmse};
}

}  // namespace

std::optional<ReadImage> read_reference(const RenderOptions& options, const CameraView& view) {
  if (options.reference.empty()) return std::nullopt;
  ReadImage reference = read_image(options.reference);
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    return std::runtime_error(
        fmt::format("{}: error: {}\n  hint: {}", options.reference.string(), what, hint));
  };
  if (!reference.linear) throw refuse("a picture is no reference", "name an .exr file");
  const int width = reference.image.width, height = reference.image.height;
  if (width != view.width || height != view.height) {
    throw refuse(
        fmt::format("{}x{} pixels are no reference for {}x{}", width, height, view.width, view.height),
        fmt::format("render with --size {}x{}", width, height));
  }
  return reference;
}

PassesResult render_passes(const World& world, const Integrator& integrator, const RenderOptions& options,
                           const std::optional<ReadImage>& reference, Progress& progress) {
  const StopRule rule = stop_rule(options);
  PassProgress shown(progress, rule);
  Rendering rendering(world, integrator, options.settings);
  PassState state;
  PassesResult passes;
  if (reference && reference->variance)
    passes.reference_noise = reference_noise(reference->image, *reference->variance);
  for (std::uint32_t next = next_spp(rule, state); next > state.spp; next = next_spp(rule, state)) {
    rendering.render_to(next, [&](double part) { shown.update(state, next, part); });
    state = {.spp = next, .seconds = rendering.seconds()};
    if (!rule.relmse && !reference) continue;
    const RenderResult result = rendering.result();
    if (next >= StopRule::kFirstLook)
      state.relmse = estimated_error(result.image, result.variance).relmse.value;
    if (!reference) continue;
    passes.curve.push_back(
        error_point(result, reference->image, passes.reference_noise.value_or(ReferenceNoise{})));
  }
  shown.finish();
  if (rule.relmse) passes.target_reached = state.spp >= StopRule::kFirstLook && state.relmse <= *rule.relmse;
  passes.result = rendering.result();
  return passes;
}

}  // namespace lemma
