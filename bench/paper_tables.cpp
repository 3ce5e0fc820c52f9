#include "paper_tables.h"

namespace prohull::bench {
namespace {

constexpr std::array kModels{
    PaperModel{"rocker", 20088, {54, 8}, {2.87, 5.72}, {28.90, 62.91}, 2044, {45, 24, 21, 18}, 14},
    PaperModel{"screwdriver", 54300, {161, 26}, {2.21, 3.53}, {20.70, 38.99}, 1641, {120, 69, 50, 45}, 24},
    PaperModel{"dinosaur", 84288, {245, 37}, {15.08, 21.70}, {164.84, 165.85}, 955, {190, 73, 68, 49}, 14},
    PaperModel{"horse", 96966, {298, 45}, {4.11, 6.86}, {65.06, 65.60}, 1119, {216, 79, 76, 52}, 21},
    PaperModel{"igea", 134342, {478, 69}, {2.04, 3.02}, {12.06, 17.14}, 1808, {298, 107, 68, 45}, 35},
    PaperModel{"balljoint", 274120, {1006, 158}, {3.46, 5.32}, {19.60, 31.16}, 1545, {707, 258, 204, 137}, 41},
};

// The horse.
constexpr std::array kFirstStrategyBases{
    PaperBase{200, 22.11, 759, 226},   PaperBase{500, 21.15, 812, 203},   PaperBase{1000, 20.77, 939, 179},
    PaperBase{2000, 21.41, 1209, 145}, PaperBase{3000, 23.93, 1522, 124}, PaperBase{4000, 26.07, 1841, 108},
    PaperBase{5000, 28.79, 2176, 96},  PaperBase{10000, 44.12, 3904, 61},
};
constexpr std::array kSecondStrategyBases{
    PaperBase{200, 23.11, 798, 238},   PaperBase{500, 22.38, 868, 217},   PaperBase{1000, 21.79, 986, 192},
    PaperBase{2000, 22.59, 1254, 155}, PaperBase{3000, 24.44, 1550, 131}, PaperBase{4000, 26.98, 1871, 114},
    PaperBase{5000, 29.46, 2200, 100}, PaperBase{10000, 44.29, 3907, 63},
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

const PaperBase* paper_base(const PaperModel* model, Strategy strategy, std::size_t faces) {
  if (!model || model->key != "horse" || strategy == Strategy::Lazy) return nullptr;
  for (const PaperBase& base : strategy == Strategy::Paper1 ? kFirstStrategyBases : kSecondStrategyBases)
    if (base.faces == faces) return &base;
  return nullptr;
}

const PaperModel* paper_model(std::string_view name, std::size_t faces) {
  for (const PaperModel& model : kModels)
    if (model.faces == faces && name.find(model.key) != std::string_view::npos) return &model;
  return nullptr;
}

}  // namespace prohull::bench
