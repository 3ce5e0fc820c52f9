#include "robot/motion/path_proof.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "robot/motion/joint_chain.h"
#include "robot/motion/kinematics.h"

namespace prohull::robot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const char* rounding_hides(double gap) {
  return gap > 0 ? "rounding hides whether they are closer than the gap" : "rounding hides whether they touch";
}

/// A piece of the path, and what is known there.
struct Piece {
  double begin = 0, end = 0;    // places
  double distance = 0;          // in the middle, a lower bound
  double change = 0;            // of the distance, at most, in all of it
  std::size_t number = 0;       // in the order in which they were made
  bool is_free = false;         // otherwise the bodies may meet there
  bool may_be_smaller = false;  // otherwise rounding decides
};

/// What may still be free comes before what is to be known better, and large changes before small ones.
struct IsLessUrgent {
  bool operator()(const Piece& x, const Piece& y) const {
    return std::tuple(!x.is_free, x.change, y.number) < std::tuple(!y.is_free, y.change, x.number);
  }
};

std::vector<Vec3> corners_of(const PathBody& body) { return body.shape ? body.shape->corners : std::vector<Vec3>(); }

/// A mesh of the world may be large, and its own arms are never the shorter ones: the corners of its box are enough.
std::vector<Vec3> corners_in_root(const PathBody& world) {
  Box box;
  for (const Vec3& corner : corners_of(world)) box.extend(corner);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                       (i & 4) != 0 ? box.max.z : box.min.z});
  return corners;
}

class PathSearch {
 public:
  PathSearch(const Robot& robot, const JointPath& path, std::span<const JointRange> ranges, const PathBody& a,
             const PathBody& b, const PathProofOptions& options)
      : robot_(robot),
        path_(path),
        a_(a),
        b_(b),
        chain_(robot, *a.link, b.link ? *b.link : root_of(robot, *a.link), corners_of(a),
               b.link ? corners_of(b) : corners_in_root(b), ranges),
        options_(options),
        end_(path.length()),
        record_(options.keep_trees, 1) {
    for (const std::size_t joint : chain_.freedoms()) numbers_.push_back(path_.number_of(joint));
  }

  PathPairProof run(ProgressMeter& meter) {
    result_.why = !a_.unread.empty() ? a_.unread : !b_.unread.empty() ? b_.unread : chain_.obstacle();
    if (!result_.why.empty()) return with_verdict({{.begin = 0, .end = path_.length()}});
    result_.nothing_moves = std::ranges::none_of(numbers_, [&](const auto& k) { return k && path_.is_moved(*k); });
    if (!meets_at(0)) {
      meets_at(path_.length());
      look_at(0, path_.length());
    }
    while (!open_.empty() && result_.cells + 2 <= options_.cells) {
      const Piece piece = open_.top();
      open_.pop();
      meter.go_on();
      if (piece.begin >= end_ && !piece.is_free) continue;
      if (piece.may_be_smaller)
        halve(piece);
      else
        done_.push_back(piece);
    }
    result_.why = !open_.empty() ? kCellsUsedUp : touches_ ? kTouchesMesh : rounding_hides(options_.gap);
    for (; !open_.empty(); open_.pop()) done_.push_back(open_.top());
    return with_verdict(std::move(done_));
  }

 private:
  JointChain::Motion motion(double begin, double end) const {
    std::vector<JointReach> reaches;
    for (std::size_t f = 0; f < numbers_.size(); ++f)
      reaches.push_back(numbers_[f] ? path_.reach(*numbers_[f], begin, end)
                                    : JointReach{chain_.ranges()[f].middle(), 0});
    return chain_.motion(reaches);
  }

  double distance_of_balls(const Pose& pose) const {
    return robot::distance_of_balls(*a_.shape, *b_.shape, pose, chain_.rounding());
  }

  Closest closest(const Pose& pose, double limit) const { return closest_parts(*a_.shape, *b_.shape, pose, limit); }

  /// Looks at a single place.
  bool meets_at(double place) {
    const Pose pose = motion(place, place).pose;
    return distance_of_balls(pose) <= options_.gap && meets_at(place, pose, closest(pose, just_above(options_.gap)));
  }

  /// Bodies meet where the meshes within them do. `around` is of the meshes around them, which tell the faces.
  bool meets_at(double place, const Pose& pose, const Closest& around) {
    if (around.separation.upper > options_.gap) return false;
    if (is_curved() && within(pose, options_.gap).separation.upper > options_.gap) return false;
    take_witness(place, pose, around);
    return true;
  }

  /// The closest faces of the meshes that lie within the bodies.
  Closest within(const Pose& pose, double limit) const {
    return closest_within(*a_.shape, *b_.shape, pose, just_above(limit));
  }

  bool is_curved() const { return !a_.shape->within.empty() || !b_.shape->within.empty(); }

