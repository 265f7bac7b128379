#include "accel/grid_resolution.h"

#include <algorithm>
#include <cmath>

#include "accel/grid_cells.h"

namespace lemma {
namespace {

/// What a random line costs in a grid of the scene [ns], by unit costs measured on one machine (Sapphire
/// Rapids, AVX-512; only their quotients matter). Lines meet surfaces of area A in a convex box of surface S
/// 2 A / S times on average (Crofton), and pass 4 V / S of its volume V.
struct CostModel {
  static constexpr double kLevel = 25;   // to clip a ray to a grid
  static constexpr double kSlices = 45;  // to look through 16 slices for occupied cells
  static constexpr double kCell = 20;    // to get to a list
  static constexpr double kTriangle = 1;
  static constexpr double kCells = 1.9;  // occupied cells that a line passes where it meets a surface

  double way;        // 4 V / S
  double crossings;  // 2 A / S, of the triangles small against cells of the coarse grid
  double per_area;   // references that a unit of area of such cells' faces holds

  /// Of a grid with cells of this size, whose occupied ones cost `content`.
  [[nodiscard]] double grid(double length, double cell, double content) const {
    return kLevel + kSlices * (1 + length / (16 * cell)) + content;
  }
  [[nodiscard]] double lists(double cell) const {
    return crossings * kCells * (kCell + kTriangle * per_area * cell * cell);
  }
  [[nodiscard]] double one_level(double cell) const { return grid(way, cell, lists(cell)); }
  [[nodiscard]] double two_levels(double coarse, double cell) const {
    const double child = kCell + grid(0.75 * coarse, cell, 0);
    return grid(way, coarse, crossings * kCells * child + lists(cell));
  }
};

/// For a small scene 2 cells a triangle, up to the number beyond which more of them measured no better. For
/// others cells of about 16 slices an axis, one look for AVX-512, in which grids of their own divide crowded
/// cells, or one finer grid for all, where rays soon meet fine surfaces: what the model finds cheaper.
double cheaper_target(std::span<const Triangle> triangles, const Vec3d& extent) {
  constexpr double kCoarse = 3000;  // cells
  constexpr double kSmall = 16000;  // cells of one grid for a small scene
  const double fine = kGridDensity * static_cast<double>(triangles.size());
  if (fine <= kSmall) return std::min(kSmall, 4 * fine);
  const auto cell_of = [&](double target) {
    const auto counts = cell_counts(extent, target);
    return std::max({extent.x / counts[0], extent.y / counts[1], extent.z / counts[2]});
  };
  const double coarse_cell = cell_of(kCoarse), fine_cell = cell_of(fine);
  double small_area = 0, small = 0;
  for (const Triangle& t : triangles) {
    const double a = area(t);
    if (a < coarse_cell * coarse_cell) small_area += a, ++small;
  }
  const double surface = 2 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
  const CostModel model{4 * extent.x * extent.y * extent.z / surface, 2 * small_area / surface,
                        small_area > 0 ? 1.5 * small / small_area : 0};
  // A crowded cell's grid divides the triangles of a face of it, not of its volume.
  const double in_cell = model.per_area * coarse_cell * coarse_cell;
  const double child_cell = coarse_cell / std::max(std::cbrt(kGridDensity * in_cell), 1.0);
  return model.one_level(fine_cell) < model.two_levels(coarse_cell, child_cell) ? fine : kCoarse;
}

}  // namespace

std::array<int, 3> cell_counts(const Vec3d& extent, double target) {
  std::array<int, 3> counts{1, 1, 1};
  std::array<bool, 3> split{extent[0] > 0, extent[1] > 0, extent[2] > 0};
  double per_unit = 0;
  for (bool settled = false; !settled;) {
    double volume = 1;
    int dimensions = 0;
    for (int k = 0; k < 3; ++k) {
      if (split[static_cast<std::size_t>(k)]) volume *= extent[k], ++dimensions;
    }
    if (dimensions == 0) return counts;
    per_unit = std::pow(target / volume, 1.0 / dimensions);
    settled = true;
    for (int k = 0; k < 3; ++k) {
      auto&& splits = split[static_cast<std::size_t>(k)];
      if (splits && extent[k] * per_unit < 1 && dimensions > 1) splits = false, settled = false;
    }
  }
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (split[axis])
      counts[axis] = static_cast<int>(
          std::clamp(std::round(extent[k] * per_unit), 1.0, double{GridLevel::kMaxCellsPerAxis}));
  }
  return counts;
}

double target_cells(const GridResolution& resolution, std::span<const Triangle> triangles,
                    const Vec3d& extent) {
  if (resolution.cells > 0) return static_cast<double>(resolution.cells);
  if (resolution.rule == GridResolution::Rule::twenty_seven)
    return 27 * static_cast<double>(triangles.size());
  return cheaper_target(triangles, extent);
}

}  // namespace lemma
