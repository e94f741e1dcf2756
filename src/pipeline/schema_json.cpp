// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "kiln/pipeline/schema.h"

namespace kiln {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ParamFacts::Kind;

Json reference(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

// A number may also be written as a variable, "{size}".
Json or_variable(const Json& schema) { return {{"anyOf", {schema, reference("variable")}}}; }

// A whole number as such, not as 1.0.
Json bound(double value) {
  return value == std::floor(value) ? Json(static_cast<long long>(value)) : Json(value);
}

Json number_schema(const ParamFacts& facts) {
  Json schema = {{"type", facts.kind == Kind::Integer ? "integer" : "number"}};
  if (std::isfinite(facts.min)) schema["minimum"] = bound(facts.min);
  if (std::isfinite(facts.max)) schema["maximum"] = bound(facts.max);
  return or_variable(schema);
}

Json scalar_schema(const ParamFacts& facts) {
  switch (facts.kind) {
    case Kind::Flag:
      return or_variable({{"type", "boolean"}});
    case Kind::Integer:
    case Kind::Number:
      return number_schema(facts);
    case Kind::Word:
      return or_variable({{"enum", facts.choices}});
    case Kind::Extent:
      return {{"anyOf",
               {Json{{"type", "integer"}, {"minimum", 1}},
                Json{{"type", "string"}, {"pattern", "^[0-9]+x[0-9]+$|\\{.*\\}"}}}}};
    case Kind::Text:
      return {{"type", {"string", "number", "boolean"}}};
  }
  return Json::object();
}

Json value_schema(const Key& key) {
  switch (key.shape) {
    case Key::Shape::Scalar:
      return scalar_schema(key.facts);
    case Key::Shape::Scalars: {
      const Json one = scalar_schema(key.facts);
      return {{"anyOf", {one, Json{{"type", "array"}, {"items", one}}}}};
    }
    case Key::Shape::Block:
      return reference(key.block);
    case Key::Shape::Blocks:
      return {{"type", "array"}, {"items", reference(key.block)}};
    case Key::Shape::Named:
      return {{"type", "object"},
              {"additionalProperties",
               key.block.empty() ? scalar_schema(key.facts) : reference(key.block)}};
  }
  return Json::object();
}

Json described(Json schema, const ParamFacts& facts) {
  schema["description"] = facts.unit.empty() ? facts.meaning : facts.meaning + " " + facts.unit;
  if (!facts.default_text.empty()) schema["default"] = facts.default_text;
  return schema;
}

Json block_schema(const BlockFacts& block) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Key& key : block.keys) {
    properties[key.facts.name] = described(value_schema(key), key.facts);
    if (key.required) required.push_back(key.facts.name);
  }
  Json schema = {{"description", block.meaning},
                 {"type", "object"},
                 {"properties", properties},
                 {"required", required},
                 {"additionalProperties", false}};
  if (block.shorthand.empty()) return schema;
  return {{"anyOf", {Json{{"type", "string"}}, schema}}};
}

Json bakes_schema(Json& definitions) {
  Json any = Json::array();
  for (const BakeFacts& bake : all_bakes()) {
    Json schema = block_schema(bake_block(bake));
    schema["properties"]["bake"] = {{"const", bake.name}};
    definitions["bake-" + bake.name] = schema;
    any.push_back(reference("bake-" + bake.name));
  }
  return {{"anyOf", any}};
}

}  // namespace

std::string schema_json() {
  Json definitions = {{"variable", {{"type", "string"}, {"pattern", "\\{.*\\}"}}}};
  for (const BlockFacts& block : all_blocks()) {
    if (block.name == "pipeline") continue;
    definitions[block.name] = block.name == "bake" ? Json() : block_schema(block);
  }
  definitions["bake"] = bakes_schema(definitions);
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "kiln pipeline"}};
  schema.update(block_schema(block_named("pipeline")));
  schema["$defs"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace kiln
