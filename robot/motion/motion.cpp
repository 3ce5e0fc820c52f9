#include "robot/motion/motion.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "prohull/detail/finite.h"
#include "prohull/detail/progress_meter.h"
#include "prohull/detail/shapes.h"
#include "robot/motion/joint_paths.h"
#include "robot/motion/proof_body.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

/// Around all vertices.
Ball ball_around(const std::array<const TriangleMesh*, 3>& meshes) {
  Box box;
  for (const TriangleMesh* mesh : meshes) box.extend(bounding_box(*mesh));
  Ball ball{.center = box.center(), .radius = 0};
  for (const TriangleMesh* mesh : meshes)
    for (const auto& corners : mesh->triangles)
      for (const VertexId v : corners) ball.radius = std::max(ball.radius, norm(mesh->positions[v] - ball.center));
  return ball;
}

/// A link in the three geometries that are compared.
struct Body {
  CollisionIndex visual, hull, convex;
  Ball ball;
  bool has_hull = false;  // of its own
};

const TriangleMesh& first_with_faces(const TriangleMesh& a, const TriangleMesh& b, const TriangleMesh& c) {
  return a.face_count() > 0 ? a : b.face_count() > 0 ? b : c;
}

std::optional<Body> body_of(const Bodies& bodies, std::size_t link) {
  const auto mesh_of = [&](const std::vector<TriangleMesh>& meshes) {
    return link < meshes.size() ? with_finite_faces(meshes[link]) : TriangleMesh();
  };
  const TriangleMesh visual = mesh_of(bodies.visual), hull = mesh_of(bodies.hull), convex = mesh_of(bodies.convex);
  const TriangleMesh& as_visual = first_with_faces(visual, hull, convex);
  const TriangleMesh& as_hull = first_with_faces(hull, visual, convex);
  const TriangleMesh& as_convex = first_with_faces(convex, hull, visual);
  if (as_visual.face_count() == 0) return {};
  return Body{CollisionIndex(as_visual), CollisionIndex(as_hull), CollisionIndex(as_convex),
              ball_around({&as_visual, &as_hull, &as_convex}), hull.face_count() > 0};
}

/// Whether rounding cannot make the two meet, `b` being where `pose` puts it.
bool are_apart(const Ball& a, const Ball& b, const Pose& pose) {
  constexpr double kRounding = 1e-12;  // far above what the few operations here and in `placed` lose
  const double slack = kRounding * (norm(a.center) + norm(b.center) + norm(pose.translation) + a.radius + b.radius);
  return !(norm(placed(pose, b.center) - a.center) <= a.radius + b.radius + slack);  // true where a pose is not finite
}

/// Closed meshes are asked so that "no" holds for all that they enclose.
bool enclosures_meet(const CollisionIndex& a, const CollisionIndex& b, const Pose& pose) {
  return a.is_solid() && b.is_solid() ? may_collide(a, {}, b, pose) : collide(a, {}, b, pose);
}

/// Pairs that are compared meet in a configuration, by some of the geometries.
struct Contact {
  std::size_t pair = 0;
  bool visual = false, hull = false, convex = false;
};

/// Two bodies that are close to each other, the second where the pose puts it in the frame of the first.
struct Check {
  std::size_t pair = 0;
  const Body *a = nullptr, *b = nullptr;
  Pose pose;
};

bool visual_meets(const Check& c) { return collide(c.a->visual, {}, c.b->visual, c.pose); }
bool hull_meets(const Check& c) { return enclosures_meet(c.a->hull, c.b->hull, c.pose); }
bool convex_meets(const Check& c) { return enclosures_meet(c.a->convex, c.b->convex, c.pose); }

/// In microseconds, in the fastest of three runs, as other programs may slow one down.
double mean_time(const std::vector<Check>& checks, bool (*meets)(const Check&), ProgressMeter& meter) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kAtOnce = 16;  // checks between two questions, which are not timed
  Clock::duration least = Clock::duration::max();
  for (int run = 0; run < 3; ++run) {
    Clock::duration all{0};
    for (std::size_t first = 0; first < checks.size(); first += kAtOnce) {
      meter.go_on();
      const auto start = Clock::now();
      for (std::size_t i = first; i < std::min(first + kAtOnce, checks.size()); ++i) meets(checks[i]);
      all += Clock::now() - start;
    }
    least = std::min(least, all);
  }
  return checks.empty() ? 0
                        : std::chrono::duration<double, std::micro>(least).count() / static_cast<double>(checks.size());
}

