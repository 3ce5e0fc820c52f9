#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "prohull/detail/refuse.h"
#include "robot/files/named_files.h"
#include "robot/files/sdf.h"
#include "robot/files/sdf_frames.h"
#include "robot/files/urdf.h"
#include "robot/files/xml_lines.h"
#include "robot/files/xml_values.h"

namespace prohull::robot {
namespace {

/// A collision element that is to be written. Its parts are bytes of XML.
struct Piece {
  std::string pose;      ///< <origin> or <pose>; empty: none
  std::string form;      ///< the child of <geometry>; empty: `geometry` is given
  std::string geometry;  ///< with <geometry> and </geometry>

  std::string whole_geometry() const { return form.empty() ? geometry : "<geometry>" + form + "</geometry>"; }
};

using Elements = std::vector<const XmlElement*>;

/// Replaces the collision elements of links. The first new one takes the place of the first old one, and what is kept
/// of them stays where it is.
class CollisionWriter {
 public:
  CollisionWriter(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder,
                  const NewUri& new_uri, std::string_view pose_tag)
      : robot_(file.robot),
        document_(document),
        line_end_(line_end(document)),
        pose_tag_(pose_tag),
        files_(file, document, folder, new_uri) {}
  virtual ~CollisionWriter() = default;

  std::string write(std::span<const NewCollision> collisions) {
    for (const NewCollision& collision : collisions)
      if (const XmlElement* const link = link_of(collision.link)) replace(collision, *link);
    files_.add_to(edits_);
    return edited_text(document_, std::move(edits_));
  }

 protected:
  // What differs between formats
  virtual const XmlElement* link_of(std::size_t link) const = 0;             ///< nullptr: no element is the link
  virtual bool is_shape(const XmlElement& child, Geometry which) const = 0;  ///< the reader makes a shape of it
  virtual bool is_replaced(const XmlElement& collision) const = 0;
  /// `like`, here and below: the first collision element of the link that is_replaced; nullptr if there is none.
  virtual Piece hull_piece(const std::string& uri, const XmlElement& link, const XmlElement* like) const = 0;
  virtual Piece ball_piece(const Ball& ball, const XmlElement& link, const XmlElement* like) const = 0;
  /// Adds elements after the first of the old ones, or elsewhere in the link if there are none.
  virtual void insert(std::span<const Piece> pieces, const XmlElement& link, const Elements& old,
                      const XmlElement* like) = 0;
  /// The end of a line and the indentation of the element, for what is put before it.
  virtual std::string break_before(const XmlElement& element) const = 0;

  std::string indentation(const XmlElement& element) const { return std::string(document_.indentation(element)); }

  void insert_at(std::size_t place, const std::string& text) { edits_.push_back({{place, place}, text}); }

  const Robot& robot_;
  const XmlDocument& document_;
  const std::string line_end_;

 private:
  void replace(const NewCollision& collision, const XmlElement& link) {
    Elements from, old;
    for (const XmlElement* child : link.children) {
      if (is_shape(*child, collision.from)) from.push_back(child);
      if (child->name == "collision" && is_replaced(*child)) old.push_back(child);
    }
    const XmlElement* const like = old.empty() ? nullptr : old[0];
    std::vector<Piece> kept;
    for (const std::size_t shape : collision.kept)
      if (collision.from == Geometry::Collision)
        std::erase(old, from.at(shape));
      else
        kept.push_back({pose_of(*from.at(shape)), "", files_.part(from.at(shape)->child("geometry")->whole)});
    std::vector<Piece> pieces = new_pieces(collision, from, link, like);
    std::ranges::move(kept, std::back_inserter(pieces));
    write_pieces(pieces, link, old, like);
  }

  std::vector<Piece> new_pieces(const NewCollision& collision, const Elements& from, const XmlElement& link,
                                const XmlElement* like) const {
    std::vector<Piece> pieces;
    for (const std::string& hull : collision.hulls) {
      pieces.push_back(hull_piece(hull, link, like));
      if (collision.same_origin_as) pieces.back().pose = pose_of(*from.at(*collision.same_origin_as));
    }
    for (const Ball& ball : collision.balls) pieces.push_back(ball_piece(ball, link, like));
    return pieces;
  }

