#include "robot/files/joint_forest.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "prohull/detail/disjoint_sets.h"
#include "robot/transform.h"

namespace prohull::robot {
namespace {

/// Listed joints that move one link against another, one after the other.
struct Edge {
  std::size_t first = 0, count = 0;  // listed joints
  std::size_t parent = 0, child = 0;
};

/// The joint with parent and child exchanged.
Joint turned(Joint joint) {
  const Pose rotation{joint.origin.rotation, {}};
  joint.anchor = placed(joint.origin, joint.anchor);
  joint.axis = -placed(rotation, joint.axis);
  joint.origin = inverse(joint.origin);
  std::swap(joint.parent, joint.child);
  return joint;
}

class Forest {
 public:
  Forest(Robot& robot, std::vector<ListedJoint>& listed, const std::vector<Pose>& in_world, JointType unjoined,
         std::vector<std::string>& notes)
      : robot_(robot),
        listed_(listed),
        in_world_(in_world),
        unjoined_(unjoined),
        notes_(notes),
        links_(robot.links.size()),
        trees_(links_),
        edges_of_(links_),
        reached_(links_),
        is_child_(links_),
        new_index_(listed.size(), kNone) {}

  void build() {
    for (const Edge& edge : edges())
      if (edge.parent == kWorld)
        to_world_.push_back(edge);
      else if (trees_.find(edge.parent) != trees_.find(edge.child))
        keep(edge);
      else
        leave_out(edge);
    const bool needs_world = links_ - kept_.size() > 1 || moves_in_world();  // each edge joins two trees
    if (needs_world) robot_.links.push_back({"world", {}, {}, 0});
    for (const Edge& edge : to_world_) grow_from_world(edge, needs_world);
    for (const bool children : {false, true})
      for (std::size_t link = 0; link < links_; ++link)
        if (!reached_[link] && is_child_[link] == children) grow_alone(link, needs_world);
    renumber_mimics();
  }

 private:
  std::vector<Edge> edges() const {
    std::vector<Edge> result;
    for (std::size_t i = 0; i < listed_.size(); ++i)
      if (listed_[i].continues)
        ++result.back().count;
      else
        result.push_back({i, 1, listed_[i].joint.parent, listed_[i].joint.child});
    return result;
  }

  bool moves_in_world() const {
    return std::ranges::any_of(to_world_, [&](const Edge& edge) {
      const auto joints = std::span(listed_).subspan(edge.first, edge.count);
      return std::ranges::any_of(joints, [](const ListedJoint& it) { return moves(it.joint); });
    });
  }

  void keep(const Edge& edge) {
    edges_of_[edge.parent].push_back(kept_.size());
    edges_of_[edge.child].push_back(kept_.size());
    is_child_[edge.child] = true;
    trees_.join(edge.parent, edge.child);
    kept_.push_back(edge);
  }
  void leave_out(const Edge& edge) {
    const Joint& joint = listed_[edge.first].joint;
    notes_.push_back(
        fmt::format("joint '{}' in line {} closes a loop of joints and is not read: the links move as if it "
                    "were not there",
                    joint.name, joint.line));
  }

  void add(const Edge& edge, bool turn) {
    for (std::size_t i = 0; i < edge.count; ++i) {
      const std::size_t which = edge.first + (turn ? edge.count - 1 - i : i);
      new_index_[which] = robot_.joints.size();
      const Joint& joint = listed_[which].joint;
      robot_.joints.push_back(turn ? turned(joint) : joint);
    }
  }

  void grow_from_world(Edge edge, bool has_world) {
    if (reached_[edge.child]) return leave_out(edge);
    if (has_world) {
      for (std::size_t i = 0; i < edge.count; ++i) listed_[edge.first + i].joint.parent = links_;
      add(edge, false);
    }
    grow(edge.child);
  }
  void grow_alone(std::size_t root, bool has_world) {
    if (has_world) {
      Joint joint;
      joint.name = "world_" + robot_.links[root].name, joint.type = unjoined_, joint.line = robot_.links[root].line;
      joint.parent = links_, joint.child = root, joint.origin = in_world_[root];
      robot_.joints.push_back(std::move(joint));
    }
    grow(root);
  }
  void grow(std::size_t root) {
    std::vector<std::size_t> front{root};
    reached_[root] = true;
    for (std::size_t at = 0; at < front.size(); ++at)
      for (const std::size_t edge : edges_of_[front[at]]) {
        const bool turn = kept_[edge].child == front[at];
        const std::size_t next = turn ? kept_[edge].parent : kept_[edge].child;
        if (reached_[next]) continue;
        reached_[next] = true;
        add(kept_[edge], turn);
        front.push_back(next);
      }
  }

  void renumber_mimics() {
    for (Joint& joint : robot_.joints) {
      if (!joint.mimic) continue;
      const std::size_t followed = new_index_[joint.mimic->joint];
      if (followed != kNone) {
        joint.mimic->joint = followed;
        continue;
      }
      notes_.push_back(fmt::format("joint '{}' follows joint '{}', which is not read: it moves on its own here",
                                   joint.name, listed_[joint.mimic->joint].joint.name));
      joint.mimic.reset();
    }
  }

  Robot& robot_;
  std::vector<ListedJoint>& listed_;
  const std::vector<Pose>& in_world_;
  const JointType unjoined_;
  std::vector<std::string>& notes_;
  const std::size_t links_;  // the world comes after them
  DisjointSets trees_;
  std::vector<Edge> kept_, to_world_;
  std::vector<std::vector<std::size_t>> edges_of_;  // of each link, in kept_
  std::vector<bool> reached_, is_child_;
  std::vector<std::size_t> new_index_;  // of listed joints
};

}  // namespace

void set_joints(Robot& robot, std::vector<ListedJoint> listed, const std::vector<Pose>& in_world, JointType unjoined,
                std::vector<std::string>& notes) {
  Forest(robot, listed, in_world, unjoined, notes).build();
}

}  // namespace prohull::robot
