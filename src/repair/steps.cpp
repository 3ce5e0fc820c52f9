#include "repair/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/bvh.h"
#include "geometry/no_index.h"
#include "geometry/orientation.h"
#include "geometry/triangle_intersection.h"
#include "geometry/winding_number.h"
#include "prohull/detail/disjoint_sets.h"
#include "prohull/detail/finite.h"
#include "prohull/error.h"

namespace prohull {
namespace {

using Corners = std::array<VertexId, 3>;

template <class Stays>
std::size_t keep_faces(TriangleMesh& mesh, Stays stays) {
  PerFace<Corners> kept;
  kept.reserve(mesh.face_count());
  for (const FaceId f : mesh.triangles.ids())
    if (stays(f)) kept.push_back(mesh.triangles[f]);
  const std::size_t dropped = mesh.face_count() - kept.size();
  mesh.triangles = std::move(kept);
  return dropped;
}

// The connected component of every face, numbered from 0.
std::vector<std::uint32_t> component_of_faces(const TriangleMesh& mesh) {
  DisjointSets connected(mesh.vertex_count());
  for (const auto& t : mesh.triangles)
    for (const VertexId v : {t[1], t[2]}) connected.join(index(t[0]), index(v));
  std::vector<std::uint32_t> number(mesh.vertex_count(), kNone);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> component;
  component.reserve(mesh.face_count());
  for (const auto& t : mesh.triangles) {
    std::uint32_t& known = number[connected.find(index(t[0]))];
    if (known == kNone) known = count++;
    component.push_back(known);
  }
  return component;
}

/// Two faces along an edge: of each, the corner (3 face + corner) where the edge begins.
struct Neighbours {
  std::uint32_t a, b;
  bool agree;  ///< about the outside: they run along it in opposite directions
  bool is_wedge = false;
};

/// One of the faces of an edge.
struct Use {
  VertexId low, high;
  std::uint32_t corner;
  bool upwards;  ///< the face runs from `low` to `high`
};

/// Those of four faces or more that bound a wedge of the solid between them, by their angles around the edge: a face
/// that runs downwards has the solid behind it, one that runs upwards before it.
void add_wedges(std::span<const Use> uses, const TriangleMesh& mesh, std::vector<Neighbours>& result) {
  if (2 * std::ranges::count(uses, true, &Use::upwards) != std::ssize(uses)) return;
  const Vec3 from = mesh.positions[uses[0].low], axis = mesh.positions[uses[0].high] - from;
  const auto across = [&](const Use& use) {
    return cross(axis, mesh.positions[mesh.triangles[FaceId(use.corner / 3)][(use.corner + 2) % 3]] - from);
  };
  const Vec3 zero = across(uses[0]);
  std::vector<std::pair<double, const Use*>> around;
  for (const Use& use : uses) {
    const Vec3 here = across(use);
    around.push_back({std::atan2(dot(cross(zero, here), axis) / norm(axis), dot(zero, here)), &use});
  }
  std::ranges::stable_sort(around, {}, [](const auto& entry) { return entry.first; });
  std::vector<const Use*> open;
  for (int turn = 0; turn < 2; ++turn)  // a wedge may begin before the first face
    for (auto& [angle, use] : around) {
      if (!use) continue;
      if (!use->upwards) {
        if (turn == 0) open.push_back(use);
      } else if (!open.empty()) {
        result.push_back({open.back()->corner, use->corner, true, true});
        open.pop_back();
        use = nullptr;
      }
    }
}

/// With those along edges of two faces; `with_wedges` also with those of more.
std::vector<Neighbours> neighbours_of(const TriangleMesh& mesh, bool with_wedges = false) {
  std::vector<Use> uses;
  uses.reserve(3 * mesh.face_count());
  for (const FaceId f : mesh.triangles.ids())
    for (std::uint32_t c = 0; c < 3; ++c) {
      const VertexId a = mesh.triangles[f][c], b = mesh.triangles[f][(c + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), 3 * index(f) + c, a < b});
    }
  const auto key = [](const Use& use) { return std::tuple(use.low, use.high, use.corner); };
  std::ranges::sort(uses, {}, key);
  std::vector<Neighbours> result;
  for (auto i = uses.begin(), j = i; i != uses.end(); i = j) {
    while (j != uses.end() && j->low == i->low && j->high == i->high) ++j;
    if (j - i == 2) result.push_back({i->corner, (i + 1)->corner, i->upwards != (i + 1)->upwards});
    if (with_wedges && j - i > 2) add_wedges({&*i, static_cast<std::size_t>(j - i)}, mesh, result);
  }
  return result;
}

/// Where several wedges still have the same edge, the later ones get a new vertex on it, at one of its ends: so no
/// triangle changes its shape, and those are added that have no area.
void separate_wedges(TriangleMesh& mesh, const std::vector<Neighbours>& neighbours) {
  std::set<std::pair<VertexId, VertexId>> taken;
  std::set<std::uint32_t> divided;
  for (const Neighbours& n : neighbours) {
    if (!n.is_wedge) continue;
    const std::array<FaceId, 2> faces{FaceId(n.a / 3), FaceId(n.b / 3)};
    const VertexId a = mesh.triangles[faces[0]][n.a % 3], b = mesh.triangles[faces[1]][n.b % 3];
    if (taken.insert(std::minmax(a, b)).second) continue;
    if (!divided.insert(n.a / 3).second || !divided.insert(n.b / 3).second) continue;
    const Vec3 p = mesh.positions[a];
    const VertexId middle = mesh.positions.push_back(p);
    for (const auto& [f, corner] : {std::pair(faces[0], n.a % 3), {faces[1], n.b % 3}}) {
      Corners first = mesh.triangles[f];
      first[(corner + 1) % 3] = middle;
      mesh.triangles[f][corner] = middle;
      mesh.triangles.push_back(first);
    }
  }
}

/// What decides whether others lie inside of it.
struct Component {
  std::vector<Triangle> faces;
  Box box;
  bool outwards = false;
  std::optional<WindingNumber> winding;  ///< made when asked for, as `tree`
  std::optional<Bvh> tree;

