#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace prohull::robot {

/// What becomes of the cells of a proof, in preorder: which freedom is halved, kLeaf for a cell that is proven.
using CellTree = std::vector<std::uint8_t>;
inline constexpr std::uint8_t kLeaf = 255;

/// Keeps which cells were halved. Cells are numbered in the order in which they are made, and the two halves of one
/// follow each other.
class CellRecord {
 public:
  /// Keeps no tree if there are more freedoms than a tree can name.
  CellRecord(bool is_asked, std::size_t freedoms) : is_kept_(is_asked && freedoms < kLeaf) {}

  bool is_kept() const { return is_kept_; }
  void halve(std::size_t cell, std::size_t freedom, std::size_t first_half);
  /// Keeps no tree: a cell is proven so barely that a checker may see it otherwise.
  void give_up() { is_kept_ = false; }
  /// The tree below cell 0, where all cells that were not halved are proven. Empty if no tree is kept.
  CellTree tree() const;

 private:
  struct Cell {
    std::uint8_t halved = kLeaf;
    std::size_t first_half = 0;
  };

  bool is_kept_;
  std::vector<Cell> cells_;
};

}  // namespace prohull::robot
