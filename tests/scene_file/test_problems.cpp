#include <catch2/catch.hpp>

#include "scene_file/scenes.h"

using namespace phlux::test;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("One error names all that is wrong, in the order of lines, each remedy once") {
  const std::string error = error_in(R"(<bsdf type="velvet" id="v"/>
<bsdf type="wool" id="w"/>
<shape type="sphere"><ref id="v"/></shape>
<shape type="torus"/>
<shape type="sphere"><ref id="w"/><float name="radios" value="2"/></shape>
<shape type="torus"/>
<shape type="sphere"><ref id="v"/><medium type="homogeneous"/></shape>
<emitter type="sun"/><world/>)");
  const auto at = [&error](const std::string& part) {
    CAPTURE(error, part);
    CHECK(error.find(part) != std::string::npos);
    CHECK(error.find(part) == error.rfind(part));
    return error.find(part);
  };
  CHECK_THAT(error, StartsWith("scene.xml:2: <bsdf type=\"velvet\"> is not supported, line 3: "
                               "<bsdf type=\"wool\"> is not supported: supported are diffuse"));
  const auto torus =
      at("line 5: <shape type=\"torus\"> is not supported (again on line 7): supported are cube");
  const auto radios = at("line 6: 'radios' is not a property of <shape type=\"sphere\">");
  const auto medium =
      at("line 8: <medium type=\"homogeneous\"> inside <shape type=\"sphere\"> is not supported");
  const auto sun = at("line 9: <emitter type=\"sun\"> is not supported");
  CHECK(torus < radios);
  CHECK(radios < medium);
  CHECK(medium < sun);
  at("line 9: element <world> is not supported");
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("Errors of several objects, of their parts and of several mesh files are found together") {
  const std::string error = error_of(scene_text(R"(<sensor type="perspective"><film type="paper"/>
<sampler type="independent"><integer name="sampleCount" value="0"/></sampler></sensor>
<integrator type="ao"/><shape type="sphere"><float name="radius" value="-1"/></shape>
<shape type="sphere"><bsdf type="velvet"/>
<emitter type="area"><rgb name="radiance" value="-1"/></emitter>
<transform name="toWorld"><rotate z="0" angle="3"/></transform></shape>)"));
  for (const char* part : {"<film type=\"paper\">", "line 3: <sampler", "line 4: <integrator type=\"ao\">",
                           "line 4: <shape type=\"sphere\">: radius", "line 5: <bsdf type=\"velvet\">",
                           "line 6: <emitter type=\"area\">: radiance", "line 7: <rotate> without an axis"})
    CHECK_THAT(error, Contains(part));
  const std::string meshes = error_in(R"(<shape type="obj"><string name="filename" value="a.obj"/></shape>
<shape type="ply"><string name="filename" value="b.ply"/></shape>)");
  CHECK_THAT(meshes, Contains("a.obj' cannot be read") && Contains("b.ply' cannot be read"));
}

TEST_CASE("What no shape uses is passed over with a note") {
  const std::string unused = with_sensor(R"(<bsdf type="velvet" id="v"/>
<texture type="wood" id="t"/><medium type="homogeneous" id="m"/>
<shape type="sphere"/>)");
  CHECK(error_of(unused).empty());
  for (const char* name : {"scene.xml:2: <bsdf type=\"velvet\">", "scene.xml:3: <texture type=\"wood\">",
                           "scene.xml:3: <medium type=\"homogeneous\">"})
    CHECK_THAT(log_of(unused), Contains(std::string("info: ") + name + " is used nowhere"));
}

TEST_CASE("A file of many errors is refused at once") {
  std::string worlds;
  for (int i = 0; i < 20000; ++i) worlds += "<world" + std::to_string(i) + "/>";
  CHECK_THAT(error_in(worlds), StartsWith("scene.xml:2: element <world0> is not supported"));
}

TEST_CASE("A mesh whose bsdf is wrong is an error, even if nothing else has one") {
  CHECK_THAT(error_in("<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/>\n"
                      "<bsdf type=\"unknown\"/></shape>"),
             Catch::StartsWith("scene.xml:3: <bsdf type=\"unknown\"> is not supported"));
}
