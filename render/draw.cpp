#include "render/draw.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "prohull/error.h"

namespace prohull::render {
namespace {

struct Task {
  std::size_t panel;
  Rectangle tile;
};

std::vector<Task> tiles(const std::vector<Panel>& panels) {
  constexpr int kSide = 48;
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Rectangle& place = panels[i].place;
    for (int y = place.top; y < place.bottom; y += kSide)
      for (int x = place.left; x < place.right; x += kSide)
        tasks.push_back({i, {x, y, std::min(x + kSide, place.right), std::min(y + kSide, place.bottom)}});
  }
  return tasks;
}

/// Counts the tiles that are drawn, tells the caller's function on the caller's thread, and throws Cancelled.
class TileCounter {
 public:
  TileCounter(std::size_t all, const Progress& progress) : all_(all), progress_(progress) {}
  void next() {
    const std::size_t done = ++done_;
    if (done < all_ && std::this_thread::get_id() == caller_)
      tell(static_cast<double>(done) / static_cast<double>(all_));
  }
  /// On the caller's thread: the last tile may have been another's.
  void finish() { tell(1); }

 private:
  void tell(double fraction) {
    if (progress_ && !progress_("render", fraction)) throw Cancelled();
  }

  const std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<std::size_t> done_ = 0;
  const std::size_t all_;
  const Progress& progress_;
};

std::vector<TileRenderer> renderers(const std::vector<Panel>& panels, const Pattern& pattern) {
  std::vector<TileRenderer> result;
  for (const Panel& panel : panels) result.emplace_back(panel, pattern);
  return result;
}

}  // namespace

Image draw(int width, int height, const std::vector<Panel>& panels, const DrawOptions& options) {
  Image image(width, height);
  const std::vector<Task> tasks = tiles(panels);
  const Pattern pattern(options.samples);
  TileCounter counter(tasks.size(), options.progress);
  oneapi::tbb::enumerable_thread_specific<std::vector<TileRenderer>> mine([&] { return renderers(panels, pattern); });
  const auto draw_tile = [&](std::size_t i) {
    mine.local()[tasks[i].panel].draw(tasks[i].tile, options.background, image);
    counter.next();
  };
  const int cores = oneapi::tbb::this_task_arena::max_concurrency();
  oneapi::tbb::task_arena arena(options.threads > 0 ? std::min(options.threads, cores) : cores);
  arena.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, tasks.size(), draw_tile); });
  counter.finish();
  return image;
}

}  // namespace prohull::render
