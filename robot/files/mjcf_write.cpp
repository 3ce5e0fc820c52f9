#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "prohull/detail/refuse.h"
#include "prohull/error.h"
#include "robot/files/mjcf.h"
#include "robot/files/mjcf_model.h"
#include "robot/files/xml_lines.h"
#include "robot/files/xml_values.h"

namespace fs = std::filesystem;

namespace prohull::robot {
namespace {

// What says the shape and the place of a geom.
constexpr std::array<std::string_view, 14> kShapeAttributes{
    "type", "size",  "mesh",   "hfield", "fitscale",  "fromto",     "pos",
    "quat", "euler", "xyaxes", "zaxis",  "axisangle", "fluidshape", "shellinertia"};
constexpr std::array<std::string_view, 7> kPoseAttributes{"fromto", "pos",   "quat",     "euler",
                                                          "xyaxes", "zaxis", "axisangle"};

bool is_shape_attribute(std::string_view name) {
  return std::ranges::find(kShapeAttributes, name) != kShapeAttributes.end();
}

class MjcfWriter {
 public:
  MjcfWriter(const RobotFile& file, const XmlDocument& document, const fs::path& folder)
      : file_(file),
        document_(document),
        folder_(fs::absolute(folder)),
        packages_(file.path, {}),
        model_(document),
        line_end_(line_end(document)) {
    for (const auto& [name, mesh] : model_.meshes()) mesh_names_.insert(name);
    collect_geom_names(document.root());
  }

  std::string write(std::span<const NewCollision> collisions) {
    for (const NewCollision& collision : collisions)
      if (collision.link < model_.bodies().size()) replace(collision);
    rename_references(document_.root());
    add_assets();
    rewrite_files();
    inserted_.insert(inserted_.end(), edits_.begin(), edits_.end());
    return edited_text(document_, std::move(inserted_));
  }

 private:
  // Geoms

  void replace(const NewCollision& collision) {
    const MjcfBody& body = model_.bodies().at(collision.link);
    const auto& from = collision.from == Geometry::Visual ? body.visual : body.colliding;
    const bool keeps_places = body.visual_collides || collision.from == Geometry::Collision;
    std::vector<MjcfElement> old = body.colliding;
    if (keeps_places)
      std::erase_if(old, [&](const MjcfElement& geom) {
        return std::ranges::any_of(collision.kept, [&](std::size_t i) { return from.at(i).element == geom.element; });
      });
    const MjcfElement* const model_geom = old.empty() ? nullptr : &old[0];
    std::vector<NewGeom> added = new_geoms(collision, body, from, model_geom);
    const std::size_t stand_ins = added.size();
    if (!keeps_places)
      for (const std::size_t kept : collision.kept) added.push_back(kept_geom(from.at(kept), body, model_geom));
    if (model_geom && !body.visual_collides) share_mass(added, stand_ins, *model_geom);
    take_names(added, std::max<std::size_t>(stand_ins, 1), old, body);
    if (body.visual_collides)
      show_only(old, added);
    else
      remove(old, added);
    for (const NewGeom& geom : added) insert(geom, body);
  }

  /// A geom that is written.
  struct NewGeom {
    const XmlElement* beside = nullptr;     ///< the geom that it stands after; none: at the end of the body
    const XmlElement* home = nullptr;       ///< the <body> or <frame> that it is in
    std::string child_class;                ///< that applies there
    std::vector<MjcfAttribute> attributes;  ///< without the name
    std::string name;
  };

  std::vector<NewGeom> new_geoms(const NewCollision& collision, const MjcfBody& body,
                                 const std::vector<MjcfElement>& from, const MjcfElement* like) {
    std::vector<NewGeom> geoms;
    for (const std::string& hull : collision.hulls) geoms.push_back(hull_geom(hull, collision, body, from, like));
    for (const Ball& ball : collision.balls) geoms.push_back(ball_geom(ball, body, like));
    return geoms;
  }