  void take_witness(double place, const Pose& pose, const Closest& found) {
    end_ = place;
    result_.verdict = PathVerdict::Meets;
    result_.part_a = found.part_a, result_.part_b = found.part_b;
    result_.faces = {found.separation.face_a, found.separation.face_b};
    if (found.separation.collide()) result_.faces = first_faces(*a_.shape, *b_.shape, pose, found);
    result_.positions = path_.positions_at(place);
    follow(robot_, result_.positions);
  }

  void halve(const Piece& piece) {
    const double middle = middle_place(piece.begin, piece.end);
    record_.halve(piece.number, 0, result_.cells);
    look_at(piece.begin, middle);
    if (middle < end_) look_at(middle, piece.end);
  }

  void look_at(double begin, double end) {
    Piece piece{.begin = begin, .end = end, .number = result_.cells++};
    const JointChain::Motion motion = this->motion(begin, end);
    double rounding = chain_.rounding();
    piece.change = motion.change;
    piece.distance = distance_of_balls(motion.pose);
    if (options_.distances || !(piece.distance > piece.change + options_.gap + margin())) {
      const double limit = options_.distances ? kInfinity : just_above(motion.change + options_.gap + 2 * margin());
      const Closest found = closest(motion.pose, limit);
      piece.distance = std::max(piece.distance, found.separation.lower);
      rounding = std::max(rounding, std::min(found.separation.upper, limit) - found.separation.lower);
      if (!options_.distances && piece.distance <= piece.change + options_.gap &&
          stay_apart(motion, found.separation)) {
        piece.distance = piece.change + options_.gap, piece.is_free = true;
        return done_.push_back(piece);
      }
      const double middle = middle_place(begin, end);
      if (middle < end_ && meets_at(middle, motion.pose, found))
        piece.end = middle;
      else if (is_curved() && found.separation.upper <= options_.gap)
        rounding = std::max(rounding, doubt_of_mesh(motion));
    }
    piece.is_free = piece.distance > piece.change + options_.gap;
    if (is_done(piece)) {
      if (piece.distance <= piece.change + options_.gap + margin()) record_.give_up();
      return done_.push_back(piece);
    }
    const double middle = middle_place(piece.begin, piece.end);
    piece.may_be_smaller = piece.begin < middle && middle < piece.end && end - begin > path_.rounding_of_times(begin) &&
                           std::ranges::any_of(motion.parts, [&](double part) { return part > rounding; });
    if (piece.begin < piece.end)
      open_.push(piece);
    else
      done_.push_back(piece);
  }

  /// Whether a plane across the way between the closest faces stays between the bodies in all of the motion. To look at
  /// all faces takes longer than halving the piece.
  bool stay_apart(const JointChain::Motion& motion, const Separation& closest) {
    const Vec3 way = closest.point_b - closest.point_a;
    const auto are_farther_than = [&](double gap) { return stay_apart_across(way, *a_.shape, *b_.shape, motion, gap); };
    const bool is_free = are_farther_than(options_.gap);
    if (is_free && record_.is_kept() && !are_farther_than(options_.gap + margin())) record_.give_up();
    return is_free;
  }

  /// Where meshes around curved shapes meet: parts of the motion that are not greater are not looked at. There the
  /// shapes may touch, though what lies within them does not.
  double doubt_of_mesh(const JointChain::Motion& motion) {
    constexpr double kShare = 0.0625;
    const double apart = within(motion.pose, options_.gap + motion.change / kShare).separation.lower - options_.gap;
    if (!(motion.change <= kShare * apart)) return 0;
    touches_ = true;
    return motion.change;
  }

  /// By how much a checker may see a distance otherwise, if it has to.
  double margin() const { return record_.is_kept() ? chain_.rounding() : 0; }

  /// With a distance a of at least four times the change, the bound a - change is no less than 0.6 of any distance in
  /// the piece, which is at most a + change.
  bool is_done(const Piece& piece) const {
    constexpr double kSharp = 4;
    if (!(piece.distance > piece.change + options_.gap)) return false;
    return !options_.distances || piece.distance >= kSharp * piece.change;
  }

  PathPairProof with_verdict(std::vector<Piece> pieces) {
    std::ranges::sort(pieces, {}, &Piece::begin);
    std::optional<JointRange> undecided;
    for (const Piece& piece : pieces) {
      if (piece.is_free) {
        result_.bounds.push_back({piece.begin, piece.end, piece.distance - piece.change});
        continue;
      }
      if (result_.verdict == PathVerdict::Meets && piece.begin >= end_) continue;
      if (!undecided) undecided = JointRange{piece.begin, piece.end};
      if (undecided->upper == piece.begin) undecided->upper = piece.end;
    }
    if (undecided && result_.verdict == PathVerdict::Free) result_.verdict = PathVerdict::Open;
    const bool is_open = result_.verdict == PathVerdict::Open;
    if (!undecided || (!is_open && result_.why == rounding_hides(options_.gap))) result_.why.clear();
    if (result_.verdict == PathVerdict::Free) result_.tree = record_.tree();
    const bool meets = result_.verdict == PathVerdict::Meets;
    result_.begin = undecided ? undecided->lower : end_;
    result_.end = meets || !undecided ? end_ : undecided->upper;
    return std::move(result_);
  }

