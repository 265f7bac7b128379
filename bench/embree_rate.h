#pragma once

#include <string>

namespace lemma::bench {

/// Rays a second of processor time that Embree alone traces in a case, with all threads at once as a renderer
/// does: primary, bounce and shadow rays, one by one. A unit for the time of renderings: it takes about a
/// tenth of a second of each thread, so that it can be measured between them, when the machine is as busy.
[[nodiscard]] double embree_rate(const std::string& case_name);

}  // namespace lemma::bench