  void add(const Triangle& t) {
    faces.push_back(t);
    box.extend(box_of(t));
  }
  void prepare() {
    if (winding) return;
    winding.emplace(faces);
    std::vector<Box> boxes;
    for (const Triangle& t : faces) boxes.push_back(box_of(t));
    tree.emplace(boxes);
  }
};

bool is_within(const Box& inner, const Box& outer) {
  return outer.min.x < inner.min.x && outer.min.y < inner.min.y && outer.min.z < inner.min.z &&
         inner.max.x < outer.max.x && inner.max.y < outer.max.y && inner.max.z < outer.max.z;
}

bool lies_inside(const Component& inner, Component& outer) {
  if (!is_within(inner.box, outer.box)) return false;
  outer.prepare();
  // No face meets: then all of it is where one of its corners is. Corners that touch have no winding number.
  for (const Triangle& t : inner.faces) {
    for (const Vec3& p : {t.a, t.b, t.c})
      if (outer.winding->at(p).value_or(0) < 1) return false;
    bool meets = false;
    outer.tree->visit([&](const Box& box) { return !meets && box.overlaps(box_of(t)); },
                      [&](std::uint32_t f) { meets = meets || triangles_intersect(t, outer.faces[f]); });
    if (meets) return false;
  }
  return true;
}

}  // namespace

void drop_non_finite_faces(TriangleMesh& mesh, Repairs& repairs) {
  const std::size_t before = mesh.face_count();
  mesh = with_finite_faces(std::move(mesh));
  repairs.dropped_non_finite_faces += before - mesh.face_count();
}

void weld(TriangleMesh& mesh, Repairs& repairs) {
  struct Entry {
    double x;  // of the vertex: mostly decides, without a look at its position
    VertexId vertex;
  };
  std::vector<Entry> order;
  order.reserve(mesh.vertex_count());
  PerVertex<VertexId> representative(mesh.vertex_count());
  for (const VertexId v : mesh.positions.ids()) {
    representative[v] = v;
    const Vec3& p = mesh.positions[v];
    if (is_finite(p)) order.push_back({p.x, v});  // NaN has no place in an order
  }
  const auto key = [&](const Entry& entry) {
    const Vec3& p = mesh.positions[entry.vertex];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(), [&](const Entry& a, const Entry& b) {
    if (a.x != b.x) return a.x < b.x;
    return key(a) != key(b) ? key(a) < key(b) : a.vertex < b.vertex;
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].x != order[i - 1].x || key(order[i]) != key(order[i - 1])) continue;
    representative[order[i].vertex] = representative[order[i - 1].vertex];
    ++repairs.welded_vertices;
  }
  for (auto& t : mesh.triangles)
    for (VertexId& v : t) v = representative[v];
  repairs.dropped_faces += keep_faces(mesh, [&](FaceId f) {
    const auto& [a, b, c] = mesh.triangles[f];
    return a != b && b != c && c != a;
  });
}

void drop_duplicate_faces(TriangleMesh& mesh, Repairs& repairs) {
  const auto key = [&](FaceId f) {
    Corners t = mesh.triangles[f];
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return t;
  };
  std::vector<FaceId> order;
  for (const FaceId f : mesh.triangles.ids()) order.push_back(f);
  std::ranges::sort(order, {}, [&](FaceId f) { return std::tuple(key(f), f); });
  PerFace<char> is_first(mesh.face_count(), 1);
  for (std::size_t i = 1; i < order.size(); ++i) is_first[order[i]] = key(order[i]) != key(order[i - 1]);
  repairs.dropped_duplicate_faces += keep_faces(mesh, [&](FaceId f) { return is_first[f] != 0; });
}

