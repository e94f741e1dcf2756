// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "support/planned_sets.h"

namespace kiln {
namespace {

using test::map_of;
using test::Workshop;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<PlannedSet> sets_of(const Workshop& shop, const std::string& body,
                                const std::string& root = "version=\"1.38\"") {
  return test::sets_of_document(shop.write(
      "a.mtlx", "<?xml version=\"1.0\"?>\n<materialx " + root + ">\n" + body + "</materialx>\n"));
}

std::string fault_of(const Workshop& shop, const std::string& body) {
  return test::input_fault_of(sets_of(shop, body));
}

const char* const graph = R"(
<nodegraph name="NG">
  <tiledimage name="c" type="color3">
    <input name="file" type="filename" value="c.png" colorspace="srgb_texture"/>
    <input name="uaddressmode" type="string" value="mirror"/>
  </tiledimage>
  <image name="orm" type="vector3"><input name="file" type="filename" value="orm.png"/></image>
  <extract name="r" type="float"><input name="in" type="vector3" nodename="orm"/>
    <input name="index" type="integer" value="1"/></extract>
  <separate3 name="s" type="multioutput"><input name="in" type="vector3" nodename="orm"/></separate3>
  <image name="n" type="vector3"><input name="file" type="filename" value="n.png"/></image>
  <normalmap name="nm" type="vector3"><input name="in" type="vector3" nodename="n"/>
    <input name="scale" type="float" value="0.5"/></normalmap>
  <output name="oc" type="color3" nodename="c"/>
  <output name="or" type="float" nodename="r"/>
  <output name="om" type="float" nodename="s" output="outb"/>
  <output name="orm" type="vector3" nodename="orm"/>
  <output name="on" type="vector3" nodename="nm"/>
</nodegraph>
)";

TEST(MaterialX, FollowsTheInputsOfStandardSurfaceToImagesAndConstants) {
  const Workshop shop;
  const auto sets = sets_of(shop, std::string(graph) + R"(
<standard_surface name="S" type="surfaceshader">
  <input name="base" type="float" value="0.5"/>
  <input name="base_color" type="color3" nodegraph="NG" output="oc"/>
  <input name="specular_roughness" type="float" nodegraph="NG" output="or"/>
  <input name="metalness" type="float" nodegraph="NG" output="om"/>
  <input name="specular_color" type="color3" value="0.5, 0.25, 1"/>
  <input name="specular_anisotropy" type="float" value="0.45"/>
  <input name="specular_rotation" type="float" value="0.25"/>
  <input name="normal" type="vector3" nodegraph="NG" output="on"/>
  <input name="coat" type="float" value="1"/>
</standard_surface>
<surfacematerial name="Tiles" type="material">
  <input name="surfaceshader" type="surfaceshader" nodename="S"/>
</surfacematerial>)",
                            "version=\"1.38\" colorspace=\"lin_rec709\" fileprefix=\"tex/\"");
  ASSERT_EQ(sets.size(), 1u);
  const PlannedSet& set = sets[0];
  ASSERT_FALSE(set.fault) << set.fault->what();
  EXPECT_EQ(set.name, "Tiles");
  EXPECT_EQ(set.reading.wrap, WrapChoice::Mirror);
  EXPECT_EQ(map_of(set, Slot::BaseColor).path, shop / "tex/c.png");
  EXPECT_EQ(map_of(set, Slot::BaseColor).color_space, "srgb_rec709_scene");
  EXPECT_EQ(map_of(set, Slot::BaseColor).decoding.scale[0], 0.5f);
  EXPECT_EQ(map_of(set, Slot::Roughness).channels, "g");
  EXPECT_EQ(map_of(set, Slot::Metallic).channels, "b");
  EXPECT_THAT(*map_of(set, Slot::SpecularTint).value, ElementsAre(0.5f, 0.25f, 1));
  EXPECT_EQ(map_of(set, Slot::SpecularLevel).encoding, SpecularEncoding::Ior);
  EXPECT_EQ(map_of(set, Slot::SpecularLevel).value->at(0), 1.5f);
  EXPECT_NEAR(map_of(set, Slot::Anisotropy).decoding.scale[0], 1 / 0.9f, 1e-6);
  EXPECT_EQ(map_of(set, Slot::AnisotropyAngle).value->at(0), 0.25f);
  EXPECT_EQ(map_of(set, Slot::Normal).decoding.scale[0], 0.5f);
  EXPECT_EQ(map_of(set, Slot::Normal).convention, NormalConvention::OpenGl);
  ASSERT_EQ(set.ignored.size(), 1u);
  EXPECT_EQ(set.ignored[0].file, "coat");
}

