#pragma once

#include <cstdint>

namespace lemma {

/// The memory that this process may use at most [bytes]: that of the machine, or its limit if lower. What
/// needs more is refused before it is allocated.
[[nodiscard]] std::uint64_t machine_memory();

}  // namespace lemma