  NewGeom hull_geom(const std::string& hull, const NewCollision& collision, const MjcfBody& body,
                    const std::vector<MjcfElement>& from, const MjcfElement* like) {
    NewGeom geom{nullptr, body.element, body.child_class, {}, ""};
    const MjcfElement* const same = collision.same_origin_as ? &from.at(*collision.same_origin_as) : nullptr;
    std::vector<MjcfAttribute> shape{{"type", "mesh"}, {"mesh", add_mesh(hull, body, same)}};
    if (same) {
      geom.beside = same->element, geom.home = same->home;
      append(shape, pose_attributes(*same));
    }
    geom.attributes = with_shape(like, geom, std::move(shape), body);
    return geom;
  }

  NewGeom ball_geom(const Ball& ball, const MjcfBody& body, const MjcfElement* like) {
    refuse_in_main("fromto");
    refuse_in_main("mesh");
    NewGeom geom{nullptr, body.element, body.child_class, {}, ""};
    std::vector<MjcfAttribute> shape{{"type", "sphere"}, {"size", fmt::format("{}", ball.radius)}};
    append(shape, mjcf_attributes_of(Pose{.translation = ball.center}));
    geom.attributes = with_shape(like, geom, std::move(shape), body);
    return geom;
  }

  NewGeom kept_geom(const MjcfElement& visual, const MjcfBody& body, const MjcfElement* like) {
    NewGeom geom{visual.element, visual.home, body.child_class, {}, ""};
    std::vector<MjcfAttribute> shape;
    for (const std::string_view key : kShapeAttributes)
      if (const std::string* value = word_of(visual, key)) shape.emplace_back(key, *value);
    if (!says(shape, "type")) shape.emplace_back("type", "sphere");
    geom.attributes = with_shape(like, geom, std::move(shape), body);
    return geom;
  }

  static void append(std::vector<MjcfAttribute>& to, std::vector<MjcfAttribute> more) {
    std::ranges::move(more, std::back_inserter(to));
  }

  /// The words of the file, which mean the same pose bit for bit; numbers in place of fromto, which no mesh can have.
  std::vector<MjcfAttribute> pose_attributes(const MjcfElement& geom) const {
    if (model_.value(geom, "fromto")) return mjcf_attributes_of(mjcf_pose(model_, geom));
    std::vector<MjcfAttribute> words;
    for (const std::string_view key : kPoseAttributes)
      if (const std::string* value = word_of(geom, key)) words.emplace_back(key, *value);
    return words;
  }

  /// Of orientations only the one that counts: MuJoCo refuses several in one element.
  const std::string* word_of(const MjcfElement& geom, std::string_view key) const {
    const bool is_orientation = std::ranges::count(kMjcfOrientations, key) > 0;
    return is_orientation && key != mjcf_orientation(model_, geom) ? nullptr : model_.value(geom, key);
  }

  /// The attributes of the geom that is replaced, with another shape. Without such a geom: one that collides, in the
  /// group that viewers hide, and that adds no mass.
  std::vector<MjcfAttribute> with_shape(const MjcfElement* like, const NewGeom& geom, std::vector<MjcfAttribute> shape,
                                        const MjcfBody& body) const {
    const std::string place_class = class_at(geom.home, body);
    if (class_has_pose(model_.main_class())) add_missing_pose(shape);
    std::vector<MjcfAttribute> result;
    if (!like) {
      if (place_class.empty() || would_change(place_class, shape)) result.emplace_back("class", model_.main_class());
      append(result, {{"contype", "1"}, {"conaffinity", "1"}, {"group", "3"}, {"mass", "0"}});
      append(result, std::move(shape));
      return result;
    }
    const bool flat = would_change(like->class_name, shape);
    const std::string& name = flat ? model_.main_class() : like->class_name;
    if (name != place_class || like->element->attribute("class")) result.emplace_back("class", name);
    if (flat) append(result, inherited(*like));
    for (const auto& [key, value] : like->element->attributes)
      if (is_copied(key, body)) result.emplace_back(key, value);
    if (body.visual_collides) result.emplace_back("mass", "0");  // the geom that is seen keeps its mass
    append(result, std::move(shape));
    return result;
  }