  const Robot& robot_;
  const JointPath& path_;
  const PathBody &a_, &b_;
  const JointChain chain_;
  const PathProofOptions& options_;
  std::vector<std::optional<std::size_t>> numbers_;  // of the chain's freedoms on the path
  double end_;  // of what is looked at: the first place where they are known to meet
  std::priority_queue<Piece, std::vector<Piece>, IsLessUrgent> open_;
  std::vector<Piece> done_;
  CellRecord record_;
  bool touches_ = false;  // somewhere it is the mesh around a curved shape that meets
  PathPairProof result_;
};

/// The least bound of all pairs between any two places at which one of them changes.
std::vector<DistanceBound> least_of(const std::vector<PathPairProof>& pairs, double length) {
  std::vector<double> places{0, length};
  for (const PathPairProof& pair : pairs)
    for (const DistanceBound& bound : pair.bounds) places.insert(places.end(), {bound.begin, bound.end});
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<DistanceBound> curve;
  for (std::size_t i = 0; i + 1 < std::max<std::size_t>(places.size(), 2); ++i)
    curve.push_back({places[i], places[std::min(i + 1, places.size() - 1)], kInfinity});
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    auto bound = pairs[p].bounds.begin();
    for (DistanceBound& part : curve) {
      while (bound != pairs[p].bounds.end() && bound->end <= part.begin && bound->begin < bound->end) ++bound;
      const bool is_known = bound != pairs[p].bounds.end() && bound->begin <= part.begin;
      const double distance = is_known ? bound->distance : 0;
      if (distance < part.distance) part.distance = distance, part.pair = p;
    }
  }
  std::vector<DistanceBound> joined;
  for (const DistanceBound& part : curve)
    if (!joined.empty() && joined.back().distance == part.distance && joined.back().pair == part.pair)
      joined.back().end = part.end;
    else
      joined.push_back(part);
  return joined;
}

}  // namespace

std::string_view name_of(PathVerdict verdict) {
  constexpr std::string_view kNames[]{"free", "meets", "open"};
  return kNames[static_cast<std::size_t>(verdict)];
}

PathVerdict PathProof::verdict() const {
  const auto any = [&](PathVerdict verdict) {
    return std::ranges::find(pairs, verdict, &PathPairProof::verdict) != pairs.end();
  };
  return any(PathVerdict::Meets) ? PathVerdict::Meets : any(PathVerdict::Open) ? PathVerdict::Open : PathVerdict::Free;
}

double PathProof::free_until() const {
  double place = kInfinity;
  for (const PathPairProof& pair : pairs) place = std::min(place, pair.begin);
  return place;
}

const PathPairProof* PathProof::first() const {
  const PathVerdict whole = verdict();
  const PathPairProof* first = nullptr;
  const auto place = [&](const PathPairProof& pair) { return whole == PathVerdict::Meets ? pair.end : pair.begin; };
  for (const PathPairProof& pair : pairs)
    if (whole != PathVerdict::Free && pair.verdict == whole && (!first || place(pair) < place(*first))) first = &pair;
  return first;
}

std::size_t PathProof::cells() const {
  std::size_t cells = 0;
  for (const PathPairProof& pair : pairs) cells += pair.cells;
  return cells;
}

std::vector<PathProof> prove_paths(const Robot& robot, std::span<const JointPath> paths,
                                   std::span<const PathBody> bodies, std::span<const BodyPair> pairs,
                                   const PathProofOptions& options) {
  std::vector<PathProof> proofs(paths.size());
  std::vector<Robot> moved;
  std::vector<std::vector<JointRange>> ranges;
  for (const JointPath& path : paths) moved.push_back(moved_by(robot, path)), ranges.push_back(path.ranges());
  for (PathProof& proof : proofs) proof.pairs.resize(pairs.size());
  ProgressMeter meter(options.progress, "prove");
  in_parallel(paths.size() * pairs.size(), options.threads, meter, [&](std::size_t task) {
    const std::size_t p = task / pairs.size(), i = task % pairs.size();
    const auto& [a, b] = pairs[i];
    PathSearch search(moved[p], paths[p], ranges[p], bodies[a], bodies[b], options);
    PathPairProof& proof = proofs[p].pairs[i] = search.run(meter);
    proof.a = a, proof.b = b;
  });
  for (std::size_t p = 0; options.distances && p < paths.size(); ++p)
    proofs[p].curve = least_of(proofs[p].pairs, paths[p].length());
  return proofs;
}

}  // namespace prohull::robot
