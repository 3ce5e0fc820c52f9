#include "values.h"

#include <algorithm>
#include <cmath>

namespace prohull::js {
namespace {

[[noreturn]] void refuse_value(const std::string& what, const std::string& expected) {
  throw InputError(Defect::InvalidOption, what + ": expected " + expected);
}

std::string text_of(const val& value) { return val::global("String")(value).as<std::string>(); }

std::vector<Vec3> positions_of(const val& vertices, const std::string& name) {
  const std::vector<double> numbers = numbers_of(vertices, name);
  if (numbers.size() % 3 != 0)
    refuse_value(name, "three numbers for each vertex, not " + std::to_string(numbers.size()));
  std::vector<Vec3> positions(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) positions[i / 3][static_cast<int>(i % 3)] = numbers[i];
  return positions;
}

std::vector<std::array<VertexId, 3>> triangles_of(const val& faces, std::size_t vertices, const std::string& name) {
  const std::vector<double> numbers = numbers_of(faces, name);
  if (numbers.size() % 3 != 0) refuse_value(name, "three numbers for each face, not " + std::to_string(numbers.size()));
  std::vector<std::array<VertexId, 3>> triangles(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double number = numbers[i];
    if (!(number >= 0 && number < static_cast<double>(vertices) && number == std::trunc(number)))
      refuse_value(name + "[" + std::to_string(i) + "]=" + text_of(val(number)),
                   "the number of one of " + std::to_string(vertices) + " vertices, from 0 on");
    triangles[i / 3][i % 3] = VertexId(static_cast<std::uint32_t>(number));
  }
  return triangles;
}

}  // namespace

void check_whole(double number, const std::string& what, double least, double most) {
  const auto refuse = [&](const char* limit, double bound) {
    refuse_value(what + "=" + text_of(val(number)),
                 std::string("a whole number, ") + limit + " " + text_of(val(bound)));
  };
  if (number > most) refuse("at most", most);
  if (!(number >= least && number == std::trunc(number))) refuse("at least", least);
}

std::string camel_case(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] == '_' && i + 1 < name.size())
      result += static_cast<char>(name[++i] - 'a' + 'A');
    else
      result += name[i];
  return result;
}

val Given::value(const char* name) const {
  known_.push_back(camel_case(name));
  return values_[known_.back()];
}

void Given::refuse(const char* name, const std::string& expected) const {
  const std::string in_js = camel_case(name);
  refuse_value(in_js + "=" + text_of(values_[in_js]), expected);
}

bool Given::flag(const char* name, bool& to) const {
  const val given = value(name);
  if (given.isUndefined()) return false;
  if (!given.isTrue() && !given.isFalse()) refuse(name, "true or false");
  return to = given.isTrue(), true;
}

bool Given::number(const char* name, double& to) const {
  const val given = value(name);
  if (given.isUndefined()) return false;
  if (!given.isNumber()) refuse(name, "a number");
  return to = given.as<double>(), true;
}

bool Given::not_negative(const char* name, double& to) const {
  double given = 0;
  if (!number(name, given)) return false;
  if (!(given >= 0)) refuse(name, "a number, at least 0");
  return to = given, true;
}

bool Given::positive(const char* name, double& to) const {
  double given = 0;
  if (!number(name, given)) return false;
  if (!(given > 0)) refuse(name, "a number greater than 0");
  return to = given, true;
}

bool Given::whole(const char* name, double least, double most, double& to) const {
  double given = 0;
  if (!number(name, given)) return false;
  check_whole(given, camel_case(name), least, most);
  return to = given, true;
}

bool Given::text(const char* name, std::string& to) const {
  const val given = value(name);
  if (given.isUndefined()) return false;
  if (!given.isString()) refuse(name, "a text");
  return to = given.as<std::string>(), true;
}

bool Given::numbers(const char* name, PerFace<double>& to) const {
  const val given = value(name);
  if (given.isUndefined()) return false;
  return to = PerFace<double>(numbers_of(given, name)), true;
}

std::optional<std::string> Given::word(const char* name, const std::string& choices) const {
  const val given = value(name);
  if (given.isUndefined()) return {};
  if (!given.isString()) refuse(name, "one of " + choices);
  return given.as<std::string>();
}

void Given::refuse_others() const {
  const val names = val::global("Object").call<val>("keys", values_);
  for (const std::string& name : emscripten::vecFromJSArray<std::string>(names))
    if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
      std::string all;
      for (const std::string& known : known_) (all += all.empty() ? "" : ", ") += known;
      throw InputError(Defect::InvalidOption, name + ": there is no such option, only " + all);
    }
}

std::vector<double> numbers_of(const val& array, const std::string& name) {
  if (!array["BYTES_PER_ELEMENT"].isNumber()) refuse_value(name, "an array of numbers");
  return emscripten::convertJSArrayToNumberVector<double>(array);
}

TriangleMesh mesh_of(const val& mesh, const std::string& name) {
  if (mesh.isUndefined() || mesh.isNull()) refuse_value(name, "an object with vertices and faces");
  TriangleMesh result;
  result.positions = PerVertex<Vec3>(positions_of(mesh["vertices"], name + ".vertices"));
  result.triangles =
      PerFace<std::array<VertexId, 3>>(triangles_of(mesh["faces"], result.vertex_count(), name + ".faces"));
  return result;
}

val array_of(const Vec3& p) {
  const double numbers[]{p.x, p.y, p.z};
  return array_of(numbers, 3);
}

val object_of_mesh(const TriangleMesh& mesh) {
  val object = val::object();
  object.set("vertices", array_of(reinterpret_cast<const double*>(mesh.positions.data()), 3 * mesh.vertex_count()));
  object.set("faces", array_of(reinterpret_cast<const std::uint32_t*>(mesh.triangles.data()), 3 * mesh.face_count()));
  return object;
}

val object_of_file(std::string_view content) {
  val object = val::object();
  object.set("bytes", array_of(reinterpret_cast<const unsigned char*>(content.data()), content.size()));
  return object;
}

val strings_of(const std::vector<std::string>& strings) { return val::array(strings); }

}  // namespace prohull::js
