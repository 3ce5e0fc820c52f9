#pragma once

#include <map>
#include <string>
#include <vector>

#include "robot/files/xml.h"

namespace prohull::robot {

/// "1.10" as 1010, so that versions compare as numbers; 0 if there is none.
int sdf_version(const XmlElement& root);

/// Whether axes of joints are in the frame of the model, as before SDF 1.5.
bool sdf_axes_are_old(const XmlElement& root);

/// Whether a <visual> or <collision> has no collide_bitmask of 0, with which it meets nothing.
bool sdf_collides(const XmlElement& shape);

/// The models of a document, in its worlds too.
std::vector<const XmlElement*> sdf_models(const XmlDocument& document);

/// The model that is read: the first one. Throws InputError(Malformed) if there is none.
const XmlElement& sdf_model(const XmlDocument& document);

/// The links of that model by their names in Robot::links.
std::map<std::string, const XmlElement*> sdf_links(const XmlDocument& document);

}  // namespace prohull::robot