class Motion {
 public:
  Motion(const Robot& robot, const Bodies& bodies, const MotionOptions& options) : robot_(robot), options_(options) {
    for (std::size_t link = 0; link < robot.links.size(); ++link) bodies_.push_back(body_of(bodies, link));
    const JointPaths paths(robot);
    for (std::size_t a = 0; a < bodies_.size(); ++a)
      for (std::size_t b = a + 1; b < bodies_.size(); ++b)
        if (bodies_[a] && bodies_[b]) add_pair(a, b, paths);
  }

  MotionResult run() {
    ProgressMeter meter(options_.progress, "move");
    std::vector<std::vector<Contact>> contacts(options_.configurations);
    in_parallel(contacts.size(), options_.threads, meter, [&](std::size_t k) { contacts[k] = contacts_in(k); });
    MotionResult result = result_of(contacts);
    const std::vector<Check> timed = first_checks(meter);
    result.visual_us = mean_time(timed, visual_meets, meter);
    result.hull_us = mean_time(timed, hull_meets, meter);
    return result;
  }

 private:
  void add_pair(std::size_t a, std::size_t b, const JointPaths& paths) {
    MotionPair pair{a, b};
    if (have_hulls(pair) && paths.are_adjacent(a, b)) pair.kind = PairKind::Adjacent;
    pairs_.push_back(pair);
    is_known_.push_back(have_hulls(pair) && paths.are_sampled(a, b));
  }

  bool have_hulls(const MotionPair& pair) const { return bodies_[pair.a]->has_hull && bodies_[pair.b]->has_hull; }

  /// The checks of the pairs whose bounding spheres meet.
  std::vector<Check> checks_in(std::size_t configuration) const {
    const std::vector<Pose> poses = link_poses(robot_, random_positions(robot_, options_.seed, configuration));
    std::vector<Check> checks;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const MotionPair& pair = pairs_[p];
      if (pair.kind == PairKind::Adjacent) continue;
      const Check check{p, &*bodies_[pair.a], &*bodies_[pair.b], composed(inverse(poses[pair.a]), poses[pair.b])};
      if (!are_apart(check.a->ball, check.b->ball, check.pose)) checks.push_back(check);
    }
    return checks;
  }

  std::vector<Contact> contacts_in(std::size_t configuration) const {
    std::vector<Contact> contacts;
    for (const Check& check : checks_in(configuration)) {
      const Contact contact{check.pair, visual_meets(check), hull_meets(check), convex_meets(check)};
      if (contact.visual || contact.hull || contact.convex) contacts.push_back(contact);
    }
    return contacts;
  }

  /// The checks whose time is measured.
  std::vector<Check> first_checks(ProgressMeter& meter) const {
    constexpr std::size_t kChecks = 1000;
    std::vector<Check> first;
    for (std::size_t k = 0; k < options_.configurations && first.size() < kChecks; ++k) {
      meter.go_on();
      for (const Check& check : checks_in(k))
        if (first.size() < kChecks) first.push_back(check);
    }
    return first;
  }

  MotionResult result_of(const std::vector<std::vector<Contact>>& contacts) {
    for (const auto& in_configuration : contacts)
      for (const Contact& contact : in_configuration) count(pairs_[contact.pair], contact);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_known_[p] && pairs_[p].kind != PairKind::Adjacent) pairs_[p].kind = kind_of(pairs_[p]);
    MotionResult result{.configurations = options_.configurations, .seed = options_.seed, .pairs = pairs_};
    for (const auto& in_configuration : contacts) count(result, in_configuration);
    return result;
  }

  void count(MotionPair& pair, const Contact& contact) const {
    pair.visual += contact.visual;
    pair.hull += contact.hull;
    pair.convex += contact.convex;
    pair.false_hull += contact.hull && !contact.visual;
    pair.false_convex += contact.convex && !contact.visual;
    pair.missed += contact.visual && !contact.hull && have_hulls(pair);
  }

  PairKind kind_of(const MotionPair& pair) const {
    if (options_.configurations == 0) return PairKind::Sometimes;
    const std::size_t hits = std::max(pair.hull, pair.visual);  // more by the visual geometry: a failed certificate
    if (hits == 0) return PairKind::Never;
    return 20 * hits >= 19 * options_.configurations ? PairKind::Always : PairKind::Sometimes;
  }

  /// Whether any pair that can be free collides in this configuration.
  void count(MotionResult& result, const std::vector<Contact>& contacts) const {
    Contact any;
    for (const Contact& contact : contacts) {
      if (!is_known_[contact.pair] || result.pairs[contact.pair].kind == PairKind::Always) continue;
      any.visual |= contact.visual;
      any.hull |= contact.hull;
      any.convex |= contact.convex;
    }
    result.visual_configurations += any.visual;
    result.hull_configurations += any.hull;
    result.convex_configurations += any.convex;
  }

  const Robot& robot_;
  const MotionOptions& options_;
  std::vector<std::optional<Body>> bodies_;  // of each link
  std::vector<MotionPair> pairs_;
  std::vector<bool> is_known_;  // of each pair: the counts tell its kind
};