void turn_single_faces(TriangleMesh& mesh, Repairs& repairs) {
  struct Neighbour {
    std::uint32_t face;
    bool agrees;
  };
  std::vector<std::vector<Neighbour>> near(mesh.face_count());
  for (const Neighbours& n : neighbours_of(mesh)) {
    near[n.a / 3].push_back({n.b / 3, n.agree});
    near[n.b / 3].push_back({n.a / 3, n.agree});
  }
  enum State : char { kUnseen, kKept, kTurned };
  std::vector<State> state(mesh.face_count(), kUnseen);
  for (std::uint32_t seed = 0; seed < mesh.face_count(); ++seed) {
    if (state[seed] != kUnseen) continue;
    std::vector<std::uint32_t> part{seed};
    state[seed] = kKept;
    bool is_orientable = true;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const Neighbour& n : near[part[i]]) {
        const State wanted = (state[part[i]] == kKept) == n.agrees ? kKept : kTurned;
        if (state[n.face] == kUnseen) {
          state[n.face] = wanted;
          part.push_back(n.face);
        }
        is_orientable &= state[n.face] == wanted;
      }
    if (!is_orientable) continue;
    const auto turned =
        static_cast<std::size_t>(std::ranges::count_if(part, [&](std::uint32_t f) { return state[f] == kTurned; }));
    const State fewer = 2 * turned <= part.size() ? kTurned : kKept;
    for (const std::uint32_t f : part)
      if (state[f] == fewer) {
        std::swap(mesh.triangles[FaceId(f)][1], mesh.triangles[FaceId(f)][2]);
        ++repairs.turned_single_faces;
      }
  }
}

void split_vertices(TriangleMesh& mesh, FansAlong along, Repairs& repairs) {
  const auto corners = static_cast<std::uint32_t>(3 * mesh.face_count());
  DisjointSets fans(corners);
  const auto vertex = [&](std::uint32_t c) { return mesh.triangles[FaceId(c / 3)][c % 3]; };
  const auto next = [](std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; };
  const std::vector<Neighbours> neighbours = neighbours_of(mesh, along == FansAlong::Wedges);
  for (const Neighbours& n : neighbours)
    for (const std::uint32_t c : {n.a, next(n.a)}) fans.join(c, vertex(c) == vertex(n.b) ? n.b : next(n.b));
  PerVertex<std::uint32_t> first(mesh.vertex_count(), kNone);  // the fan that keeps the vertex
  std::vector<VertexId> name(corners);
  std::set<VertexId> split;
  for (std::uint32_t c = 0; c < corners; ++c) {
    if (fans.find(c) != c) continue;  // the least corner of a fan comes first
    const VertexId v = vertex(c);
    name[c] = v;
    if (first[v] == kNone) {
      first[v] = c;
      continue;
    }
    name[c] = VertexId(static_cast<std::uint32_t>(mesh.positions.size()));
    const Vec3 p = mesh.positions[v];
    mesh.positions.push_back(p);
    split.insert(v);
  }
  for (std::uint32_t c = 0; c < corners; ++c) mesh.triangles[FaceId(c / 3)][c % 3] = name[fans.find(c)];
  repairs.split_vertices += split.size();
  separate_wedges(mesh, neighbours);
}

void turn_outwards(TriangleMesh& mesh, std::size_t components, bool fill_crossing, Repairs& repairs) {
  const std::vector<std::uint32_t> component = component_of_faces(mesh);
  const auto triangle = [&](std::size_t f) { return mesh.triangle(FaceId(static_cast<std::uint32_t>(f))); };
  const Orientation facing = orientation(triangle, component, components);
  const auto is_turned = [&](Facing own) {
    return facing.turn_all != (own == Facing::InsideOut || own == Facing::Unclear);
  };
  for (const FaceId f : mesh.triangles.ids()) {
    const Facing own = facing.components[component[index(f)]];
    if (own == Facing::Unclear && !fill_crossing)
      throw InputError(
          Defect::InconsistentOrientation,
          fmt::format("the component of face {} {}, and crosses or repeats others: turn it, or make it a "
                      "cavity of one of them",
                      index(f),
                      facing.turn_all ? "looks outwards, while the mesh as a whole is inside out" : "is inside out"));
    if (own == Facing::Unclear) ++repairs.crossing_faces;
    if (!is_turned(own)) continue;
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    repairs.turned_faces += own == Facing::Unclear ? 0 : 1;
  }
  for (const Facing own : facing.components)
    if (own == Facing::Unclear)
      ++repairs.crossing_components;
    else
      repairs.turned_components += is_turned(own) ? 1 : 0;
}

void drop_nested_components(TriangleMesh& mesh, std::size_t components, Repairs& repairs) {
  if (components < 2) return;
  const std::vector<std::uint32_t> component = component_of_faces(mesh);
  std::vector<Component> parts(components);
  for (const FaceId f : mesh.triangles.ids()) parts[component[index(f)]].add(mesh.triangle(f));
  for (Component& part : parts) part.outwards = volume_sign(part.faces) > 0;
  std::vector<char> nested(components, 0);
  for (std::size_t inner = 0; inner < components; ++inner)
    for (std::size_t outer = 0; outer < components && !nested[inner]; ++outer)
      nested[inner] = outer != inner && parts[outer].outwards && lies_inside(parts[inner], parts[outer]);
  repairs.dropped_components += static_cast<std::size_t>(std::ranges::count(nested, 1));
  repairs.dropped_component_faces += keep_faces(mesh, [&](FaceId f) { return !nested[component[index(f)]]; });
}

}  // namespace prohull
