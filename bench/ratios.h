#pragma once

#include <string>
#include <vector>

namespace lemma::bench {

/// Measures grid against embree, side by side, and prints a table of grid's share of embree's speed: builds
/// with all threads, rays with one. Each number is the median of rounds in which the two take turns, so that
/// what else the machine does meets both alike.
/// @param json_file  the same as JSON; empty: none
void print_ratios(const std::vector<std::string>& cases, int rounds, const std::string& json_file);

}  // namespace lemma::bench
