#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "prohull/detail/refuse.h"
#include "robot/files/named_files.h"
#include "robot/files/urdf.h"
#include "robot/files/xml_lines.h"

namespace prohull::robot {
namespace {

constexpr std::string_view tag_of(Geometry which) { return which == Geometry::Visual ? "visual" : "collision"; }

/// A collision element that is to be written. Its parts are bytes of XML.
struct Piece {
  std::string origin;    ///< empty: none
  std::string form;      ///< the child of <geometry>; empty: `geometry` is given
  std::string geometry;  ///< with <geometry> and </geometry>

  std::string whole_geometry() const { return form.empty() ? geometry : "<geometry>" + form + "</geometry>"; }
};

class UrdfWriter {
 public:
  UrdfWriter(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder,
             const NewUri& new_uri)
      : robot_(file.robot),
        document_(document),
        files_(file, document, folder, new_uri),
        links_(document.root().children_called("link")),
        newline_(line_end(document)) {}

  std::string write(std::span<const NewCollision> collisions) {
    for (const NewCollision& collision : collisions) replace(collision);
    files_.add_to(edits_);
    return edited_text(document_, std::move(edits_));
  }

 private:
  using Elements = std::vector<const XmlElement*>;

  void replace(const NewCollision& collision) {
    const Elements old = links_[collision.link]->children_called("collision");
    if (collision.from == Geometry::Collision) return replace_among(collision, old);
    std::vector<Piece> pieces = new_pieces(collision);
    for (const std::size_t shape : collision.kept) pieces.push_back(copied(collision.link, collision.from, shape));
    write_pieces(collision.link, pieces, old);
  }

  /// Kept collision elements stay where they are; the first new one takes the place of the first other one.
  void replace_among(const NewCollision& collision, const Elements& old) {
    Elements others;
    for (std::size_t i = 0; i < old.size(); ++i)
      if (std::ranges::find(collision.kept, i) == collision.kept.end()) others.push_back(old[i]);
    write_pieces(collision.link, new_pieces(collision), others);
  }

  // What is to be written

  std::vector<Piece> new_pieces(const NewCollision& collision) const {
    std::vector<Piece> pieces;
    std::string origin;
    if (collision.same_origin_as)
      origin = origin_of(*element_of(collision.link, collision.from, *collision.same_origin_as));
    for (const std::string& hull : collision.hulls)
      pieces.push_back({origin, fmt::format("<mesh filename=\"{}\"/>", xml_escaped(hull)), ""});
    for (const auto& [center, radius] : collision.balls)
      pieces.push_back({fmt::format("<origin xyz=\"{} {} {}\"/>", center.x, center.y, center.z),
                        fmt::format("<sphere radius=\"{}\"/>", radius), ""});
    return pieces;
  }

  Piece copied(std::size_t link, Geometry from, std::size_t shape) const {
    const XmlElement& element = *element_of(link, from, shape);
    return {origin_of(element), "", files_.part(element.child("geometry")->whole)};
  }

  const XmlElement* element_of(std::size_t link, Geometry from, std::size_t shape) const {
    return links_[link]->children_called(tag_of(from))[shape];
  }

  std::string origin_of(const XmlElement& shape) const {
    const XmlElement* const origin = shape.child("origin");
    return origin ? std::string(document_[origin->whole]) : "";
  }

  // Where it is written

  void write_pieces(std::size_t link, std::span<const Piece> pieces, const Elements& old) {
    const std::size_t reused = std::min<std::size_t>(old.empty() ? 0 : 1, pieces.size());
    if (reused == 1) rewrite(*old[0], pieces[0]);
    if (reused < pieces.size()) {
      const XmlElement& neighbour = reused == 1 ? *old[0] : last_shape(link);
      for (const Piece& piece : pieces.subspan(reused)) insert_after(neighbour, new_element(neighbour, piece));
    }
    for (std::size_t i = reused; i < old.size(); ++i) remove(*old[i]);
  }

  const XmlElement& last_shape(std::size_t link) const {
    const Elements visual = links_[link]->children_called("visual");
    const Elements shapes = visual.empty() ? links_[link]->children_called("collision") : visual;
    if (shapes.empty()) refuse(fmt::format("link '{}' has no geometry", robot_.links[link].name));
    return *shapes.back();
  }

  void rewrite(const XmlElement& collision, const Piece& piece) {
    const XmlElement& geometry = *collision.child("geometry");
    const XmlElement* const origin = collision.child("origin");
    if (!origin && !piece.origin.empty())
      edits_.push_back({{geometry.whole.begin, geometry.whole.begin}, piece.origin + break_before(geometry)});
    if (origin && !piece.origin.empty()) edits_.push_back({origin->whole, piece.origin});
    if (!piece.form.empty() && geometry.children.size() == 1)
      edits_.push_back({geometry.children[0]->whole, piece.form});
    else
      edits_.push_back({geometry.whole, piece.whole_geometry()});
    for (const XmlElement* child : collision.children) {
      const bool is_rewritten = child == &geometry || (child == origin && !piece.origin.empty());
      if (!is_rewritten && (child->name == "origin" || child->name == "geometry")) remove(*child);
    }
  }

  std::string new_element(const XmlElement& neighbour, const Piece& piece) const {
    const std::string inner_break = break_before(*neighbour.child("geometry"));
    const std::string last_break = inner_break.empty() ? "" : break_before(neighbour);
    const std::string origin = piece.origin.empty() ? "" : inner_break + piece.origin;
    return "<collision>" + origin + inner_break + piece.whole_geometry() + last_break + "</collision>";
  }

  void insert_after(const XmlElement& element, const std::string& inserted) {
    edits_.push_back({{element.whole.end, element.whole.end}, break_before(element) + inserted});
  }

  /// The end of line and the blanks that stand before an element, if nothing else does.
  std::string break_before(const XmlElement& element) const {
    return begins_line(document_, element) ? newline_ + std::string(document_.indentation(element)) : "";
  }

  void remove(const XmlElement& element) { edits_.push_back({lines_of(document_, element), ""}); }

  const Robot& robot_;
  const XmlDocument& document_;
  RenamedFiles files_;
  Elements links_;
  std::string newline_;
  std::vector<XmlEdit> edits_;
};

}  // namespace

std::string urdf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                 std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                 const NewUri& new_uri) {
  return UrdfWriter(file, document, folder, new_uri).write(collisions);
}

}  // namespace prohull::robot
