#include <catch2/catch.hpp>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene_file/load.h"
#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;
using phlux::scene::Vec3;

namespace {

/// A sensor from line 2 on.
std::string sensor(const std::string& inside) {
  return scene_text("<sensor type=\"perspective\">\n" + inside + "</sensor>");
}

std::string film(int width, int height, const std::string& more = "") {
  return "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" + std::to_string(width) +
         "\"/><integer name=\"height\" value=\"" + std::to_string(height) + "\"/>" + more + "</film>";
}

double half_fov(const std::string& axis, int width, int height) {
  const std::string given = axis.empty() ? "" : "<string name=\"fovAxis\" value=\"" + axis + "\"/>";
  return load_text(sensor("<float name=\"fov\" value=\"60\"/>" + given + film(width, height)))
      .camera.tan_half_fov_x;
}

std::string integrator(const std::string& type, const std::string& inside = "") {
  return "<integrator type=\"" + type + "\">\n" + inside + "</integrator>";
}

} // namespace

TEST_CASE("Mitsuba's defaults for camera, film, sampler and integrator") {
  const auto scene = load_text(scene_text("<sensor type=\"perspective\"/>"));
  CHECK(scene.camera.width == 768);
  CHECK(scene.camera.height == 576);
  CHECK(scene.camera.forward == Vec3(0, 0, 1));
  CHECK(scene.camera.left == Vec3(1, 0, 0));
  CHECK(scene.camera.up == Vec3(0, 1, 0));
  const double diagonal = std::hypot(36.0, 24.0) / 100.0; // a lens of 50 mm
  CHECK(scene.camera.tan_half_fov_x == Approx(diagonal * 4.0 / 5.0));
  CHECK(scene.defaults.samples_per_pixel == 4);
  CHECK(scene.defaults.integrator == "path");
  CHECK(scene.defaults.max_depth == -1);
  CHECK(scene.defaults.rr_depth == 5);
}

TEST_CASE("The field of view along every axis") {
  const double t = std::tan(glm::radians(30.0));
  CHECK(half_fov("", 300, 200) == Approx(t));
  CHECK(half_fov("x", 300, 200) == Approx(t));
  CHECK(half_fov("y", 300, 200) == Approx(t * 1.5));
  CHECK(half_fov("smaller", 300, 200) == Approx(t * 1.5));
  CHECK(half_fov("larger", 300, 200) == Approx(t));
  CHECK(half_fov("smaller", 200, 300) == Approx(t));
  CHECK(half_fov("larger", 200, 300) == Approx(t / 1.5));
  CHECK(half_fov("diagonal", 400, 300) == Approx(t * 0.8));
  CHECK(load_text(sensor("<string name=\"focalLength\" value=\"35mm\"/>" + film(40, 30)))
            .camera.tan_half_fov_x == Approx(std::hypot(36.0, 24.0) / 70.0 * 0.8));
  CHECK_THAT(error_of(sensor("<float name=\"fov\" value=\"180\"/>")), StartsWith("scene.xml:3: "));
  CHECK_THAT(error_of(sensor("<float name=\"fov\" value=\"0\"/>")), StartsWith("scene.xml:3: "));
  CHECK_THAT(error_of(sensor("<float name=\"fov\" value=\"50\"/>\n<string name=\"fovAxis\" value=\"z\"/>")),
             StartsWith("scene.xml:4: ") && Contains("x, y, diagonal, smaller or larger"));
}

TEST_CASE("Another size keeps the field of view along its axis, as another film would") {
  const TemporaryFolder folder;
  for (const char* axis : {"x", "y", "diagonal", "smaller", "larger"}) {
    CAPTURE(axis);
    folder.write("scene.xml", sensor("<float name=\"fov\" value=\"60\"/><string name=\"fovAxis\" value=\"" +
                                     std::string(axis) + "\"/>" + film(300, 200)));
    const auto camera = phlux::scene_file::load(folder / "scene.xml", {}, {{200, 500}}).camera;
    CHECK(camera.width == 200);
    CHECK(camera.height == 500);
    CHECK(camera.tan_half_fov_x == half_fov(axis, 200, 500));
  }
}

