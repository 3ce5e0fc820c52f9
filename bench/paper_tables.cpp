#include "paper_tables.h"

namespace prohull::bench {
namespace {

constexpr std::array kModels{
    PaperModel{"rocker", 20088, {54, 8}, {2.87, 5.72}, {28.90, 62.91}},
    PaperModel{"screwdriver", 54300, {161, 26}, {2.21, 3.53}, {20.70, 38.99}},
    PaperModel{"dinosaur", 84288, {245, 37}, {15.08, 21.70}, {164.84, 165.85}},
    PaperModel{"horse", 96966, {298, 45}, {4.11, 6.86}, {65.06, 65.60}},
    PaperModel{"igea", 134342, {478, 69}, {2.04, 3.02}, {12.06, 17.14}},
    PaperModel{"balljoint", 274120, {1006, 158}, {3.46, 5.32}, {19.60, 31.16}},
};

std::optional<double> at(const std::array<double, 2>& row, Strategy strategy) {
  if (strategy == Strategy::Paper1) return row[0];
  if (strategy == Strategy::Paper2) return row[1];
  return std::nullopt;
}

}  // namespace

std::optional<double> PaperModel::seconds_of(Strategy strategy, std::size_t hull_faces) const {
  return hull_faces == 2000 ? at(seconds, strategy) : std::nullopt;
}

std::optional<double> PaperModel::void_percent(Strategy strategy, std::size_t hull_faces) const {
  if (hull_faces == 2000) return at(void_percent_at_2000, strategy);
  if (hull_faces == 200) return at(void_percent_at_200, strategy);
  return std::nullopt;
}

const PaperModel* paper_model(std::string_view name, std::size_t faces) {
  for (const PaperModel& model : kModels)
    if (model.faces == faces && name.find(model.key) != std::string_view::npos) return &model;
  return nullptr;
}

}  // namespace prohull::bench
