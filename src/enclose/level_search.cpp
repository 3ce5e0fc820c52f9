#include "enclose/level_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace prohull {
namespace {

// Moving takes 0.1 to 0.4 ms for each face, most of it in soups: this is at most 6 s. With 4,000 for meshes of less
// than 40 faces and 100 for each face of others, 28 requests of soups took 0.63 of the time, but one missed a bound
// that it keeps, and eight had up to twice the faces.
std::size_t most_faces_tried(std::size_t fewest) { return std::max<std::size_t>(16'000, 3 * fewest); }

class LevelSearch {
 public:
  LevelSearch(std::size_t fewest, std::size_t most, const std::function<LevelTrial(std::size_t)>& trial)
      : most_(most), left_(most_faces_tried(fewest)), trial_(trial), too_few_(tried(fewest)), nearest_(too_few_) {}

  LevelTrial run() {
    if (too_few_.keeps_bounds()) return too_few_;
    while (const auto faces = next_faces()) take(tried(*faces));
    return enough_ ? *enough_ : nearest_;
  }

 private:
  LevelTrial tried(std::size_t faces) {
    left_ -= std::min(left_, faces);
    return trial_(faces);
  }

  void take(LevelTrial made) {
    if (made.keeps_bounds()) {
      enough_ = std::move(made);
      return;
    }
    if (made.excess < nearest_.excess) nearest_ = made;
    too_few_ = std::move(made);
  }

  std::optional<std::size_t> next_faces() const {
    constexpr double kCloseEnough = 1.05;
    const double few = double(too_few_.faces);
    const double times = enough_ ? std::sqrt(double(enough_->faces) / few) : times_more();
    const auto faces = std::min(most_, 2 * std::size_t(std::ceil(few * times / 2)));
    if (enough_ ? faces >= enough_->faces || times < kCloseEnough : faces <= too_few_.faces) return std::nullopt;
    return faces <= left_ ? std::optional(faces) : std::nullopt;
  }

  // What is missing falls with the square of the faces at best, and up and down where it is little: so small steps do
  // not pass by what keeps the bounds with few faces. They are larger where they take much of what is left.
  double times_more() const {
    constexpr double kLeast = 1.2, kMost = 8;
    const double least = kLeast * (1 + double(too_few_.faces) / double(left_ + 1));
    return std::min(kMost, std::max(least, std::sqrt(too_few_.excess)));
  }

  const std::size_t most_;
  std::size_t left_;  ///< of the faces that may be tried
  const std::function<LevelTrial(std::size_t)>& trial_;
  LevelTrial too_few_, nearest_;
  std::optional<LevelTrial> enough_;
};

}  // namespace

LevelTrial search_levels(std::size_t fewest, std::size_t most, const std::function<LevelTrial(std::size_t)>& trial) {
  return LevelSearch(fewest, most, trial).run();
}

std::size_t faces_of_first_trial(std::size_t fewest) { return most_faces_tried(fewest) / 4; }

}  // namespace prohull