  static bool says(const std::vector<MjcfAttribute>& shape, std::string_view key) {
    return std::ranges::find(shape, key, &MjcfAttribute::first) != shape.end();
  }

  /// Says what is the same without a word, against a class that says something else.
  void add_missing_pose(std::vector<MjcfAttribute>& shape) const {
    if (!says(shape, "pos")) shape.emplace_back("pos", "0 0 0");
    const auto says_it = [&](std::string_view key) { return says(shape, key); };
    if (std::ranges::none_of(kMjcfOrientations, says_it))
      shape.emplace_back("euler", "0 0 0");  // before all of a class
    if (!says(shape, "quat")) return;
    for (const std::string_view key : kMjcfOrientations)
      if (key != "quat") refuse_in_main(key);  // it goes before the quat
  }

  static bool is_copied(std::string_view key, const MjcfBody& body) {
    if (body.visual_collides && (key == "mass" || key == "density")) return false;
    return !is_shape_attribute(key) && key != "name" && key != "class";
  }

  /// What the class of a geom says, and the geom does not, but for its shape.
  std::vector<MjcfAttribute> inherited(const MjcfElement& geom) const {
    std::vector<MjcfAttribute> result;
    for (const auto& [key, value] : model_.defaults(geom.class_name, "geom"))
      if (!is_shape_attribute(key) && key != "class" && !geom.element->attribute(key)) result.emplace_back(key, value);
    return result;
  }

  /// A pose that a class sets would move a shape, and MuJoCo would fit a box to a mesh that it names.
  bool would_change(const std::string& class_name, const std::vector<MjcfAttribute>& shape) const {
    return class_has_pose(class_name) || (model_.defaults(class_name, "geom").contains("mesh") && !says(shape, "mesh"));
  }

  bool class_has_pose(const std::string& name) const {
    const MjcfModel::Attributes& defaults = model_.defaults(name, "geom");
    return std::ranges::any_of(kPoseAttributes, [&](std::string_view key) { return defaults.contains(key); });
  }

  /// The class that applies in a <body> or <frame> without being named.
  std::string class_at(const XmlElement* home, const MjcfBody& body) const {
    for (const auto* geoms : {&body.visual, &body.colliding})
      for (const MjcfElement& geom : *geoms)
        if (geom.home == home && !geom.element->attribute("class")) return geom.class_name;
    return home == body.element ? body.child_class : "";
  }

  /// Several geoms in place of one weigh as much as it: the first `count` have equal parts of a mass that it says.
  void share_mass(std::vector<NewGeom>& geoms, std::size_t count, const MjcfElement& old) const {
    if (count < 2 || !model_.value(old, "mass")) return;
    const double part = mjcf_numbers(model_, old, "mass", 1, 1)[0] / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::erase_if(geoms[i].attributes, [](const MjcfAttribute& it) { return it.first == "mass"; });
      geoms[i].attributes.emplace_back("mass", fmt::format("{}", part));
    }
  }

  /// What names a geom that the first `count` new ones stand for names these. The first one takes the name of the first
  /// old one if that has any.
  void take_names(std::vector<NewGeom>& added, std::size_t count, const std::vector<MjcfElement>& old,
                  const MjcfBody& body) {
    if (added.empty() || old.empty()) return;
    const std::string* const first = old[0].element->attribute("name");
    if (first) added[0].name = *first;
    for (const MjcfElement& geom : old) {
      const std::string* const name = geom.element->attribute("name");
      if (!name) continue;
      std::vector<std::string>& stand_ins = stand_ins_[*name];
      for (std::size_t i = 0; i < count; ++i) {
        if (added[i].name.empty()) added[i].name = unique_name(body.name + "_hull", geom_names_);
        stand_ins.push_back(added[i].name);
      }
    }
  }

