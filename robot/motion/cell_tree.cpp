#include "robot/motion/cell_tree.h"

#include <algorithm>

namespace prohull::robot {

void CellRecord::halve(std::size_t cell, std::size_t freedom, std::size_t first_half) {
  if (!is_kept_) return;
  cells_.resize(std::max(cells_.size(), first_half + 2));
  cells_[cell] = {static_cast<std::uint8_t>(freedom), first_half};
}

CellTree CellRecord::tree() const {
  CellTree tree;
  std::vector<std::size_t> open{0};
  while (is_kept_ && !open.empty()) {
    const Cell cell = open.back() < cells_.size() ? cells_[open.back()] : Cell();
    open.pop_back();
    tree.push_back(cell.halved);
    if (cell.halved != kLeaf) open.insert(open.end(), {cell.first_half + 1, cell.first_half});
  }
  return tree;
}

}  // namespace prohull::robot
