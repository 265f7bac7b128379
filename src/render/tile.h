#pragma once

#include "src/render/render.h"

namespace lemma {

/// A rectangle of pixels that one task renders.
struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Cuts an image into tiles, row by row; those at the right and lower border may be smaller.
[[nodiscard]] std::vector<Tile> tiles_of(int width, int height);

/// What became of a tile's samples.
struct TileResult {
  TraceCounts counts;
  std::uint64_t invalid_samples = 0;
  std::vector<InvalidSample> first_invalid;
};

/// The samples with the indices begin ... end - 1.
struct SampleRange {
  std::uint32_t begin = 0, end = 0;
};

/// Renders samples of a tile's pixels into the film.
[[nodiscard]] TileResult render_tile(const World& world, const Integrator& integrator, const Camera& camera,
                                     const RenderSettings& settings, const Tile& tile,
                                     const SampleRange& samples, Film& film);

}  // namespace lemma
