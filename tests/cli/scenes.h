// Scenes that render in an instant: an emitting sphere fills a quarter of the image.
#pragma once

#include <string>

#include "temporary_folder.h"

/// A camera with a 16x12 film, and `body`.
[[nodiscard]] inline std::string scene_with(const std::string& body, const std::string& film_size = "16 12") {
  const std::size_t space = film_size.find(' ');
  return "<scene version=\"0.6.0\">\n"
         "<integrator type=\"path\"/>\n"
         "<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/>\n"
         "<transform name=\"toWorld\"><lookat origin=\"0, 0, -4\" target=\"0, 0, 0\" up=\"0, 1, "
         "0\"/></transform>\n"
         "<sampler type=\"independent\"><integer name=\"sampleCount\" value=\"8\"/></sampler>\n"
         "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" +
         film_size.substr(0, space) + "\"/><integer name=\"height\" value=\"" + film_size.substr(space + 1) +
         "\"/><rfilter type=\"box\"/></film></sensor>\n" + body + "</scene>\n";
}

inline const std::string light =
    "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>\n";

[[nodiscard]] inline std::string sphere_of(const std::string& bsdf) {
  return "<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/>" + bsdf + "</shape>\n";
}

/// A grey sphere on a slab under a small light: noisy with every method.
inline const std::string good_scene =
    scene_with("<default name=\"radiance\" value=\"20\"/>\n" +
               sphere_of("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\".5\"/></bsdf>") +
               "<shape type=\"rectangle\"><transform name=\"toWorld\"><scale value=\"8\"/><rotate x=\"1\" "
               "angle=\"-90\"/>"
               "<translate y=\"-1\"/></transform><bsdf type=\"diffuse\"/></shape>\n"
               "<shape type=\"sphere\"><point name=\"center\" x=\"2\" y=\"3\" z=\"-2\"/><float "
               "name=\"radius\" value=\"0.5\"/>"
               "<emitter type=\"area\"><rgb name=\"radiance\" value=\"$radiance\"/></emitter></shape>\n");
