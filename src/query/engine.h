#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "prohull/mesh_query.h"
#include "query/line.h"

namespace prohull {

/// Takes the faces that an engine thinks a line may cross, each at most once, decides exactly, and keeps what is asked.
class HitCollector {
 public:
  HitCollector(const TriangleMesh& mesh, const DirectedLine& line, HitMode mode)
      : mesh_(mesh), line_(line), mode_(mode), limit_(line.t_end) {}

  void offer(FaceId face);

  /// Nothing more is of interest.
  bool is_complete() const { return mode_ == HitMode::Any && best_; }
  /// Crossings beyond this t are not of interest.
  double limit() const { return limit_; }

  /// The one asked for by HitMode::First or HitMode::Any.
  std::optional<Hit> best() const;
  /// Of HitMode::All, in the order in which the line crosses them.
  std::vector<Hit> all();

 private:
  struct Found {
    FaceId face;
    bool entering;
    Parameter at;
  };
  bool before(const Found& one, const Found& other) const;
  Hit hit(const Found& found) const;

  const TriangleMesh& mesh_;
  const DirectedLine& line_;
  HitMode mode_;
  double limit_;
  std::optional<Found> best_;
  std::vector<Found> all_;
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
};

std::unique_ptr<QueryEngine> make_brute_engine(const TriangleMesh& mesh);
std::unique_ptr<QueryEngine> make_bvh_engine(const TriangleMesh& mesh);

/// An index that asks an engine of another library, made to be measured. `name`, which must outlive it, is the index's
/// engine_name().
QueryIndex peer_index(TriangleMesh mesh, std::string_view name,
                      std::unique_ptr<QueryEngine> (*make_engine)(const TriangleMesh&));

}  // namespace prohull
