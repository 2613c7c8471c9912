// The parts that are set for a scene. tests/portability tests the code that they leave.
#include <algorithm>
#include <map>

#include <catch2/catch.hpp>

#include "images/scenes.h"
#include "render/device_scene.h"

using namespace phlux;
using namespace phlux::test;
using Names = std::vector<std::string>;

namespace {

render::Parts parts_of(const scene::Scene& scene, render::Connect connect = render::Connect::mis) {
  constexpr int lanes = 8;
  render::Settings with;
  with.connect = connect;
  const render::HostScene host = render::prepare(scene, with, lanes);
  return render::find_parts(scene, *host.geometry, host.lights, with, lanes);
}

} // namespace

TEST_CASE("the parts of each shipped scene are just what is in it") {
  const std::map<std::string, Names> expected = {
      {"caustic", {"parallelograms", "ellipses", "spheres", "two_sided", "black", "light_planar", "phong"}},
      {"cornell-box", {"parallelograms", "spheres", "black", "light_planar", "phong"}},
      {"furnace-box", {"parallelograms", "light_planar", "light_choice", "diffuse"}},
      {"furnace-sphere", {"spheres", "light_constant", "sky_samples", "phong"}},
      {"glossy-box", {"parallelograms", "spheres", "black", "light_planar", "phong"}},
      {"leaves",
       {"parallelograms", "spheres", "two_sided", "black", "masks", "checkerboards", "byte_textures",
        "light_sphere", "light_constant", "light_choice", "phong"}},
      {"mesh",
       {"hierarchy", "triangles", "parallelograms", "smooth_normals", "black", "light_planar",
        "light_constant", "light_choice", "phong"}},
      {"glass-caustic",
       {"parallelograms", "spheres", "two_sided", "black", "light_planar", "light_sphere", "light_choice",
        "dielectric", "phong"}},
      {"mirror-and-glass",
       {"parallelograms", "spheres", "two_sided", "black", "light_planar", "dielectric", "diffuse",
        "mirror"}},
      {"mirror-ball", {"parallelograms", "spheres", "black", "light_planar", "mirror", "phong"}},
      {"prism",
       {"parallelograms", "two_sided", "black", "checkerboards", "light_planar", "light_constant",
        "light_choice", "dielectric", "phong"}},
      {"point-light", {"parallelograms", "spheres", "light_point", "phong"}},
      {"textures",
       {"parallelograms", "spheres", "two_sided", "black", "checkerboards", "byte_textures", "light_planar",
        "light_constant", "light_choice", "anisotropicphong", "phong"}},
      {"two-phong-spheres", {"parallelograms", "spheres", "black", "light_planar", "phong"}},
      {"textures",
       {"parallelograms", "spheres", "two_sided", "black", "checkerboards", "byte_textures", "light_planar",
        "light_constant", "light_choice", "anisotropicphong", "phong"}},
  };
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    REQUIRE(expected.contains(name));
    CHECK(parts_of(shipped(name, 4, 4)).names() == expected.at(name));
  }
  const Render image = render_of(shipped("cornell-box", 4, 4), settings_for(1));
  CHECK(image.statistics.parts == expected.at("cornell-box"));
}