  std::string pose_of(const XmlElement& shape) const {
    const XmlElement* const pose = shape.child(pose_tag_);
    return pose ? std::string(document_[pose->whole]) : "";
  }

  void write_pieces(std::span<const Piece> pieces, const XmlElement& link, const Elements& old,
                    const XmlElement* like) {
    const std::size_t refilled = std::min<std::size_t>(old.empty() ? 0 : 1, pieces.size());
    if (refilled == 1) refill(*old[0], pieces[0]);
    if (refilled < pieces.size()) insert(pieces.subspan(refilled), link, old, like);
    for (std::size_t i = refilled; i < old.size(); ++i) remove(*old[i]);
  }

  /// Gives a collision element another pose and geometry; all else in it stays.
  void refill(const XmlElement& collision, const Piece& piece) {
    const XmlElement& geometry = *collision.child("geometry");
    const XmlElement* const pose = collision.child(pose_tag_);
    if (!pose && !piece.pose.empty()) insert_at(geometry.whole.begin, piece.pose + break_before(geometry));
    if (pose && !piece.pose.empty()) edits_.push_back({pose->whole, piece.pose});
    if (!piece.form.empty() && geometry.children.size() == 1)
      edits_.push_back({geometry.children[0]->whole, piece.form});
    else
      edits_.push_back({geometry.whole, piece.whole_geometry()});
    for (const XmlElement* child : collision.children) {
      const bool stays = child == &geometry || (child == pose && !piece.pose.empty());
      if (!stays && (child->name == pose_tag_ || child->name == "geometry")) remove(*child);
    }
  }

  void remove(const XmlElement& element) { edits_.push_back({lines_of(document_, element), ""}); }

  const std::string_view pose_tag_;
  const RenamedFiles files_;
  std::vector<XmlEdit> edits_;
};

class UrdfWriter : public CollisionWriter {
 public:
  UrdfWriter(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder,
             const NewUri& new_uri)
      : CollisionWriter(file, document, folder, new_uri, "origin"), links_(document.root().children_called("link")) {}

 private:
  const XmlElement* link_of(std::size_t link) const override { return links_[link]; }

  bool is_shape(const XmlElement& child, Geometry which) const override {
    return child.name == (which == Geometry::Visual ? "visual" : "collision");
  }

  bool is_replaced(const XmlElement&) const override { return true; }

  Piece hull_piece(const std::string& uri, const XmlElement&, const XmlElement*) const override {
    return {"", fmt::format("<mesh filename=\"{}\"/>", xml_escaped(uri)), ""};
  }

  Piece ball_piece(const Ball& ball, const XmlElement&, const XmlElement*) const override {
    const Vec3& p = ball.center;
    return {fmt::format("<origin xyz=\"{} {} {}\"/>", p.x, p.y, p.z),
            fmt::format("<sphere radius=\"{}\"/>", ball.radius), ""};
  }

  void insert(std::span<const Piece> pieces, const XmlElement& link, const Elements& old, const XmlElement*) override {
    const XmlElement& neighbour = old.empty() ? last_shape(link) : *old[0];
    const std::string inner_break = break_before(*neighbour.child("geometry"));
    const std::string last_break = inner_break.empty() ? "" : break_before(neighbour);
    for (const Piece& piece : pieces)
      insert_at(neighbour.whole.end, break_before(neighbour) + "<collision>" +
                                         (piece.pose.empty() ? "" : inner_break + piece.pose) + inner_break +
                                         piece.whole_geometry() + last_break + "</collision>");
  }

  const XmlElement& last_shape(const XmlElement& link) const {
    for (const char* const tag : {"visual", "collision"})
      if (const Elements shapes = link.children_called(tag); !shapes.empty()) return *shapes.back();
    refuse(fmt::format("link '{}' has no geometry", *link.attribute("name")));
  }

