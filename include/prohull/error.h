#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace prohull {

enum class Defect {
  CannotRead,               ///< the file does not exist or the system refuses it
  CannotWrite,              ///< the folder does not exist, is read-only, or is full
  UnknownFormat,            ///< neither the name nor the content tells a format that is read or written here
  Malformed,                ///< the file contradicts its own format; the message has the line or byte offset
  NonFiniteCoordinate,      ///< NaN or infinity, or a value that the format cannot store
  EmptyMesh,                ///< no triangle
  OpenEdge,                 ///< an edge with one face
  NonManifoldEdge,          ///< an edge with more than two faces
  InconsistentOrientation,  ///< neighbouring faces that disagree about the outside
  NonManifoldVertex,        ///< faces around a vertex that are not one disk
  NoVolume,                 ///< closed, but encloses nothing
  NoLength,                 ///< a segment whose ends are equal, or a ray without direction
  NoCertificate,            ///< no hull that was built could be certified
  InvalidOption,            ///< an option outside its documented range
  NotSymmetric,             ///< no exact mirror image of itself, as HullOptions::mirror needs
};

/// Thrown at the door, by whatever reads a file or takes a mesh; what() says what is wrong, where, and what to do.
class InputError : public std::runtime_error {
 public:
  InputError(Defect defect, const std::string& message) : std::runtime_error(message), defect_(defect) {}
  Defect defect() const { return defect_; }

 private:
  Defect defect_;
};

/// Thrown when a progress callback asks to stop; nothing was written or changed.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace prohull