TEST_CASE("Both spellings") {
  const auto scene = load_text(scene_text(R"(
    <integrator type="path"><integer name="max_depth" value="7"/><integer name="rr_depth" value="3"/></integrator>
    <sensor type="perspective"><float name="fov" value="90"/><string name="fov_axis" value="y"/>
      <float name="principal_point_offset_x" value=".25"/><float name="near_clip" value="1"/>
      <transform name="to_world"><lookat origin="0 0 5" target="0 0 0" up="0 1 0"/></transform>
      <sampler type="independent"><integer name="sample_count" value="16"/></sampler>
      <film type="hdrfilm"><integer name="width" value="20"/><integer name="height" value="10"/>
        <string name="pixel_format" value="rgb"/></film></sensor>)",
                                          "3.0.0"));
  CHECK(scene.camera.tan_half_fov_x == Approx(2.0));
  CHECK(scene.camera.principal_x == 0.25);
  CHECK(scene.camera.position == Vec3(0, 0, 5));
  CHECK(scene.camera.forward == Vec3(0, 0, -1));
  CHECK(scene.camera.left == Vec3(-1, 0, 0));
  CHECK(scene.defaults.samples_per_pixel == 16);
  CHECK(scene.defaults.max_depth == 7);
  CHECK(scene.defaults.rr_depth == 3);
}

TEST_CASE("A camera may be mirrored, but neither scaled nor sheared") {
  const auto camera = load_text(sensor("<transform name=\"toWorld\"><scale x=\"-1\"/></transform>")).camera;
  CHECK(camera.left == Vec3(-1, 0, 0));
  CHECK(camera.up == Vec3(0, 1, 0));
  CHECK_THAT(error_of(sensor("<transform name=\"toWorld\"><scale value=\"2\"/></transform>")),
             StartsWith("scene.xml:3: ") && Contains("it scales or shears"));
}

TEST_CASE("Integrators") {
  const auto named = [](const std::string& type) { return load_body(integrator(type)).defaults.integrator; };
  CHECK(named("path") == "path");
  CHECK(named("ptracer") == "light");
  CHECK(named("bdpt") == "bidir");
  CHECK(load_body(integrator("path", "<integer name=\"maxDepth\" value=\"-1\"/>")).defaults.max_depth == -1);
  CHECK_THAT(error_in(integrator("ao")), StartsWith("scene.xml:2: <integrator type=\"ao\"> is not supported: "
                                                    "supported are path, ptracer, bdpt"));
  for (const char* name : {"maxDepth", "rrDepth"})
    for (const char* value : {"0", "-2"})
      CHECK_THAT(error_in(integrator("path", "<integer name=\"" + std::string(name) + "\" value=\"" + value +
                                                 "\"/>")),
                 StartsWith("scene.xml:3: ") && Contains("is out of range"));
  CHECK(load_body(integrator("path", "<boolean name=\"hideEmitters\" value=\"true\"/>")).hide_emitters);
  CHECK_FALSE(load_body(integrator("path")).hide_emitters);
}

TEST_CASE("Methods of Mitsuba for the same radiance are replaced, with a note") {
  const auto defaults = load_body(integrator("direct", "<integer name=\"emitterSamples\" value=\"4\"/>"
                                                       "<integer name=\"bsdfSamples\" value=\"2\"/>"))
                            .defaults;
  CHECK(defaults.integrator == "path");
  CHECK(defaults.max_depth == 2);
  CHECK(load_body(integrator("volpath", "<integer name=\"max_depth\" value=\"9\"/>"), "3.0.0")
            .defaults.max_depth == 9);
  CHECK(load_body(integrator("pssmlt")).defaults.integrator == "bidir");
  const std::string nested = integrator("aov", "<integrator type=\"ptracer\"/>");
  CHECK(load_body(nested, "3.0.0").defaults.integrator == "light");
  CHECK_THAT(log_of(with_sensor(integrator("photonmapper"))),
             Contains("info: scene.xml:2: <integrator type=\"photonmapper\"> is replaced by path"));
}

TEST_CASE("Names that seem to be misspelt are errors, even where unknown ones are passed over") {
  const auto film = [](const std::string& name) {
    return error_of(scene_text("<sensor type=\"perspective\">\n<film type=\"hdrfilm\"><integer name=\"" +
                               name + "\" value=\"9\"/></film></sensor>"));
  };
  CHECK_THAT(film("widht"),
             Contains("scene.xml:3: <film type=\"hdrfilm\">: widht: is not a property of <film "
                      "type=\"hdrfilm\">: did you mean width?"));
  CHECK_THAT(error_in(integrator("volpath", "<integer name=\"maxdepth\" value=\"9\"/>")),
             Contains("did you mean maxDepth?"));
}

