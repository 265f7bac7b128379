#pragma once

#include "integrators/integrator.h"
#include "integrators/path_recorder.h"

namespace lemma {

/// Both faces of an integrator, made from one function of Estimator, so that they follow the same path:
///   Rgb follow(ray, first, world, tracer, random, observer) const
template <class Estimator>
class ObservedIntegrator : public Integrator {
 public:
  Rgb radiance(const Ray& ray, const std::optional<Hit>& first, const World& world, Tracer& tracer,
               Sampler& random) const final {
    NoObserver none;
    return estimator().follow(ray, first, world, tracer, random, none);
  }

  Rgb explain(const Ray& ray, const std::optional<Hit>& first, const World& world, Tracer& tracer,
              Sampler& random, PathRecorder& recorder) const final {
    return estimator().follow(ray, first, world, tracer, random, recorder);
  }

 private:
  const Estimator& estimator() const { return static_cast<const Estimator&>(*this); }
};

}  // namespace lemma
