// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "kiln/bake/pack_layout.h"
#include "kiln/pipeline/pipeline.h"
#include "support/workshop.h"

namespace kiln {
namespace {

using test::message_of;
using test::Workshop;
using testing::HasSubstr;

constexpr const char* engines = R"(version: 1
layouts:
  mobile:
    summary: one packed file
    files:
      ORM: ambient_occlusion, roughness, metallic
      N: normal_dx
  desktop:
    files: { Mask: "metallic, 0.5, smoothness" }
)";

TEST(LayoutText, OfWordsIsThoseWords) {
  EXPECT_EQ(layout_text("a = roughness", {}), "a = roughness");
  EXPECT_EQ(layout_text("", {}), "");
}

TEST(LayoutText, OfAPresetIsItsLayout) {
  EXPECT_EQ(layout_text("unity-hdrp", {}), find_pack_preset("unity-hdrp").layout);
  EXPECT_EQ(message_of([] { layout_text("unrel", {}); }),
            "unknown preset 'unrel' (did you mean 'unreal'?)");
}

TEST(LayoutText, OfAFileIsTheLayoutThatIsNamed) {
  const Workshop shop;
  shop.write("engines.yaml", engines);
  EXPECT_EQ(layout_text("engines.yaml#mobile", shop.folder()),
            "ORM = ambient_occlusion, roughness, metallic; N = normal_dx");
  EXPECT_EQ(layout_text((shop / "engines.yaml#desktop").string(), {}),
            "Mask = metallic, 0.5, smoothness");
}

TEST(LayoutText, OfAFileWithOneLayoutNeedsNoName) {
  const Workshop shop;
  shop.write("one.json", R"({"layouts": {"mine": {"files": {"r": "roughness"}}}})");
  EXPECT_EQ(layout_text("one.json", shop.folder()), "r = roughness");
  shop.write("engines.yaml", engines);
  EXPECT_THAT(message_of([&] { layout_text("engines.yaml", shop.folder()); }),
              HasSubstr("holds 2: mobile, desktop; expected one of them, as engines.yaml#mobile"));
}

TEST(LayoutText, NamesTheNearestLayoutOfTheFile) {
  const Workshop shop;
  shop.write("engines.yaml", engines);
  EXPECT_THAT(message_of([&] { layout_text("engines.yaml#mobil", shop.folder()); }),
              HasSubstr("engines.yaml: unknown layout 'mobil' (did you mean 'mobile'?)"));
}

TEST(LayoutText, TellsEveryMistakeInAFileWithItsPlace) {
  const Workshop shop;
  shop.write("bad.yaml", R"(layouts:
  one:
    sumary: typo
    files:
      ORM: ambient_occlusion, ruffness, metallic
      N: normal.q
)");
  const std::string message = message_of([&] { layout_text("bad.yaml", shop.folder()); });
  EXPECT_THAT(message, HasSubstr("bad.yaml:3:5: unknown key 'sumary' (did you mean 'summary'?)"));
  shop.write("bad.yaml", R"(layouts:
  one:
    files:
      ORM: ambient_occlusion, roughnes, metallic
      N: normal.q
)");
  const std::string sources = message_of([&] { layout_text("bad.yaml", shop.folder()); });
  EXPECT_THAT(sources,
              HasSubstr("bad.yaml:4:12: unknown map 'roughnes' (did you mean 'roughness'?)"));
  EXPECT_THAT(sources, HasSubstr("bad.yaml:5:10: layout: found 'normal.q'"));
}

TEST(LayoutText, OfAMissingFileIsAnInputThatIsMissing) {
  const Workshop shop;
  const Error error = test::error_of([&] { layout_text("none.yaml#a", shop.folder()); });
  EXPECT_EQ(error.fault(), Fault::Input);
  EXPECT_THAT(error.what(), HasSubstr("none.yaml: no such file"));
}

TEST(LayoutText, IsPutInPlaceOfTheFileThatABakeNames) {
  const Workshop shop;
  shop.write("engines.yaml", engines);
  const Pipeline pipeline = read_pipeline(shop.write("p.yaml", R"(version: 1
sets: [{ path: rock }]
bakes: [{ bake: pack, layout: engines.yaml#desktop, out: o }]
)"));
  EXPECT_EQ(pipeline.bakes.at(0).settings.at(0).text, "Mask = metallic, 0.5, smoothness");
  const std::string message = message_of([&] {
    read_pipeline(shop.write("p.yaml", R"(version: 1
sets: [{ path: rock }]
bakes: [{ bake: pack, layout: engines.yaml#dektop, out: o }]
)"));
  });
  EXPECT_THAT(message, HasSubstr("p.yaml:3:31: "));
  EXPECT_THAT(message, HasSubstr("did you mean 'desktop'"));
}

}  // namespace
}  // namespace kiln
