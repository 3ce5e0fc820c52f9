#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "robot/files/named_files.h"
#include "robot/files/sdf.h"
#include "robot/files/sdf_frames.h"
#include "robot/files/xml_lines.h"
#include "robot/files/xml_values.h"

namespace prohull::robot {
namespace {

/// A collision element that is written.
struct Piece {
  std::string pose;      ///< the bytes of a <pose> element, or ""
  std::string geometry;  ///< those of a <geometry> element
};

class SdfWriter {
 public:
  SdfWriter(const RobotFile& file, const XmlDocument& document, const std::filesystem::path& folder,
            const NewUri& new_uri)
      : file_(file),
        document_(document),
        files_(file, document, folder, new_uri),
        links_(sdf_links(document)),
        line_end_(line_end(document)) {}

  std::string write(std::span<const NewCollision> collisions) {
    for (const NewCollision& collision : collisions) replace(collision);
    files_.add_to(edits_);
    return edited_text(document_, std::move(edits_));
  }

 private:
  void replace(const NewCollision& collision) {
    const auto known = links_.find(file_.robot.links[collision.link].name);
    if (known == links_.end()) return;  // the world
    const XmlElement& link = *known->second;
    std::vector<const XmlElement*> old, from;
    for (const XmlElement* child : link.children) {
      if (is_shape(*child, collision.from)) from.push_back(child);
      if (child->name == "collision" && sdf_collides(*child)) old.push_back(child);
    }
    const std::string indent = indent_of(link, old.empty() ? nullptr : old[0]);
    std::vector<Piece> pieces = new_pieces(collision, from, link, indent);
    for (const std::size_t kept : collision.kept)
      if (collision.from == Geometry::Collision)
        std::erase(old, from.at(kept));  // it stays where it is
      else
        pieces.push_back(kept_piece(*from.at(kept)));
    write_pieces(link, old, pieces, indent);
  }

  /// Whether the reader makes a shape of it.
  static bool is_shape(const XmlElement& element, Geometry from) {
    if (element.name != (from == Geometry::Visual ? "visual" : "collision") || !sdf_collides(element)) return false;
    const XmlElement* const geometry = element.child("geometry");
    return geometry && !geometry->children.empty() && geometry->children[0]->name != "empty";
  }

  std::string indent_of(const XmlElement& link, const XmlElement* collision) const {
    if (collision) return std::string(document_.indentation(*collision));
    for (const XmlElement* child : link.children)
      if (child->name == "visual") return std::string(document_.indentation(*child));
    return std::string(document_.indentation(link)) + "  ";
  }

  /// What one level of indentation is.
  std::string step(const XmlElement& link, const std::string& indent) const {
    const std::string_view outer = document_.indentation(link);
    return indent.size() > outer.size() && indent.starts_with(outer) ? indent.substr(outer.size()) : "  ";
  }

  std::string pose_of(const XmlElement& shape) const {
    const XmlElement* const pose = shape.child("pose");
    return pose ? std::string(document_[pose->whole]) : "";
  }

  std::vector<Piece> new_pieces(const NewCollision& collision, const std::vector<const XmlElement*>& from,
                                const XmlElement& link, const std::string& indent) const {
    const std::string end = line_end_, one = step(link, indent);
    const std::string in1 = end + indent + one, in2 = in1 + one, in3 = in2 + one;
    const std::string pose = collision.same_origin_as ? pose_of(*from.at(*collision.same_origin_as)) : "";
    std::vector<Piece> pieces;
    for (const std::string& hull : collision.hulls)
      pieces.push_back({pose, fmt::format("<geometry>{}<mesh>{}<uri>{}</uri>{}</mesh>{}</geometry>", in2, in3,
                                          xml_escaped(hull), in2, in1)});
    for (const auto& [center, radius] : collision.balls)
      pieces.push_back({fmt::format("<pose>{} {} {} 0 0 0</pose>", center.x, center.y, center.z),
                        fmt::format("<geometry>{}<sphere>{}<radius>{}</radius>{}</sphere>{}</geometry>", in2, in3,
                                    radius, in2, in1)});
    return pieces;
  }

  Piece kept_piece(const XmlElement& shape) const {
    return {pose_of(shape), files_.part(shape.child("geometry")->whole)};
  }

  void write_pieces(const XmlElement& link, const std::vector<const XmlElement*>& old, std::vector<Piece> pieces,
                    const std::string& indent) {
    const std::size_t refilled = std::min<std::size_t>(old.empty() ? 0 : 1, pieces.size());
    std::string added;
    std::set<std::string> names = names_in(link);
    const std::string name = document_.required(link, "name") + "_hull";
    for (std::size_t i = refilled; i < pieces.size(); ++i)
      added += new_collision(link, pieces[i], unique_name(name, names), indent);
    const std::size_t at = insertion(link, old);
    if (!added.empty()) edits_.push_back({{at, at}, added});
    if (refilled == 1) refill(*old[0], pieces[0]);
    for (std::size_t i = refilled; i < old.size(); ++i) edits_.push_back({lines_of(document_, *old[i]), ""});
  }

  /// After the first collision element, else after the last child, else before the end of the link.
  std::size_t insertion(const XmlElement& link, const std::vector<const XmlElement*>& old) const {
    if (!old.empty()) return old[0]->whole.end;
    return link.children.empty() ? end_tag_begin(document_, link) : link.children.back()->whole.end;
  }

  static std::set<std::string> names_in(const XmlElement& link) {
    std::set<std::string> names;
    for (const XmlElement* child : link.children)
      if (const std::string* name = child->attribute("name")) names.insert(*name);
    return names;
  }

  std::string new_collision(const XmlElement& link, const Piece& piece, const std::string& name,
                            const std::string& indent) const {
    const std::string end = line_end_, inner = end + indent + step(link, indent);
    return fmt::format("{}{}<collision name=\"{}\">{}{}{}{}{}{}</collision>", end, indent, xml_escaped(name),
                       piece.pose.empty() ? "" : inner, piece.pose, inner, piece.geometry, end, indent);
  }

  /// Gives a collision element another pose and geometry; all else in it stays.
  void refill(const XmlElement& collision, const Piece& piece) {
    const XmlElement& geometry = *collision.child("geometry");
    const XmlElement* const pose = collision.child("pose");
    if (pose && !piece.pose.empty() && document_[pose->whole] != piece.pose)
      edits_.push_back({pose->whole, piece.pose});
    if (!pose && !piece.pose.empty())
      edits_.push_back({{geometry.whole.begin, geometry.whole.begin},
                        piece.pose + line_end_ + std::string(document_.indentation(geometry))});
    edits_.push_back({geometry.whole, piece.geometry});
    for (const XmlElement* child : collision.children) {
      const bool stays = child == &geometry || (child == pose && !piece.pose.empty());
      if (!stays && (child->name == "pose" || child->name == "geometry"))
        edits_.push_back({lines_of(document_, *child), ""});
    }
  }

  const RobotFile& file_;
  const XmlDocument& document_;
  const RenamedFiles files_;
  const std::map<std::string, const XmlElement*> links_;
  const std::string line_end_;
  std::vector<XmlEdit> edits_;
};

}  // namespace

std::string sdf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                const NewUri& new_uri) {
  return SdfWriter(file, document, folder, new_uri).write(collisions);
}

}  // namespace prohull::robot