  /// Geoms that were both stay to be seen.
  void show_only(const std::vector<MjcfElement>& old, const std::vector<NewGeom>& added) {
    for (const MjcfElement& geom : old) {
      const std::string* const name = geom.element->attribute("name");
      if (name && !added.empty() && *name == added[0].name)
        edits_.push_back({attribute_span(document_, *geom.element, "name"), ""});
      for (const std::string_view key : {"contype", "conaffinity"}) set(*geom.element, key, "0");
    }
  }

  void set(const XmlElement& element, std::string_view key, const std::string& value) {
    if (element.attribute(key)) return edits_.push_back({value_span(document_, element, key), value});
    const std::size_t at = element.start_tag.end - (element.is_empty_tag() ? 2 : 1);
    std::size_t end = at;
    while (std::string_view(" \t\r\n").find(document_.text()[end - 1]) != std::string_view::npos) --end;
    edits_.push_back({{end, end}, fmt::format(" {}=\"{}\"", key, value)});
  }

  /// Removes geoms. The first new one takes the place of the first old one in the same <body> or <frame>, with all that
  /// stand beside it.
  void remove(const std::vector<MjcfElement>& old, std::vector<NewGeom>& added) {
    bool is_placed = added.empty();
    for (const MjcfElement& geom : old)
      if (!is_placed && added[0].home == geom.home) {
        const auto others = std::find_if(added.begin(), added.end(), [&](const NewGeom& other) {
          return other.home != added[0].home || other.beside != added[0].beside;
        });
        std::string text = text_of(added[0]);
        for (auto other = added.begin() + 1; other != others; ++other)
          text += line_end_ + std::string(document_.indentation(*geom.element)) + text_of(*other);
        edits_.push_back({geom.element->whole, text});
        is_placed = true;
        added.erase(added.begin(), others);
      } else {
        edits_.push_back({lines_of(document_, *geom.element), ""});
      }
  }

  static std::string text_of(const NewGeom& geom) {
    std::string text = "<geom";
    if (!geom.name.empty()) text += fmt::format(" name=\"{}\"", xml_escaped(geom.name));
    for (const auto& [key, value] : geom.attributes) text += fmt::format(" {}=\"{}\"", key, xml_escaped(value));
    return text + "/>";
  }

  void insert(const NewGeom& geom, const MjcfBody& body) {
    const XmlElement* const beside = geom.beside ? geom.beside : last_direct_geom(body);
    const XmlElement& after = beside ? *beside : *body.element->children.back();
    const std::string line = line_end_ + std::string(document_.indentation(after));
    inserted_.push_back({{after.whole.end, after.whole.end}, line + text_of(geom)});
  }

  static const XmlElement* last_direct_geom(const MjcfBody& body) {
    const std::vector<const XmlElement*> geoms = body.element->children_called("geom");
    return geoms.empty() ? nullptr : geoms.back();
  }

  // Names

  void collect_geom_names(const XmlElement& element) {
    const std::string* const name = element.name == "geom" ? element.attribute("name") : nullptr;
    if (name) geom_names_.insert(*name);
    for (const XmlElement* child : element.children) collect_geom_names(*child);
  }

  void rename_references(const XmlElement& element) {
    const std::string* const type = element.attribute("objtype");
    for (const std::string_view key : {"geom", "geom1", "geom2", "objname"}) {
      const std::string* const name = element.attribute(key);
      if (!name || (key == "objname" && (!type || *type != "geom"))) continue;
      if (const std::string now = stand_ins(*name).front(); now != *name)
        edits_.push_back({value_span(document_, element, key), xml_escaped(now)});
    }
    if (element.name == "pair") repeat_pair(element);
    for (const XmlElement* child : element.children) rename_references(*child);
  }

  /// The geoms that a name stands for now.
  std::vector<std::string> stand_ins(const std::string& name) const {
    const auto found = stand_ins_.find(name);
    return found == stand_ins_.end() ? std::vector{name} : found->second;
  }