TEST_CASE("Films: sizes, crops, filters") {
  for (const auto& [width, height] :
       {std::pair{0, 0}, std::pair{5, 0}, std::pair{-3, 5}, std::pair{32769, 1}})
    CHECK_THAT(error_of(sensor(film(width, height))),
               StartsWith("scene.xml:3: ") && Contains("is out of range: 1 to 32768"));
  const auto crop_in = [](const std::string& properties) {
    return load_text(sensor(film(8, 6, properties))).defaults.crop;
  };
  CHECK_FALSE(crop_in("<integer name=\"cropWidth\" value=\"8\"/>"));
  CHECK(crop_in("<integer name=\"cropWidth\" value=\"4\"/>") == phlux::scene::Window{0, 0, 4, 6});
  CHECK(crop_in("<integer name=\"cropOffsetX\" value=\"5\"/><integer name=\"cropOffsetY\" value=\"1\"/>"
                "<integer name=\"cropWidth\" value=\"3\"/><integer name=\"cropHeight\" value=\"2\"/>") ==
        phlux::scene::Window{5, 1, 3, 2});
  CHECK_THAT(error_of(sensor(film(8, 8, "\n<integer name=\"cropOffsetX\" value=\"5\"/>"))),
             StartsWith("scene.xml:4: ") && Contains("the crop window is not within the film"));
  CHECK_THAT(error_of(sensor("<film type=\"paper\"/>")),
             StartsWith("scene.xml:3: <film type=\"paper\"> is not supported"));
  const std::string ldr = "<film type=\"ldrfilm\"><integer name=\"width\" value=\"7\"/>\n"
                          "<float name=\"gamma\" value=\"2.2\"/></film>";
  CHECK(load_text(sensor(ldr)).camera.width == 7);
  CHECK_THAT(log_of(sensor(ldr)), Contains("info: scene.xml:3: <film type=\"ldrfilm\"> is read as hdrfilm") &&
                                      Contains("info: scene.xml:4: 'gamma' cannot change the image"));
  const std::string gaussian =
      film(8, 8, "\n<rfilter type=\"gaussian\"><float name=\"stddev\" value=\"1\"/></rfilter>");
  using Kind = phlux::scene::Filter::Kind;
  CHECK(load_text(sensor(gaussian)).camera.filter.kind == Kind::gaussian);
  CHECK(load_text(sensor(gaussian)).camera.filter.size == 1.0);
  const auto filter = [](const std::string& type, const std::string& inside = "") {
    return sensor(film(8, 8, "\n<rfilter type=\"" + type + "\">" + inside + "</rfilter>"));
  };
  CHECK(load_text(filter("gaussian")).camera.filter.size == 0.5);
  CHECK(load_text(filter("tent")).camera.filter.kind == Kind::tent);
  CHECK(load_text(filter("tent")).camera.filter.size == 1.0);
  CHECK(load_text(filter("tent", "<float name=\"radius\" value=\"2\"/>")).camera.filter.size == 2.0);
  CHECK(load_text(filter("box")).camera.filter.kind == Kind::box);
  for (const char* type : {"mitchell", "catmullrom", "lanczos"}) {
    CHECK_THAT(log_of(filter(type)),
               Contains("warning: scene.xml:4: <rfilter type=\"" + std::string(type) +
                        "\"> has negative lobes, which cannot be sampled; box is used"));
    CHECK(load_text(filter(type)).camera.filter.kind == Kind::box);
  }
  for (const char* radius : {"0", "-1", "1001"})
    CHECK_THAT(error_of(filter("tent", "<float name=\"radius\" value=\"" + std::string(radius) + "\"/>")),
               StartsWith("scene.xml:4: ") && Contains("more than 0 and at most 1000"));
  CHECK_THAT(error_of(filter("box", "<float name=\"radius\" value=\"2\"/>")),
             Contains("the box filter is one pixel wide"));
  CHECK_THAT(error_of(sensor(film(8, 8, "<rfilter type=\"blocks\"/>"))),
             StartsWith("scene.xml:3: <rfilter type=\"blocks\"> is not supported"));
  CHECK_THAT(log_of(sensor(film(8, 8, "\n<boolean name=\"banner\" value=\"false\"/>"))),
             Contains("info: scene.xml:4: 'banner' cannot change the image"));
}

