#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "io/affine.h"
#include "io/mesh_builder.h"
#include "io/mesh_readers.h"
#include "io/vertex_welder.h"
#include "prohull/detail/extension.h"

namespace prohull {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

struct Element {
  std::string_view name, attributes, text;
  std::size_t end;  ///< the number of the next element that is not in it
};

/// Elements in the order of their start tags. Document types, which may define entities, are refused.
class XmlReader {
 public:
  XmlReader(std::string_view xml, const std::string& file) : xml_(xml), file_(file) {}

  std::vector<Element> elements() {
    while (at_ < xml_.size()) {
      if (xml_[at_] != '<')
        take_text(xml_.substr(at_, xml_.find('<', at_) - at_));
      else if (skip("<!--"))
        until("-->");
      else if (skip("<![CDATA["))
        take_text(xml_.substr(at_, xml_.find("]]>", at_) - at_)), until("]]>");
      else if (skip("<?"))
        until("?>");
      else if (skip("</"))
        close(trimmed(until(">")));
      else if (skip("<!"))
        stop("document types are not read here");
      else
        open();
    }
    if (!open_.empty()) stop(fmt::format("the file ends within <{}>", printable(elements_[open_.back()].name)));
    return std::move(elements_);
  }

 private:
  [[noreturn]] void stop(std::string_view why) const {
    const auto lines = std::count(xml_.begin(), xml_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    fail(file_, {Place::Unit::Line, 1 + static_cast<std::size_t>(lines)}, why);
  }

  bool skip(std::string_view mark) {
    const bool is_there = xml_.substr(at_, mark.size()) == mark;
    if (is_there) at_ += mark.size();
    return is_there;
  }

  std::string_view until(std::string_view mark) {
    const std::size_t found = xml_.find(mark, at_);
    if (found == xml_.npos) stop(fmt::format("the file ends where {} was expected", mark));
    const std::string_view passed = xml_.substr(at_, found - at_);
    at_ = found + mark.size();
    return passed;
  }

  /// Of several texts in an element the first one counts that is not blank.
  void take_text(std::string_view text) {
    at_ += text.size();
    if (!open_.empty() && elements_[open_.back()].text.empty()) elements_[open_.back()].text = trimmed(text);
  }

  void open() {
    const std::size_t begin = ++at_;
    for (char quote = 0; at_ < xml_.size() && (quote || xml_[at_] != '>'); ++at_)
      if (const char c = xml_[at_]; c == quote || (!quote && (c == '"' || c == '\''))) quote = quote ? '\0' : c;
    if (at_ == xml_.size()) stop("the file ends within a tag");
    std::string_view tag = xml_.substr(begin, at_++ - begin);
    if (tag.ends_with('/'))
      tag.remove_suffix(1);
    else
      open_.push_back(elements_.size());
    const std::size_t name = std::min(tag.size(), tag.find_first_of(kBlanks));
    elements_.push_back({tag.substr(0, name), tag.substr(name), "", elements_.size() + 1});
  }

  void close(std::string_view name) {
    if (open_.empty() || elements_[open_.back()].name != name)
      stop(fmt::format("</{}> closes nothing that is open", printable(name)));
    elements_[open_.back()].end = elements_.size();
    open_.pop_back();
  }

  std::string_view xml_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::vector<Element> elements_;
  std::vector<std::size_t> open_;
};

/// Numbers as assimp reads them.
class Numbers {
 public:
  Numbers(std::string_view text, const std::string& file) : left_(trimmed(text)), file_(file) {}

  bool has_more() const { return !left_.empty(); }

  /// Not always the nearest float: what stands before and behind the point is rounded to float32 apart.
  float real() {
    constexpr std::array<double, 16> kTenths = {0,    1e-1, 1e-2,  1e-3,  1e-4,  1e-5,  1e-6,  1e-7,
                                                1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15};
    constexpr std::size_t kMostBehindPoint = kTenths.size() - 1;
    const bool is_negative = sign();
    float value = is_fraction() ? 0 : static_cast<float>(whole());
    if (is_fraction()) {
      left_.remove_prefix(1);
      const auto [number, count] = digits(kMostBehindPoint);
      while (is_digit(0)) left_.remove_prefix(1);
      value += static_cast<float>(static_cast<double>(number) * kTenths[count]);
    } else {
      skip('.');
    }
    if (skip('e') || skip('E')) {
      const bool is_small = sign();
      const auto exponent = static_cast<float>(whole());
      value *= std::pow(10.0F, is_small ? -exponent : exponent);
    }
    end_number();
    return is_negative ? -value : value;
  }

