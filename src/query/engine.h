#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "prohull/mesh_query.h"
#include "query/closest.h"
#include "query/line.h"

namespace prohull {

/// Takes the faces that an engine thinks a line may cross, each at most once, decides exactly, and keeps what is asked.
class HitCollector {
  struct Found {
    FaceId face;
    bool entering;
    Parameter at;
  };

 public:
  using Storage = std::vector<Found>;

  /// `storage` is of an earlier collector, so that none has to be allocated; its content does not count.
  HitCollector(const TriangleMesh& mesh, const DirectedLine& line, HitMode mode, Storage storage = {})
      : mesh_(mesh), line_(line), mode_(mode), limit_(line.t_end), all_(std::move(storage)) {
    all_.clear();
  }
  Storage storage() && { return std::move(all_); }

  const TriangleMesh& mesh() const { return mesh_; }

  void offer(FaceId face) { offer(face, mesh_.triangle(face)); }
  void offer(FaceId face, const Triangle& triangle);
  /// Of a face that the whole line passes through, as `pierced` has it: only where it does is left to decide.
  void offer_pierced(FaceId face, const Triangle& triangle, int sign);

  /// What is asked if not the hits themselves: whether there are any, or how much more often the line leaves than
  /// enters.
  enum class Only { Whether, Winding };
  void ask_only(Only only) { only_ = only; }
  /// A crossing that is certain, as `pierced` has it: whether nothing more need be known of it.
  bool settles(int sign) {
    if (!only_) return false;
    is_settled_ = true;
    winding_ += sign;
    return true;
  }
  bool has_any() const { return is_settled_ || best_; }
  int winding() const { return winding_; }

  /// Nothing more is of interest.
  bool is_complete() const { return mode_ == HitMode::Any && has_any(); }
  /// Crossings beyond this t are not of interest.
  double limit() const { return limit_; }

  /// The one asked for by HitMode::First or HitMode::Any.
  std::optional<Hit> best() const;
  /// Appends those of HitMode::All, in the order in which the line crosses them.
  void append_all(std::vector<Hit>& hits);

 private:
  bool before(const Found& one, const Found& other) const;
  Vec3 position(const Found& found) const;
  Hit hit(const Found& found) const;

  const TriangleMesh& mesh_;
  const DirectedLine& line_;
  HitMode mode_;
  double limit_;
  std::optional<Found> best_;
  Storage all_;
  std::optional<Only> only_;
  bool is_settled_ = false;
  int winding_ = 0;
};

/// The same for the faces that a triangle may meet.
class FaceCollector {
 public:
  FaceCollector(const TriangleMesh& mesh, const Triangle& triangle, HitMode mode)
      : mesh_(mesh), triangle_(triangle), mode_(mode) {}

  void offer(FaceId face);
  bool is_complete() const { return mode_ == HitMode::Any && !found_.empty(); }

  bool any() const { return !found_.empty(); }
  /// Ascending.
  std::vector<FaceId> all();

 private:
  const TriangleMesh& mesh_;
  const Triangle& triangle_;
  HitMode mode_;
  std::vector<FaceId> found_;
};

/// Scratch memory of one thread for an engine; offers every face that the query may meet, or all that matter.
class QueryWorker {
 public:
  virtual ~QueryWorker() = default;
  virtual void collect(const DirectedLine& line, HitCollector& hits) = 0;
  virtual void collect(const Triangle& triangle, FaceCollector& faces) = 0;

  // What is asked of lines, by `collect`; an engine that knows a shorter way overrides them.
  /// Of HitMode::First or HitMode::Any.
  virtual std::optional<Hit> one_hit(const TriangleMesh& mesh, const DirectedLine& line, HitMode mode);
  /// Appends every crossing, in the order in which the line passes them.
  virtual void all_hits(const TriangleMesh& mesh, const DirectedLine& line, std::vector<Hit>& hits);
  /// Whether there is any crossing.
  virtual bool crosses(const TriangleMesh& mesh, const DirectedLine& line);
  /// How much more often the line leaves than enters.
  virtual int winding(const TriangleMesh& mesh, const DirectedLine& line);

  /// Offers every face that may be within closest.limit(); by default all.
  virtual void collect(ClosestCollector& closest) { closest.offer_all(); }

  /// Whatever was kept of earlier queries, counts excepted.
  virtual void forget() {}
  virtual QueryCounts counts() const { return {}; }
  virtual std::size_t memory_bytes() const { return sizeof(*this); }
};

/// What all threads share: the mesh in the order that suits the engine. Refers to the mesh, which outlives it.
class QueryEngine {
 public:
  virtual ~QueryEngine() = default;
  virtual std::unique_ptr<QueryWorker> worker() const = 0;
  virtual std::size_t memory_bytes() const = 0;
  /// Whether batches are answered faster if queries that start close together follow each other.
  virtual bool gains_from_order() const { return false; }
};

std::unique_ptr<QueryEngine> make_brute_engine(const TriangleMesh& mesh);
std::unique_ptr<QueryEngine> make_bvh_engine(const TriangleMesh& mesh);

using MakeEngine = std::function<std::unique_ptr<QueryEngine>(const TriangleMesh&)>;

/// An index that asks an engine of another library. `name`, which must outlive it, is the index's engine_name().
QueryIndex peer_index(TriangleMesh mesh, std::string_view name, const MakeEngine& make_engine);

/// The mesh that both are hulls of; throws InputError(InvalidOption) if they are not an outer and an inner hull of one.
TriangleMesh original_of(const ProgressiveHull& outer, const ProgressiveHull& inner);

}  // namespace prohull