  /// Nothing, if something else stands before it.
  std::string break_before(const XmlElement& element) const override {
    return begins_line(document_, element) ? line_end_ + indentation(element) : "";
  }

  const Elements links_;
};

class SdfWriter : public CollisionWriter {
 public:
  SdfWriter(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder,
            const NewUri& new_uri)
      : CollisionWriter(file, document, folder, new_uri, "pose"), links_(sdf_links(document)) {}

 private:
  const XmlElement* link_of(std::size_t link) const override {
    const auto known = links_.find(robot_.links[link].name);
    return known == links_.end() ? nullptr : known->second;  // the world
  }

  bool is_shape(const XmlElement& child, Geometry which) const override {
    if (child.name != (which == Geometry::Visual ? "visual" : "collision") || !sdf_collides(child)) return false;
    const XmlElement* const geometry = child.child("geometry");
    return geometry && !geometry->children.empty() && geometry->children[0]->name != "empty";
  }

  bool is_replaced(const XmlElement& collision) const override { return sdf_collides(collision); }

  Piece hull_piece(const std::string& uri, const XmlElement& link, const XmlElement* like) const override {
    return {"", "", geometry("mesh", "uri", xml_escaped(uri), link, like)};
  }

  Piece ball_piece(const Ball& ball, const XmlElement& link, const XmlElement* like) const override {
    const Vec3& p = ball.center;
    return {fmt::format("<pose>{} {} {} 0 0 0</pose>", p.x, p.y, p.z), "",
            geometry("sphere", "radius", fmt::format("{}", ball.radius), link, like)};
  }

  /// A form with one child, each on lines of its own.
  std::string geometry(std::string_view form, std::string_view child, const std::string& value, const XmlElement& link,
                       const XmlElement* like) const {
    const std::string indent = indent_of(link, like), one = step(link, indent);
    const std::string in1 = line_end_ + indent + one, in2 = in1 + one, in3 = in2 + one;
    return fmt::format("<geometry>{0}<{1}>{2}<{3}>{4}</{3}>{0}</{1}>{5}</geometry>", in2, form, in3, child, value, in1);
  }

  std::string indent_of(const XmlElement& link, const XmlElement* like) const {
    if (!like) like = link.child("visual");
    return like ? indentation(*like) : indentation(link) + "  ";
  }

  /// What one level of indentation is.
  std::string step(const XmlElement& link, const std::string& indent) const {
    const std::string outer = indentation(link);
    return indent.size() > outer.size() && indent.starts_with(outer) ? indent.substr(outer.size()) : "  ";
  }

  void insert(std::span<const Piece> pieces, const XmlElement& link, const Elements& old,
              const XmlElement* like) override {
    const std::string indent = indent_of(link, like), outer = line_end_ + indent, inner = outer + step(link, indent);
    const std::string name = document_.required(link, "name") + "_hull";
    std::set<std::string> names;
    for (const XmlElement* child : link.children)
      if (const std::string* used = child->attribute("name")) names.insert(*used);
    const std::size_t place = !old.empty()            ? old[0]->whole.end
                              : link.children.empty() ? end_tag_begin(document_, link)
                                                      : link.children.back()->whole.end;
    for (const Piece& piece : pieces)
      insert_at(place, fmt::format("{}<collision name=\"{}\">{}{}{}{}{}</collision>", outer,
                                   xml_escaped(unique_name(name, names)), piece.pose.empty() ? "" : inner, piece.pose,
                                   inner, piece.geometry, outer));
  }

  std::string break_before(const XmlElement& element) const override { return line_end_ + indentation(element); }

  const std::map<std::string, const XmlElement*> links_;
};

}  // namespace

std::string urdf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                 std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                 const NewUri& new_uri) {
  return UrdfWriter(file, document, folder, new_uri).write(collisions);
}

std::string sdf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                const NewUri& new_uri) {
  return SdfWriter(file, document, folder, new_uri).write(collisions);
}

}  // namespace prohull::robot