  /// Negative ones, which some exporters write, are 0.
  std::uint64_t index() {
    const bool is_negative = sign();
    const std::uint64_t number = whole();
    end_number();
    if (number > std::numeric_limits<std::uint32_t>::max()) stop();
    return is_negative ? 0 : number;
  }

 private:
  struct Digits {
    std::uint64_t number = 0;
    std::size_t count = 0;
  };

  bool skip(char c) {
    if (!left_.starts_with(c)) return false;
    left_.remove_prefix(1);
    return true;
  }

  bool sign() { return skip('-') || (skip('+') && false); }
  bool is_digit(std::size_t i) const { return i < left_.size() && left_[i] >= '0' && left_[i] <= '9'; }
  bool is_fraction() const { return (left_.starts_with('.') || left_.starts_with(',')) && is_digit(1); }

  Digits digits(std::size_t most) {
    Digits read;
    if (!is_digit(0)) stop();
    for (; is_digit(0) && read.count < most; left_.remove_prefix(1))
      read = {10 * read.number + static_cast<unsigned>(left_[0] - '0'), read.count + 1};
    return read;
  }

  std::uint64_t whole() {
    constexpr std::size_t kMostDigits = 19;  // that 64 bits hold
    const std::uint64_t number = digits(kMostDigits).number;
    if (is_digit(0)) stop();
    return number;
  }

  void end_number() {
    const std::size_t blanks = std::min(left_.size(), left_.find_first_not_of(kBlanks));
    if (blanks == 0 && has_more()) stop();
    left_.remove_prefix(blanks);
  }

  [[noreturn]] void stop() const {
    fail(file_, kNowhere, fmt::format("a number was expected where {} stands", in_quotes(left_)));
  }

  std::string_view left_;
  const std::string& file_;
};

/// The sine, or the cosine of an angle a quarter turn smaller, with the bits that glibc gives for a float. The
/// polynomials are those of Arm's optimized routines.
float sine(float angle, int quarters = 0) {
  const double x = angle;
  if (!(std::abs(x) < 120)) return static_cast<float>(quarters ? std::cos(x) : std::sin(x));
  constexpr double kQuarterTurn = 0x1.921FB54442D18p0, kPerQuarterTurn = 0x1.45F306DC9C883p+23;  // times 2^24
  const bool is_small = std::abs(angle) < 0x1.921FB6p-1F;
  const int turned = is_small ? 0 : (static_cast<int>(x * kPerQuarterTurn) + 0x800000) >> 24, n = turned + quarters;
  const double rest = x - turned * kQuarterTurn, s = rest * rest, sign = n & 2 ? -1 : 1;
  const double odd = sign * rest, cube = odd * s;
  const double y =
      n & 1 ? sign * (1 + s * -0x1.ffffffd0c621cp-2 + s * s * 0x1.55553e1068f19p-5 +
                      s * s * s * (-0x1.6c087e89a359dp-10 + s * 0x1.99343027bf8c3p-16))
            : odd + cube * -0x1.555545995a603p-3 + cube * s * (0x1.1107605230bc4p-7 + s * -0x1.994eb3774cf24p-13);
  return static_cast<float>(y);
}

using Matrix = std::array<float, 16>;  ///< rows
constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product;
  for (std::size_t i = 0; i < 16; ++i) {
    const std::size_t row = i - i % 4, column = i % 4;
    product[i] =
        b[column] * a[row] + b[4 + column] * a[row + 1] + b[8 + column] * a[row + 2] + b[12 + column] * a[row + 3];
  }
  return product;
}

Matrix scaling(float x, float y, float z) { return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}; }

Matrix rotation(float x, float y, float z, float degrees) {
  constexpr float kPi = 3.14159265358979F;
  const float angle = degrees * kPi / 180, c = sine(angle, 1), s = sine(angle), t = 1 - c;
  Matrix turned = kIdentity;
  turned[0] = t * x * x + c, turned[1] = t * x * y - s * z, turned[2] = t * x * z + s * y;
  turned[4] = t * x * y + s * z, turned[5] = t * y * y + c, turned[6] = t * y * z - s * x;
  turned[8] = t * x * z - s * y, turned[9] = t * y * z + s * x, turned[10] = t * z * z + c;
  return turned;
}