TEST(MaterialX, ReadsGltfPbrWithChannelsAndOpenPbrWithoutAMaterial) {
  const Workshop shop;
  const auto gltf = sets_of(shop, std::string(graph) + R"(
<gltf_pbr name="G" type="surfaceshader">
  <input name="roughness" type="float" nodegraph="NG" output="orm" channels="y"/>
  <input name="occlusion" type="float" nodegraph="NG" output="orm" channels="x"/>
</gltf_pbr>)");
  EXPECT_EQ(gltf.at(0).name, "G");
  EXPECT_EQ(map_of(gltf[0], Slot::Roughness).channels, "g");
  EXPECT_EQ(map_of(gltf[0], Slot::AmbientOcclusion).channels, "r");
  EXPECT_EQ(map_of(gltf[0], Slot::Metallic).value->at(0), 1);
  const auto open = sets_of(shop, R"(
<image name="c" type="color3"><input name="file" type="filename" value="c.exr"/></image>
<open_pbr_surface name="O" type="surfaceshader">
  <input name="base_color" type="color3" nodename="c"/>
  <input name="base_metalness" type="float" value="1"/>
</open_pbr_surface>)");
  EXPECT_EQ(map_of(open.at(0), Slot::BaseColor).path, shop / "c.exr");
  EXPECT_EQ(map_of(open[0], Slot::BaseColor).color_space, "") << "by the type of the file";
  EXPECT_EQ(map_of(open[0], Slot::Roughness).value->at(0), 0.3f);
}

TEST(MaterialX, SpreadsOverUdimTiles) {
  const Workshop shop;
  shop.paint("c.1001.png", 0.5f, PixelType::Uint8);
  shop.paint("c.1002.png", 0.5f, PixelType::Uint8);
  const auto sets = sets_of(shop, R"(
<image name="c" type="color3"><input name="file" type="filename" value="c.&lt;UDIM&gt;.png"/></image>
<standard_surface name="S" type="surfaceshader">
  <input name="base_color" type="color3" nodename="c"/>
</standard_surface>)");
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[1].name, "S.1002");
}

TEST(MaterialX, NamesWhatStandsBetweenAnInputAndItsImage) {
  const Workshop shop;
  const std::string shader = R"(
<standard_surface name="S" type="surfaceshader">
  <input name="base_color" type="color3" nodename="noise1"/>
</standard_surface>)";
  EXPECT_THAT(fault_of(shop, "<noise2d name=\"noise1\" type=\"color3\"/>" + shader),
              AllOf(HasSubstr("a.mtlx:3: "),
                    HasSubstr("node 'noise1' (noise2d) feeds base_color: only images and constants "
                              "are read")));
  EXPECT_THAT(fault_of(shop, shader), HasSubstr("node 'noise1' is not in this file"));
  EXPECT_THAT(
      fault_of(shop, R"(<dot name="noise1"><input name="in" nodename="noise1"/></dot>)" + shader),
      HasSubstr("in a circle"));
  EXPECT_THAT(fault_of(shop, R"(<toon name="T"/><surfacematerial name="M">
<input name="surfaceshader" nodename="T"/></surfacematerial>)"),
              HasSubstr("material 'M' is a toon"));
  EXPECT_THAT(fault_of(shop, "<broken"), HasSubstr("this is not XML"));
  EXPECT_THAT(fault_of(shop, ""), HasSubstr("no material"));
}

}  // namespace
}  // namespace kiln
