#include "accel/grid_near.h"

#include <array>

namespace lemma {

void mark_near(const GridLevel& level, GridCells& grid) {
  std::array<int, 3> cell{};
  for (cell[2] = 0; cell[2] < level.counts[2]; ++cell[2]) {
    for (cell[1] = 0; cell[1] < level.counts[1]; ++cell[1]) {
      for (cell[0] = 0; cell[0] < level.counts[0]; ++cell[0]) {
        if (!grid.is_occupied(level, level.index(cell))) continue;
        for (std::uint32_t place = 0; place < 8; ++place) {
          const std::array<int, 3> from{cell[0] - static_cast<int>(place & 1),
                                        cell[1] - static_cast<int>(place >> 1 & 1),
                                        cell[2] - static_cast<int>(place >> 2)};
          if (from[0] < 0 || from[1] < 0 || from[2] < 0) continue;
          const std::uint32_t index = level.index(from);
          grid.near[level.near + index / 4] |= 1u << (8 * (index % 4) + place);
        }
      }
    }
  }
}

}  // namespace lemma