  /// A pair of geoms that may touch, for all but the first that stand for them.
  void repeat_pair(const XmlElement& pair) {
    const std::string *const first = pair.attribute("geom1"), *const second = pair.attribute("geom2");
    if (!first || !second) return;
    std::string text;
    for (const std::string& a : stand_ins(*first))
      for (const std::string& b : stand_ins(*second))
        if (a != stand_ins(*first).front() || b != stand_ins(*second).front())
          text += line_end_ + std::string(document_.indentation(pair)) + text_of_pair(pair, a, b);
    if (!text.empty()) edits_.push_back({{pair.whole.end, pair.whole.end}, text});
  }

  static std::string text_of_pair(const XmlElement& pair, const std::string& geom1, const std::string& geom2) {
    std::string text = fmt::format("<pair geom1=\"{}\" geom2=\"{}\"", xml_escaped(geom1), xml_escaped(geom2));
    for (const auto& [key, value] : pair.attributes)
      if (key != "geom1" && key != "geom2" && key != "name") text += fmt::format(" {}=\"{}\"", key, xml_escaped(value));
    return text + "/>";
  }

  // Assets

  std::string add_mesh(const std::string& hull, const MjcfBody& body, const MjcfElement* same) {
    const std::string extension = fs::path(hull).extension().string();
    if (extension != ".stl" && extension != ".obj")
      refuse(fmt::format("{}: MuJoCo reads no {} files; write the hulls as stl or obj", document_.file(), extension));
    if (hull.find("://") != std::string::npos)
      refuse(fmt::format("{}: MuJoCo reads paths, but no URIs such as {}", document_.file(), hull));
    refuse_in_main("fromto");
    std::string name = unique_name(body.name + "_hull", mesh_names_);
    assets_.push_back(
        fmt::format("<mesh name=\"{}\" file=\"{}\"{}/>", xml_escaped(name), xml_escaped(hull), mesh_attributes(same)));
    return name;
  }

  void refuse_in_main(std::string_view key) const {
    if (model_.defaults(model_.main_class(), "geom").contains(key))
      throw InputError(Defect::Malformed,
                       fmt::format("{}: the main <default> sets {} for all geoms, which the new ones cannot have",
                                   document_.file(), key));
  }

  /// What default classes say about meshes must not change a hull. It has the reference of the mesh of `same`, whose
  /// pose it has: that is in the scale of the hull.
  std::string mesh_attributes(const MjcfElement* same) const {
    std::map<std::string_view, std::string> attributes{
        {"scale", "1 1 1"}, {"refpos", "0 0 0"}, {"refquat", "1 0 0 0"}, {"maxhullvert", "-1"}};
    std::erase_if(attributes,
                  [&](const auto& it) { return !model_.defaults(model_.main_class(), "mesh").contains(it.first); });
    const std::string* const mesh = same ? model_.value(*same, "mesh") : nullptr;
    if (const auto found = mesh ? model_.meshes().find(*mesh) : model_.meshes().end(); found != model_.meshes().end()) {
      const MjcfElement asset = model_.asset(*found->second);
      const std::vector<double> at = mjcf_numbers(model_, asset, "refpos", 3, 3);
      std::vector<double> scale = mjcf_numbers(model_, asset, "scale", 3, 3);
      if (scale.empty()) scale = {1, 1, 1};
      if (!at.empty())
        attributes["refpos"] = fmt::format("{} {} {}", at[0] * scale[0], at[1] * scale[1], at[2] * scale[2]);
      if (const std::string* const turn = model_.value(asset, "refquat")) attributes["refquat"] = *turn;
    }
    std::string text;
    for (const auto& [key, value] : attributes) text += fmt::format(" {}=\"{}\"", key, xml_escaped(value));
    return text;
  }

