#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "enclose/candidate.h"

namespace prohull {

/// Sentences about one hull, each once.
class Notes {
 public:
  void add(std::string text);
  /// Why a hull of this source is not as asked for. Of each source the last one counts.
  void add_why_not(Source source, std::string text);
  void add(const Notes& others);
  void remove(const std::string& text);

  bool is_empty() const { return notes_.empty(); }
  const std::string& last() const { return notes_.back().text; }
  /// What a user needs to know beside a hull of `source`: of one that is as asked for only why it is not of the mesh.
  std::vector<std::string> beside(Source source, bool is_as_asked) const;

 private:
  struct Note {
    std::string text;
    std::optional<Source> why_not;
  };

  std::vector<Note> notes_;
};

/// Which of the attempts is preferred, and why others are not as asked for.
class Ranking {
 public:
  Ranking(const Request& request, std::size_t target_faces, const Solids& solids, Notes& notes)
      : request_(request), target_faces_(target_faces), solids_(solids), notes_(notes) {}

  void take(std::optional<Attempt> attempt);

  bool is_empty() const { return !best_.has_value(); }
  const Attempt& best() const { return *best_; }
  bool has_certified() const { return best_ && best_->hull.certified; }
  bool keeps_bounds() const { return has_certified() && best_->hull.within_bounds; }  ///< the best does
  bool last_failed() const { return last_failed_; }  ///< the last attempt is not certified, or could not be made
  /// The last attempt, if it is certified and keeps the bounds; else null.
  const EnclosingHull* last_kept() const { return is_last_best_ ? &best_->hull : second_ ? &*second_ : nullptr; }

  bool is_as_asked() const { return best_ && is_as_asked(best_->hull); }
  bool is_clean() const { return is_clean(best_->hull); }
  /// The best is one of what is flat and convex.
  bool is_of_flat() const { return best_ && solids_[best_->hull.solid].slab_width > 0; }
  bool is_near_flat() const;     ///< and as near as a tent
  bool is_on_triangles() const;  ///< a convex hull all of which lies on triangles that do not bound a solid
  std::size_t fewest_faces_of_wraps() const {
    return fewest_of_wraps_;
  }  ///< of their hulls; the largest number if none
  double best_volume() const { return signed_volume(best_->hull.mesh); }
  double best_void() const { return best_volume() / volume() - 1; }
  /// How much larger the best is than it has to be, about.
  double slack() const;

  /// The best one, with the times of all that was tried; none if nothing was.
  std::optional<Attempt> taken() &&;
  /// The same, with notes. Throws InputError if none is certified.
  EnclosingHull winner();

 private:
  bool is_in_spite_of_bounds(const Attempt& attempt) const;
  bool is_clean(const EnclosingHull& hull) const;
  bool is_as_asked(const EnclosingHull& hull) const;
  bool is_better(const EnclosingHull& a, const EnclosingHull& b) const;
  double weighed_size(const EnclosingHull& hull) const;
  std::string none_within_bounds(SolidId solid) const;
  void note_why_not(const EnclosingHull& hull);
  std::string why_not(const EnclosingHull& hull) const;
  [[noreturn]] void refuse();

  double volume() const { return solids_.volume(target_faces_); }
  bool has_wrap() const { return !solids_.wraps(target_faces_).empty(); }

  const Request& request_;
  const std::size_t target_faces_;
  const Solids& solids_;
  Notes& notes_;
  std::optional<Attempt> best_;
  double void_before_padding_ = 0;  ///< of the last hull of the mesh
  double build_seconds_ = 0, verify_seconds_ = 0;
  bool last_failed_ = false;
  bool is_last_best_ = false;            ///< and keeps the bounds
  std::optional<EnclosingHull> second_;  ///< the last attempt, if it keeps the bounds, and is not the best
  std::size_t fewest_of_wraps_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace prohull
