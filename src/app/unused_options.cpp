#include "src/app/unused_options.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace lemma {
namespace {

/// Collects what is unused.
class Unused {
 public:
  void add(std::string_view option, std::string_view value, const std::string& beside) {
    found.push_back(fmt::format("lemma: warning: --{} {} changes nothing with {}", option, value, beside));
  }
  Warnings found;
};

/// The techniques, weights and light samples that an integrator does without.
void find_unused_sampling(const RenderOptions& o, Unused& unused) {
  const IntegratorOptions& i = o.integrator_options;
  const bool mis = o.integrator.name == "mis", one_kind = i.counted_samples != CountedSamples::both;
  const std::string_view technique = name_of(counted_samples(), i.counted_samples);
  const std::string integrator = fmt::format("--integrator {}", o.integrator.name);
  if (one_kind && !mis) unused.add("technique", technique, integrator);

  const std::string beside = mis && one_kind ? fmt::format("--technique {}", technique) : integrator;
  const bool no_lights = o.integrator.name == "brdf" || (mis && i.counted_samples == CountedSamples::brdf);
  const bool no_weights = no_lights || (mis && one_kind) || o.integrator.name == "direct";
  if (no_lights && o.lights.name != RenderOptions{}.lights.name) unused.add("lights", o.lights.name, beside);
  if (no_weights && i.heuristic != IntegratorOptions{}.heuristic) {
    unused.add("mis", name_of(heuristics(), i.heuristic), beside);
  }
}

}  // namespace

Warnings unused_options(const RenderOptions& options) {
  Unused unused;
  find_unused_sampling(options, unused);
  const BrdfOptions& brdf = options.scene.load.brdf;
  if (brdf.lobe == Lobe::blinn_phong) {
    const std::string beside = fmt::format("--brdf {}", name_of(lobes(), brdf.lobe));
    if (brdf.norm != BrdfOptions{}.norm) unused.add("phong-norm", name_of(phong_norms(), brdf.norm), beside);
    if (brdf.sampling != BrdfOptions{}.sampling) {
      unused.add("brdf-sampling", name_of(lobe_samplings(), brdf.sampling), beside);
    }
  }
  const RenderSettings& settings = options.settings;
  if (settings.sequence == Sequence::independent && settings.replicates != RenderSettings{}.replicates) {
    unused.add("replicates", fmt::format("{}", settings.replicates), "--sampler independent");
  }
  return std::move(unused.found);
}

}  // namespace lemma