Affine affine(const Matrix& m) {
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

/// Of a `source`: where x, y and z of its positions are.
struct Accessor {
  std::string_view array;
  std::uint64_t count, offset, stride;
  std::array<std::size_t, 3> axes{};
};

struct Geometry {
  std::vector<std::array<float, 3>> corners;
  std::vector<std::uint64_t> sizes;  ///< of polygons
};

class ColladaReader {
 public:
  ColladaReader(std::string_view content, const std::string& file, std::size_t most)
      : file_(file), left_(most), elements_(XmlReader(content, file).elements()), builder_(file, 0, content, {}) {}

  TriangleMesh read() {
    if (elements_.empty() || elements_[0].name != "COLLADA") refuse("it is no COLLADA file");
    for_children(0, [&](std::size_t library) {
      for_children(library, [&](std::size_t e) {
        const Element& element = elements_[e];
        if (element.name == "unit" && elements_[library].name == "asset")
          unit_ = attribute(e, "meter").empty() ? 1 : Numbers(attribute(e, "meter"), file_).real();
        else if (element.name == "geometry")
          geometries_.try_emplace(attribute(e, "id"), geometry(e));
        else if (element.name == "controller")
          for_children(e, [&](std::size_t skin) {
            if (!attribute(skin, "source").empty()) controllers_[attribute(e, "id")] = reference(skin, "source");
          });
        else if (element.name == "visual_scene" || element.name == "node")
          nodes_[attribute(e, "id")] = e;
        else if (element.name == "instance_visual_scene")
          scene_ = reference(e, "url");
      });
    });
    const auto scene = nodes_.find(scene_);
    if (scene == nodes_.end()) refuse("it has no scene");
    place(scene->second);
    return builder_.finish();
  }

 private:
  [[noreturn]] void refuse(std::string_view why) const { fail(file_, kNowhere, why); }

  template <class Do>
  void for_children(std::size_t e, const Do& f) const {
    for (std::size_t child = e + 1; child < elements_[e].end; child = elements_[child].end) f(child);
  }

  /// Empty if there is none. Entities stay as they are written.
  std::string_view attribute(std::size_t e, std::string_view wanted) const {
    const std::string_view all = elements_[e].attributes;
    for (std::size_t at = 0;;) {
      const std::size_t equals = all.find('=', at), quote = all.find_first_of("\"'", equals);
      const std::size_t end = quote == all.npos ? quote : all.find(all[quote], quote + 1);
      if (end == all.npos) return "";
      if (trimmed(all.substr(at, equals - at)) == wanted) return all.substr(quote + 1, end - quote - 1);
      at = end + 1;
    }
  }

  std::uint64_t number(std::size_t e, std::string_view wanted, std::uint64_t otherwise) const {
    const std::string_view text = attribute(e, wanted);
    return text.empty() ? otherwise : Numbers(text, file_).index();
  }

  std::string_view reference(std::size_t e, std::string_view wanted) const {
    const std::string_view text = attribute(e, wanted);
    if (!text.starts_with('#'))
      refuse(fmt::format("<{}> refers to {}, which is not in the file", printable(elements_[e].name), in_quotes(text)));
    return text.substr(1);
  }

  Geometry geometry(std::size_t e) {
    Geometry made;
    std::string_view vertices, positions;
    for_children(e, [&](std::size_t mesh) {
      if (elements_[mesh].name != "mesh") return;
      for_children(mesh, [&](std::size_t part) {
        const std::string_view name = elements_[part].name;
        if (name == "source") {
          read_source(part);
        } else if (name == "vertices") {
          vertices = attribute(part, "id");
          for_children(part, [&](std::size_t input) {
            if (attribute(input, "semantic") == "POSITION") positions = reference(input, "source");
          });
        } else if (name == "triangles" || name == "polylist" || name == "polygons" || name == "tristrips" ||
                   name == "trifans") {
          read_polygons(part, vertices, positions, made);
        }
      });
    });
    return made;
  }

  void read_source(std::size_t e) {
    for_children(e, [&](std::size_t part) {
      if (elements_[part].name == "float_array") {
        std::vector<float>& array = arrays_[attribute(part, "id")];
        array.clear();
        Numbers numbers(elements_[part].text, file_);
        for (std::uint64_t left = number(part, "count", 0); left > 0; --left) array.push_back(numbers.real());
      } else if (elements_[part].name == "technique_common") {
        for_children(part, [&](std::size_t accessor) { read_accessor(accessor, attribute(e, "id")); });
      }
    });
  }

  void read_accessor(std::size_t e, std::string_view id) {
    Accessor read{reference(e, "source"), number(e, "count", 0), number(e, "offset", 0), number(e, "stride", 1)};
    std::size_t param = 0;
    for_children(e, [&](std::size_t child) {
      const std::size_t axis = std::string_view("XYZ").find(attribute(child, "name"));
      if (attribute(child, "name").size() == 1 && axis < 3) read.axes[axis] = param;
      ++param;
    });
    accessors_[id] = read;
  }

  void read_polygons(std::size_t e, std::string_view vertices, std::string_view positions, Geometry& made) {
    const std::string_view kind = elements_[e].name;
    const std::uint64_t count = number(e, "count", 0);
    std::uint64_t inputs = 1, offset = 0;
    std::vector<std::uint64_t> sizes;
    if (count == 0) return;
    for_children(e, [&](std::size_t part) {
      const std::string_view name = elements_[part].name, semantic = attribute(part, "semantic");
      Numbers numbers(elements_[part].text, file_);
      if (name == "input") {
        inputs = std::max(inputs, 1 + number(part, "offset", 0));
        if (semantic == "VERTEX" && reference(part, "source") != vertices) refuse("it has vertices of another mesh");
        if (semantic == "POSITION") positions = reference(part, "source");
        if (semantic == "VERTEX" || semantic == "POSITION") offset = number(part, "offset", 0);
      } else if (name == "vcount") {
        while (sizes.size() < count) sizes.push_back(numbers.index());
      } else if (name == "ph") {
        refuse("it has polygons with holes, which are not read");
      } else if (name == "p") {
        std::vector<std::uint64_t> corners;
        std::uint64_t read = 0;
        for (; numbers.has_more(); ++read)
          if (const std::uint64_t index = numbers.index(); read % inputs == offset) corners.push_back(index);
        if (kind == "triangles") sizes.assign(corners.size() / 3, 3);
        if (kind == "polygons" || kind == "trifans") sizes = {corners.size()};
        if (kind == "tristrips") corners = triangles_of_strip(corners), sizes.assign(corners.size() / 3, 3);
        const bool is_whole = read % inputs == 0 && (kind != "triangles" || sizes.size() == count);
        if (!is_whole || std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0}) != corners.size())
          refuse(fmt::format("it has other numbers of indices than its {} need", kind));
        spend(sizeof(sizes[0]) * sizes.size() + sizeof(made.corners[0]) * corners.size());
        made.sizes.insert(made.sizes.end(), sizes.begin(), sizes.end());
        for (const std::uint64_t corner : corners) made.corners.push_back(position(positions, corner));
      }
    });
  }

  static std::vector<std::uint64_t> triangles_of_strip(const std::vector<std::uint64_t>& strip) {
    std::vector<std::uint64_t> corners;
    for (std::size_t i = 0; i + 2 < strip.size(); ++i)
      corners.insert(corners.end(), {strip[i + i % 2], strip[i + 1 - i % 2], strip[i + 2]});
    return corners;
  }

  std::array<float, 3> position(std::string_view source, std::uint64_t index) const {
    const auto accessor = accessors_.find(source);
    const auto array = accessor == accessors_.end() ? arrays_.end() : arrays_.find(accessor->second.array);
    if (array == arrays_.end()) refuse("its positions are not there");
    const auto& [id, count, offset, stride, axes] = accessor->second;
    std::array<float, 3> found;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint64_t at = offset + index * stride + axes[axis];
      if (index >= count || at >= array->second.size()) refuse(fmt::format("it has no position {}", index));
      found[axis] = array->second[static_cast<std::size_t>(at)];
    }
    return found;
  }

  /// What is read and what is placed costs: nodes may be in many places, and even in each other.
  void spend(std::size_t bytes) {
    if (bytes > left_) refuse("it holds more than the limit for its size");
    left_ -= bytes;
  }

  void place(std::size_t scene) {
    struct Node {
      std::size_t element;
      Affine place;
    };
    for (std::size_t e = scene; e < elements_[scene].end; ++e)
      for (const char* const key : {"name", "id"})
        if (e == scene || elements_[e].name == "node") in_scene_.try_emplace(attribute(e, key), e);
    std::vector<Node> left = {{scene, Affine{} * affine(transform(scene) * scaling(unit_, unit_, unit_))}};
    while (!left.empty()) {
      const Node node = left.back();
      left.pop_back();
      std::vector<Node> inside, instances;
      PerVertex<Vec3> positions;
      VertexWelder welder(positions);
      const std::size_t first = builder_.vertex_count();
      const auto number_of = [&](const std::array<float, 3>& corner) {
        const Vec3 position = node.place(Vec3{corner[0], corner[1], corner[2]});
        const std::size_t number = welder.number_of(position);
        if (number == positions.size()) {
          spend(sizeof(Vec3));
          positions.push_back(position);
          builder_.add_vertex(position, kNowhere);
        }
        return static_cast<std::int64_t>(first + number);
      };
      for_children(node.element, [&](std::size_t child) {
        const std::string_view name = elements_[child].name;
        spend(sizeof(Node));
        if (name == "node") {
          inside.push_back({child, node.place * affine(transform(child))});
        } else if (name == "instance_node") {
          if (const auto other = instanced(reference(child, "url")))
            instances.push_back({*other, node.place * affine(transform(*other))});
        } else if (name == "instance_geometry" || name == "instance_controller") {
          add(reference(child, "url"), node.place, number_of);
        }
      });
      inside.insert(inside.end(), instances.begin(), instances.end());
      left.insert(left.end(), inside.rbegin(), inside.rend());
    }
  }

  /// As assimp does, by ids in the libraries, and then also by names in the scene; what is not there is left out.
  std::optional<std::size_t> instanced(std::string_view url) const {
    for (const auto* const nodes : {&nodes_, &in_scene_})
      if (const auto found = nodes->find(url); found != nodes->end()) return found->second;
    return {};
  }

  template <class NumberOf>
  void add(std::string_view id, const Affine& place, const NumberOf& number_of) {
    const auto skin = controllers_.find(id);
    const auto found = geometries_.find(geometries_.count(id) == 0 && skin != controllers_.end() ? skin->second : id);
    if (found == geometries_.end()) return;
    if (std::isnan(place.origin.x)) refuse("a mesh in a node with <lookat> is not read");
    std::size_t end = 0;
    for (const std::uint64_t size : found->second.sizes) {
      const std::size_t corners = static_cast<std::size_t>(size), begin = end;
      end += corners;
      spend((1 + corners) * sizeof(std::uint32_t));
      if (corners < 3) continue;  // points and lines
      corners_.resize(corners);
      for (std::size_t c = 0; c < corners; ++c)
        corners_[c] = number_of(found->second.corners[place.mirrors() ? end - 1 - c : begin + c]);
      builder_.add_polygon(corners_, kNowhere);
    }
  }

  template <std::size_t kCount>
  std::array<float, kCount> reals(std::size_t e) const {
    Numbers numbers(elements_[e].text, file_);
    std::array<float, kCount> read;
    for (float& value : read) value = numbers.real();
    return read;
  }

  Matrix transform(std::size_t node) {
    Matrix all = kIdentity;
    for_children(node, [&](std::size_t e) {
      const std::string_view name = elements_[e].name;
      spend(sizeof(Matrix));
      if (name == "matrix") {
        all = all * reals<16>(e);
      } else if (name == "translate") {
        const auto [x, y, z] = reals<3>(e);
        all = all * Matrix{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1};
      } else if (name == "rotate") {
        const auto [x, y, z, degrees] = reals<4>(e);
        all = all * rotation(x, y, z, degrees);
      } else if (name == "scale") {
        const auto [x, y, z] = reals<3>(e);
        all = all * scaling(x, y, z);
      } else if (name == "lookat") {
        all.fill(std::numeric_limits<float>::quiet_NaN());  // which cameras have
      }
    });
    return all;
  }

  const std::string& file_;
  std::size_t left_;
  std::vector<Element> elements_;
  MeshBuilder builder_;
  float unit_ = 1;
  std::string_view scene_;
  std::map<std::string_view, std::vector<float>> arrays_;
  std::map<std::string_view, Accessor> accessors_;
  std::map<std::string_view, Geometry> geometries_;
  std::map<std::string_view, std::string_view> controllers_;
  std::map<std::string_view, std::size_t> nodes_, in_scene_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

bool is_collada(const std::filesystem::path& name) { return lower_case_extension(without_gz(name)) == ".dae"; }

TriangleMesh read_collada(std::string_view content, const std::string& file, std::size_t most) {
  if (content.starts_with("\xFF\xFE") || content.starts_with("\xFE\xFF"))  // musl's iconv has 150 kB of tables
    fail(file, kNowhere, "it is in UTF-16; save it in UTF-8");
  return ColladaReader(content, file, most).read();
}

}  // namespace prohull
