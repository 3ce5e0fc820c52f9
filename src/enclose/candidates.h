#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "enclose/ranking.h"

namespace prohull {

/// One of ever finer wraps, which bounds ask for.
struct LooseWrap {
  int number;  ///< from 0 on
  double spacing;
  bool is_last;
};

/// What is tried for one number of faces, with bounds or without, and with one seed, in order. What cannot win any more
/// is left out.
class Candidates {
 public:
  Candidates(const Request& request, std::size_t target_faces, const HullBounds& bounds, std::uint64_t seed,
             Notes& notes);

  /// After the last one was built, and `ranking` has taken what came of it.
  std::optional<Candidate> next(const Ranking& ranking, Solids& solids);

 private:
  /// None if it is not worth trying, or if there is no such solid.
  using Step = std::function<std::optional<Candidate>(const Ranking&, Solids&)>;

  void plan_volume();
  void plan_mesh();
  void plan_moved_mesh();
  void plan_finer_levels();
  void plan_unfolded_mesh();
  void plan_within_of_mesh();
  void plan_convex_hull();
  void plan_convex_hull_in_steps();
  void plan_polytope();
  void plan_wraps();
  void plan_other_wraps();
  void plan_early();
  void plan_clear_of_wraps();
  void plan_sheets(bool is_instead_of_wraps);
  void plan_offset();
  void plan_bounded_wraps();
  void plan_close_wraps();
  void plan_loose_wraps();
  void plan_further();
  void plan_why_not_closer(double finest, double wanted);
  void plan_inner();
  void plan_inner_with_padding();
  void plan_tight();
  std::optional<Candidate> follow_up(const Ranking& ranking, const Solids& solids) const;
  bool are_wraps_stuck(const Ranking& ranking) const;
  bool is_worth_a_wrap(const Ranking& ranking, const Solids& solids, bool is_first) const;
  bool is_worth_a_polytope(const Ranking& ranking, Solids& solids) const;
  std::optional<SolidId> wrap(const WrapKind& kind, double spacing, Solids& solids) const;
  std::optional<Candidate> of_wrap(const WrapKind& kind, const Ranking& ranking, Solids& solids) const;
  bool may_be_better(const LooseWrap& next, const Ranking& ranking, const Solids& solids) const;
  std::optional<Candidate> loose_wrap(const LooseWrap& next, const Ranking& ranking, Solids& solids) const;
  bool has_few_faces(const Ranking& ranking) const;
  bool may_move_mesh() const;
  bool has_too_many_parts(const Solid& solid) const;
  bool is_worth_the_mesh(const Solids& solids) const;
  bool is_worth_a_search(const EnclosingHull& hull) const;
  double spacing_for(const WrapKind& kind) const;
  double finest_worth_its_faces(const Solids& solids) const;
  bool is_small_gap(double spacing) const;
  bool keeps_clear(const Solid& solid) const;
  Candidate of(SolidId id, const Solids& solids) const;
  Candidate of_convex(SolidId id, const Ranking& ranking, const Solids& solids) const;
  Candidate moved(SolidId id) const;
  Candidate within(SolidId id, double max_distance, const Solids& solids) const;
  Candidate further(const EnclosingHull& hull, double within) const;
  bool may_stay_within() const;
  bool may_go_further() const;
  bool is_worth_further(const Ranking& ranking) const;
  bool has_passed_coarser_levels(const Ranking& ranking) const;

  const Request& request_;
  const std::size_t target_faces_;
  const HullBounds bounds_;
  const std::uint64_t seed_;
  Notes& notes_;
  std::vector<Step> steps_;
  std::size_t next_step_ = 0;
  std::optional<Candidate> last_;
};

}  // namespace prohull