TEST_CASE("Samplers and sensors of other kinds") {
  CHECK_THAT(
      log_of(sensor("<sampler type=\"sobol\"/>")),
      Contains("warning: scene.xml:3: <sampler type=\"sobol\"> is not supported; independent is used"));
  CHECK(load_text(sensor("<sampler type=\"blue\"><integer name=\"sampleCount\" value=\"9\"/></sampler>"))
            .defaults.samples_per_pixel == 9);
  CHECK_THAT(
      error_of(sensor("<sampler type=\"independent\"><integer name=\"sampleCount\" value=\"0\"/></sampler>")),
      StartsWith("scene.xml:3: ") && Contains("is out of range"));
  CHECK_THAT(
      error_of(scene_text("<sensor type=\"spherical\"/>")),
      StartsWith("scene.xml:2: <sensor type=\"spherical\"> is not supported: supported are perspective, "
                 "thinlens and orthographic"));
}

TEST_CASE("A thin lens has a radius and a distance in focus") {
  const auto lens = [](const std::string& inside) {
    return scene_text("<sensor type=\"thinlens\"><float name=\"fov\" value=\"40\"/>\n" + inside +
                      "</sensor>");
  };
  const std::string radius = "<float name=\"apertureRadius\" value=\"0.25\"/>";
  const std::string focus = "<float name=\"focusDistance\" value=\"3\"/>";
  const auto camera = load_text(lens(radius + focus)).camera;
  CHECK(camera.aperture_radius == 0.25);
  CHECK(camera.focus_distance == 3.0);
  CHECK(camera.tan_half_fov_x ==
        load_text(sensor("<float name=\"fov\" value=\"40\"/>")).camera.tan_half_fov_x);
  CHECK(load_text(lens(radius)).camera.focus_distance == 1e4);
  CHECK(load_text(lens(radius + "<float name=\"farClip\" value=\"50\"/>")).camera.focus_distance == 50.0);
  CHECK_THAT(error_of(lens(focus)), Contains("apertureRadius: it is missing"));
  CHECK_THAT(error_of(lens("<float name=\"apertureRadius\" value=\"-1\"/>")),
             StartsWith("scene.xml:3: ") && Contains("apertureRadius: it is negative"));
  CHECK_THAT(error_of(lens(radius + "\n<float name=\"focusDistance\" value=\"0\"/>")),
             StartsWith("scene.xml:4: ") && Contains("focusDistance: it is not positive"));
}

TEST_CASE("An orthographic camera takes the width of its film from the scale of toWorld") {
  const auto sized = [](const std::string& transform) {
    return scene_text("<sensor type=\"orthographic\">\n<transform name=\"toWorld\">" + transform +
                      "</transform></sensor>");
  };
  const auto camera =
      load_text(sized("<scale x=\"3\" y=\"3\"/><lookat origin=\"0 0 5\" target=\"0 0 0\" up=\"0 1 0\"/>"))
          .camera;
  CHECK(camera.orthographic);
  CHECK(camera.tan_half_fov_x == Approx(3.0));
  CHECK(camera.forward == Vec3(0, 0, -1));
  CHECK(camera.position == Vec3(0, 0, 5));
  CHECK(glm::length(camera.left) == Approx(1.0));
  CHECK_THAT(error_of(sized("<scale x=\"3\" y=\"2\"/>")),
             StartsWith("scene.xml:3: ") && Contains("scales x and y differently"));
  CHECK_THAT(error_of(sized("<matrix value=\"1 0 0 0 0 1 1 0 0 0 1 0 0 0 0 1\"/>")), Contains("it shears"));
}

TEST_CASE("A film has at most 2^28 pixels, unless another size replaces its own") {
  CHECK_THAT(error_of(sensor(film(32768, 8193))),
             StartsWith("scene.xml:3: a film of 32768x8193 pixels: at most 32768 pixels along each side"));
  CHECK(error_of(sensor(film(32768, 8192))).empty());
  CHECK_THAT(error_of(sensor(film(32769, 1))), Contains("width: 32769 is out of range: 1 to 32768"));
}
