#include "accel/grid_resolution.h"

#include <algorithm>
#include <cmath>

#include "accel/grid_cells.h"

namespace lemma {
namespace {

/// What a random line costs in a grid of the scene [ns], by unit costs measured on one machine (Sapphire
/// Rapids, AVX-512; only their quotients matter). Lines meet surfaces of area A in a convex box of surface S
/// 2 A / S times on average (Crofton), and pass 4 V / S of its volume V. Of n triangles of a surface that lie
/// in a cell about n^(1/2) are in parts that the line passes.
struct CostModel {
  static constexpr double kSlices = 30;  // to look through 16 slices for occupied cells
  static constexpr double kCell = 20;    // to get to a list
  static constexpr double kPassed = 0.7;
  static constexpr double kCells = 1.9;  // occupied cells that a line passes where it meets a surface

  double way;        // 4 V / S
  double crossings;  // 2 A / S, of the triangles small against cells of the coarse grid
  double per_area;   // references that a unit of area of such cells' faces holds

  /// With cells of this size.
  [[nodiscard]] double operator()(double cell) const {
    const double list = kCell + kPassed * std::sqrt(per_area * cell * cell);
    return kSlices * (1 + way / (16 * cell)) + crossings * kCells * list;
  }
};

/// For a small scene 2 cells a triangle, up to the number beyond which more of them measured no better. For
/// others cells of about 16 slices an axis, one look for AVX-512, or a finer grid, where rays soon meet fine
/// surfaces: what the model finds cheaper.
double cheaper_target(std::span<const Triangle> triangles, const Vec3d& extent) {
  constexpr double kCoarse = 3000;  // cells
  constexpr double kSmall = 16000;  // of a small scene
  constexpr double kFine = 64000;   // beyond these more are slower (field of 4 million triangles)
  const auto count = static_cast<double>(triangles.size());
  const double fine = std::min(count / 16, kFine);
  if (fine <= kSmall) return std::min(2 * count, kSmall);
  const auto cell_of = [&](double target) {
    const auto counts = cell_counts(extent, target);
    return std::max({extent.x / counts[0], extent.y / counts[1], extent.z / counts[2]});
  };
  const double coarse_cell = cell_of(kCoarse);
  double small_area = 0, small = 0;
  for (const Triangle& t : triangles) {
    const double a = area(t);
    if (a < coarse_cell * coarse_cell) small_area += a, ++small;
  }
  const double surface = 2 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
  const CostModel cost{4 * extent.x * extent.y * extent.z / surface, 2 * small_area / surface,
                       small_area > 0 ? 1.5 * small / small_area : 0};
  return cost(cell_of(fine)) < cost(coarse_cell) ? fine : kCoarse;
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