  void add_assets() {
    if (assets_.empty()) return;
    const XmlElement* section = nullptr;
    for (const XmlElement* child : document_.root().children)
      if (child->name == "asset" && !child->is_empty_tag()) section = child;
    if (!section) return create_assets();
    const XmlElement* const last = section->children.empty() ? nullptr : section->children.back();
    const std::size_t at = last ? last->whole.end : section->start_tag.end;
    const std::string indent(last ? document_.indentation(*last) : std::string(document_.indentation(*section)) + "  ");
    std::string text;
    for (const std::string& asset : assets_) text.append(line_end_).append(indent).append(asset);
    edits_.push_back({{at, at}, text});
  }

  void create_assets() {
    const XmlElement& world = *document_.root().child("worldbody");
    const std::string indent(document_.indentation(world));
    std::string text = "<asset>";
    for (const std::string& asset : assets_) text.append(line_end_).append(indent).append("  ").append(asset);
    text.append(line_end_).append(indent).append("</asset>").append(line_end_).append(indent);
    edits_.push_back({{world.whole.begin, world.whole.begin}, text});
  }

  // Files

  struct NamedFile {
    const XmlElement* element = nullptr;
    std::string key, path;  ///< the path as seen from the new file
    bool is_moved = false;
  };

  /// A file in the folder of the new one, or that has moved, needs a path that MuJoCo takes as it is. It puts what
  /// meshdir says before ".." as text, and the new folder does not have the folders of the old one.
  void rewrite_files() {
    std::vector<NamedFile> files;
    collect_files(document_.root(), files);
    if (assets_.empty() && std::ranges::none_of(files, &NamedFile::is_moved)) return;
    for (const XmlElement* section : document_.root().children_called("compiler")) take_paths_as_they_are(*section);
    for (const NamedFile& file : files)
      if (file.path != *file.element->attribute(file.key))
        edits_.push_back({value_span(document_, *file.element, file.key), xml_escaped(file.path)});
  }

  void take_paths_as_they_are(const XmlElement& compiler) {
    if (compiler.attribute("strippath")) set(compiler, "strippath", "false");
    for (const std::string_view key : {"assetdir", "meshdir", "texturedir"})
      if (compiler.attribute(key)) edits_.push_back({attribute_span(document_, compiler, key), ""});
  }

  void collect_files(const XmlElement& parent, std::vector<NamedFile>& files) const {
    constexpr std::array<std::string_view, 6> kWithFiles{"mesh", "hfield", "skin", "flexcomp", "texture", "model"};
    for (const XmlElement* element : parent.children) {
      if (std::ranges::find(kWithFiles, element->name) != kWithFiles.end())
        for (const auto& [key, value] : element->attributes)
          if (key.starts_with("file")) files.push_back(named_file(*element, key, value));
      collect_files(*element, files);
    }
  }

  NamedFile named_file(const XmlElement& element, const std::string& key, const std::string& said) const {
    if (said.find("://") != said.npos) return {&element, key, said};
    const fs::path place = element.name == "model"     ? fs::path()
                           : element.name == "texture" ? model_.compiler().texture_folder
                                                       : model_.compiler().mesh_folder;
    const std::string old = (place / model_.file_name(said)).generic_string();
    MeshFile found = packages_.find(old, {1, 1, 1});
    if (found.path.empty()) found.path = file_.path.parent_path() / old;  // it may come later
    const std::string now = packages_.uri_from(folder_, found);
    return {&element, key, now, now != old};
  }

  const RobotFile& file_;
  const XmlDocument& document_;
  const fs::path folder_;
  const Packages packages_;
  const MjcfModel model_;
  const std::string line_end_;
  std::set<std::string> mesh_names_, geom_names_;
  std::map<std::string, std::vector<std::string>> stand_ins_;  // the geoms that stand for those of a name
  std::vector<std::string> assets_;
  std::vector<XmlEdit> inserted_, edits_;
};

}  // namespace

std::string mjcf_with_collisions(const RobotFile& file, const XmlDocument& document,
                                 std::span<const NewCollision> collisions, const std::filesystem::path& folder,
                                 const NewUri& /*new_uri*/) {
  return MjcfWriter(file, document, folder).write(collisions);
}

}  // namespace prohull::robot