PairKind kind_of(PairVerdict verdict, PairKind sampled) {
  switch (verdict) {
    case PairVerdict::Never:
      return PairKind::ProvenNever;
    case PairVerdict::Always:
      return PairKind::ProvenAlways;
    case PairVerdict::Meets:
      return sampled == PairKind::Never ? PairKind::Sometimes : sampled;
    default:
      return sampled;
  }
}

/// None where the link has no curved shapes.
std::optional<TriangleMesh> mesh_within(const std::vector<TriangleMesh>& meshes, std::size_t link) {
  if (link >= meshes.size() || meshes[link].face_count() == 0) return {};
  return with_finite_faces(meshes[link]);
}

bool visual_meets(const Robot& robot, const Bodies& bodies, const PairProof& proof) {
  const auto mesh_of = [&](std::size_t link) {
    return with_finite_faces(mesh_within(bodies.visual_within, link).value_or(bodies.visual[link]));
  };
  const TriangleMesh a = mesh_of(proof.a), b = mesh_of(proof.b);
  if (a.face_count() == 0 || b.face_count() == 0) return false;
  const std::vector<Pose> poses = link_poses(robot, proof.positions);
  return collide(CollisionIndex(a), poses[proof.a], CollisionIndex(b), poses[proof.b]);
}

}  // namespace

std::string_view name_of(PairKind kind) {
  constexpr std::string_view kNames[]{"adjacent", "sampled-always", "sampled-never", "always", "never", "sometimes"};
  return kNames[static_cast<std::size_t>(kind)];
}

bool is_sampled(PairKind kind) { return kind == PairKind::Always || kind == PairKind::Never; }

std::size_t MotionResult::sum(std::size_t MotionPair::*count) const {
  std::size_t total = 0;
  for (const MotionPair& pair : pairs) total += pair.*count;
  return total;
}

MotionResult check_motion(const Robot& robot, const Bodies& bodies, const MotionOptions& options) {
  return Motion(robot, bodies, options).run();
}

PairVerdicts verdicts_of(const MotionResult& motion) {
  PairVerdicts verdicts;
  for (const MotionPair& pair : motion.pairs) {
    if (!pair.proof) continue;
    const PairVerdict verdict = pair.proof->verdict;
    verdicts.never += verdict == PairVerdict::Never, verdicts.always += verdict == PairVerdict::Always;
    verdicts.meets += verdict == PairVerdict::Meets, verdicts.open += verdict == PairVerdict::Open;
  }
  return verdicts;
}

void add_proofs(const Robot& robot, const Bodies& bodies, const ProofOptions& options, MotionResult& motion) {
  const auto has_hull = [&](std::size_t link) {
    return link < bodies.hull.size() && bodies.hull[link].face_count() > 0;
  };
  std::vector<MotionPair*> asked;
  std::vector<LinkPair> links;
  for (MotionPair& pair : motion.pairs) {
    if (pair.kind == PairKind::Adjacent || !has_hull(pair.a) || !has_hull(pair.b)) continue;
    asked.push_back(&pair), links.emplace_back(pair.a, pair.b);
  }
  std::vector<std::optional<ProofBody>> hulls(bodies.hull.size());
  for (const auto& [a, b] : links)
    for (const std::size_t link : {a, b}) {
      if (hulls[link]) continue;
      const TriangleMesh hull = with_finite_faces(bodies.hull[link]);
      const std::optional<TriangleMesh> within = mesh_within(bodies.hull_within, link);
      hulls[link].emplace(std::span(&hull, 1), std::span(within ? &*within : nullptr, within ? 1 : 0));
    }
  const std::vector<PairProof> proofs = prove_pairs(robot, hulls, links, options);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    MotionPair& pair = *asked[i];
    pair.proof = proofs[i];
    pair.kind = kind_of(proofs[i].verdict, pair.kind);
    if (!proofs[i].positions.empty()) pair.visual_meets_at_witness = visual_meets(robot, bodies, proofs[i]);
  }
}

}  // namespace prohull::robot
