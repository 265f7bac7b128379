#include "src/core/machine.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace lemma {

std::uint64_t machine_memory() {
  const auto pages = static_cast<std::uint64_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  const auto page = static_cast<std::uint64_t>(std::max(0L, sysconf(_SC_PAGE_SIZE)));
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? std::min<std::uint64_t>(limit.rlim_cur, pages * page) : pages * page;
}

}  // namespace lemma
